"""The axes of a selection that hold no force: one goes to a position, one gives way to any push."""

from dataclasses import dataclass
from math import floor, inf, isfinite, sqrt

from controller.laws.bounds import Bounds
from controller.laws.interface import AxisReading, Reference
from controller.laws.motion import Motion


@dataclass(frozen=True, slots=True)
class Pace:
    """speed: m/s or rad/s. acceleration: m/s² or rad/s². lowest, highest: travel, m or rad."""

    speed: float = 5e-3
    acceleration: float = 2.0
    lowest: float = -inf
    highest: float = inf

    def __post_init__(self) -> None:
        if not (0.0 < self.speed < inf and 0.0 < self.acceleration < inf):
            raise ValueError(f"speed and acceleration must be positive and finite, found {self}")

    def bounds(self) -> Bounds:
        return Bounds(
            speed=self.speed,
            acceleration=self.acceleration,
            lowest=self.lowest,
            highest=self.highest,
        )


def stoppable(way: float, acceleration: float, period: float) -> float:
    """The fastest speed (m/s) from which so short a way (m) suffices to stop, in whole periods.

    Of (n + r) times the speed lost a period, the way is (n + 1)(n + 2r)/2 times what that speed
    covers a period; the continuous v²/2a would overshoot by up to an eighth of that.
    """
    loss = acceleration * period
    ways = way / (loss * period)
    n = floor(0.5 * (sqrt(1.0 + 8.0 * ways) - 1.0))
    return loss * (n + max(0.0, ways / (n + 1) - 0.5 * n))


class PositionAxis:
    """Goes to the reference's position and ignores the push; without one it holds its place."""

    __slots__ = ("_acceleration", "_home", "_motion", "_period")

    def __init__(self, pace: Pace, period: int) -> None:
        """period: ns."""
        self._period = period * 1e-9
        self._acceleration = pace.acceleration
        self._motion = Motion(pace.bounds(), self._period)
        self._home = 0.0

    @property
    def velocity(self) -> float:
        return self._motion.speed

    def reset(self, position: float) -> None:
        self._home = position
        self._motion.reset(position)

    def step(self, reading: AxisReading, reference: Reference) -> float:
        target = self._home if reference.position is None else reference.position
        way = target - self._motion.position
        if not isfinite(way):
            return self._motion.advance(0.0)
        stopping = stoppable(abs(way), self._acceleration, self._period)
        wanted = min(abs(way) / self._period, stopping)
        return self._motion.advance(wanted if way > 0.0 else -wanted)


class FreeAxis:
    """Gives way to a push from either side: b x' = f, so that no load builds up across it.

    damping: N s/m or N·m·s/rad. Without a sample it stands still.
    """

    __slots__ = ("_damping", "_motion")

    def __init__(self, damping: float, pace: Pace, period: int) -> None:
        """period: ns."""
        if not damping > 0.0:
            raise ValueError(f"the damping of a free axis is positive, found {damping}")
        self._damping = damping
        self._motion = Motion(pace.bounds(), period * 1e-9)

    @property
    def velocity(self) -> float:
        return self._motion.speed

    def reset(self, position: float) -> None:
        self._motion.reset(position)

    def step(self, reading: AxisReading, reference: Reference) -> float:
        push = sum(reading.push) / len(reading.push) if reading.push else 0.0
        return self._motion.advance(push / self._damping if isfinite(push) else 0.0)
