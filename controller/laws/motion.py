"""The commanded motion of one axis: bounded speed, acceleration and travel, and its recent past."""

from collections import deque

from controller.laws.bounds import Bounds

MEMORY = 0.1
"""s of past commands kept: more than the longest loop delay a law believes."""


class Motion:
    """Integrates a speed into a command. period: s."""

    __slots__ = ("_bounds", "_gain", "_period", "_sent", "position", "speed")

    def __init__(self, bounds: Bounds, period: float) -> None:
        self._bounds = bounds
        self._period = period
        self._gain = bounds.acceleration * period
        length = round(MEMORY / period) + 2
        self._sent: deque[float] = deque([0.0] * length, length)
        self.position = 0.0
        self.speed = 0.0

    def reset(self, position: float) -> None:
        """Stand at this command, m; ValueError when it lies outside the travel."""
        bounds = self._bounds
        if not bounds.lowest <= position <= bounds.highest:
            raise ValueError(
                f"the axis stands at {position} m, its travel is"
                f" {bounds.lowest} to {bounds.highest} m"
            )
        self.position = position
        self.speed = 0.0
        self._sent.extend([position] * len(self._sent))

    def advance(self, wanted: float) -> float:
        """Move at this speed (m/s) as far as the bounds allow; the step taken, m."""
        bounds, period = self._bounds, self._period
        wanted = min(max(wanted, -bounds.speed), bounds.speed)
        speed = min(max(wanted, self.speed - self._gain), self.speed + self._gain)
        step = speed * period
        position = self.position + step
        if not bounds.lowest <= position <= bounds.highest:
            position = min(max(position, bounds.lowest), bounds.highest)
            step = position - self.position
            speed = step / period
        self.position, self.speed = position, speed
        self._sent.append(position)
        return step

    def repeat(self, periods: int) -> None:
        """So many periods passed without a command: the arm held the last one."""
        self._sent.extend([self.position] * min(periods, len(self._sent)))

    def ago(self, delay: float) -> float:
        """The command in force so many seconds before the newest, m; the oldest kept at most."""
        sent = self._sent
        back = delay / self._period
        whole = min(int(back), len(sent) - 2)
        part = min(back - whole, 1.0)
        return (1.0 - part) * sent[-1 - whole] + part * sent[-2 - whole]
