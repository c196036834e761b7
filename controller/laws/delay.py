"""The loop's own delay, from how far the robot lags behind a constant-speed approach."""

from controller.laws.interface import Commanded

STEADY = 0.2
"""s of constant speed after which the lag has settled."""
SMOOTHING = 0.1
"""Share of a new lag in the estimate."""


class LoopDelay:
    """From sending a command to feeling what it did, s; a prior until an approach was seen."""

    __slots__ = ("_longest", "_shortest", "_speed", "_steady", "_wait", "value")

    def __init__(self, prior: float, shortest: float, longest: float, period: float) -> None:
        self._shortest = shortest
        self._longest = longest
        self._wait = round(STEADY / period)
        self._steady = 0
        self._speed = 0.0
        self.value = prior

    def interrupt(self) -> None:
        """The approach ended."""
        self._steady = 0

    def observe(self, measured: float | None, motion: Commanded) -> None:
        """One period in free air with the robot measured here, m.

        Sensor latency is in it only as far as the arm's own readings share it.
        """
        if motion.speed != self._speed:
            self._speed, self._steady = motion.speed, 0
        self._steady += 1
        if self._steady > self._wait and self._speed < 0.0 and measured is not None:
            lag = (measured - motion.position) / -self._speed
            lag = min(max(lag, self._shortest), self._longest)
            self.value += SMOOTHING * (lag - self.value)
