"""Everything between a force law and the arm that must hold whatever the law proposes."""

from math import isfinite

from controller.laws.bounds import Bounds
from controller.laws.interface import AxisReading, Felt, ForceLaw, Reference
from controller.laws.motion import Motion


class Governor:
    """A force-controlled axis: judges the reading, asks the law, bounds the motion.

    Without a usable reading it brakes to a standstill. A sample above the force stop latches: the
    axis withdraws until the push is gone and stands still until `reset`. A reading whose time did
    not go on is none: it tells nothing new.
    """

    __slots__ = ("_blind", "_bounds", "_last", "_law", "_motion", "_patience", "_period", "tripped")

    def __init__(self, law: ForceLaw, bounds: Bounds, period: int) -> None:
        """period: of the control loop, ns."""
        if period <= 0:
            raise ValueError(f"a control period is positive, found {period} ns")
        self._law = law
        self._bounds = bounds
        self._period = period
        self._patience = round(bounds.silence * 1e9)
        self._motion = Motion(bounds, period * 1e-9)
        self._last: int | None = None
        self._blind = 0
        self.tripped = False

    @property
    def velocity(self) -> float:
        return self._motion.speed

    @property
    def position(self) -> float:
        """The newest command, m."""
        return self._motion.position

    def reset(self, position: float) -> None:
        self._motion.reset(position)
        self._law.reset(position)
        self._last = None
        self._blind = 0
        self.tripped = False

    def step(self, reading: AxisReading, reference: Reference) -> float:
        felt = self._felt(reading)
        if felt is None:
            return self._motion.advance(0.0)
        if self.tripped:
            return self._motion.advance(self._bounds.speed if felt.touching else 0.0)
        return self._motion.advance(self._allowed(felt, reference))

    def _allowed(self, felt: Felt, reference: Reference) -> float:
        """The law's proposal within the speeds of this side of the contact, m/s."""
        bounds = self._bounds
        wanted = self._law.velocity(felt, self._motion, reference)
        if not isfinite(wanted):
            return 0.0
        inward = bounds.push if felt.touching else bounds.approach
        return min(max(wanted, -inward), bounds.retreat)

    def _felt(self, reading: AxisReading) -> Felt | None:
        bounds = self._bounds
        missed = self._missed(reading.t)
        samples = _usable(reading.push, bounds.sensor_range) if missed >= 0 else ()
        if not samples:
            self._blind += self._period
            return None
        if max(samples) > bounds.stop:
            self.tripped = True
        push = sum(samples) / len(samples)
        position = reading.position
        if position is not None and not isfinite(position):
            position = None
        stale = self._blind > self._patience
        self._blind = 0
        return Felt(push, samples, push > bounds.contact, position, stale)

    def _missed(self, t: int) -> int:
        """Control periods that the arm's clock skipped; -1 when it did not go on."""
        last, self._last = self._last, t
        if last is None:
            return 0
        missed = (t - last + self._period // 2) // self._period - 1
        if missed > 0:
            self._motion.repeat(missed)
            self._blind += missed * self._period
        return max(-1, missed)


def _usable(samples: tuple[float, ...], reach: float) -> tuple[float, ...]:
    """The samples within the sensor's range."""
    # One pass in the usual case: a sum is finite only if every term is.
    if samples and isfinite(sum(samples)) and max(samples) <= reach and min(samples) >= -reach:
        return samples
    return tuple(sample for sample in samples if abs(sample) <= reach)
