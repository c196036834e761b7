"""Where the tool was when the newest force sample was taken."""

from collections import deque

HISTORY = 64_000_000
"""ns of positions kept: more than any sample's age that the guard lets pass."""


class AlignedPosition:
    """Interpolates an axis' measured positions at a past time, so that pose and force agree.

    A pose that is 8 ms newer than the force it is compared with costs a force law up to a quarter
    of overshoot (measured); sensor bus and arm link have different delays.
    """

    __slots__ = ("_past",)

    def __init__(self, period: int) -> None:
        """period: of the readings, ns."""
        self._past: deque[tuple[int, float]] = deque(maxlen=HISTORY // period + 2)

    def at(self, t: int, position: float, age: int) -> float:
        """Take the position at t (ns, m), give the one at t - age; the oldest kept at most."""
        past = self._past
        past.append((t, position))
        wanted = t - age
        later_t, later = t, position
        for there, value in reversed(past):
            if there <= wanted:
                share = (wanted - there) / (later_t - there) if later_t > there else 0.0
                return value + share * (later - value)
            later_t, later = there, value
        return later
