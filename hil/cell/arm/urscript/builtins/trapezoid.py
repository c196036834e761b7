"""The trapezoidal speed profile of a move that starts and ends at rest."""

from dataclasses import dataclass
from math import sqrt


@dataclass(frozen=True, slots=True)
class Trapezoid:
    """duration, ramp: s; the speed rises for `ramp`, holds, and falls for `ramp`."""

    duration: float
    ramp: float

    def fraction(self, t: float) -> float:
        """Part of the way, 0..1, that is done at `t` s."""
        if t <= 0.0 or t >= self.duration:
            return 0.0 if t <= 0.0 else 1.0
        speed = 1.0 / (self.duration - self.ramp)
        if t < self.ramp:
            return 0.5 * speed * t * t / self.ramp
        left = self.duration - t
        if left < self.ramp:
            return 1.0 - 0.5 * speed * left * left / self.ramp
        return speed * (t - 0.5 * self.ramp)

    def left(self, share: float) -> float:
        """Time before the end, within the last ramp, at which `share` of the way is to be done."""
        if self.ramp <= 0.0:
            return 0.0
        return min(self.ramp, sqrt(2.0 * share * self.ramp * (self.duration - self.ramp)))


def limited(way: float, speed: float, acceleration: float) -> Trapezoid:
    """The fastest profile within the limits; a short way never reaches `speed`."""
    if way <= 0.0:
        return Trapezoid(0.0, 0.0)
    ramp = min(speed / acceleration, sqrt(way / acceleration))
    return Trapezoid(way / (acceleration * ramp) + ramp, ramp)


def lasting(duration: float, way: float, acceleration: float, speed: float) -> Trapezoid:
    """A third of the time each for speeding up, cruising and slowing down; the split is assumed.

    A time too short for the limits is lengthened, a cruise too fast for them is slowed.
    """
    fastest = limited(way, speed, acceleration)
    if fastest.duration >= duration:
        return fastest
    return Trapezoid(duration, min(duration / 3.0, duration - way / speed))
