"""What a tracked contact shall do over time: force profiles, and the way along the surface."""

from dataclasses import dataclass
from math import cos, isfinite, pi, sin
from typing import Protocol

from controller.laws.interface import Reference


class ForceProfile(Protocol):
    """A reference force over the time since the first touch; before it, its value at 0."""

    def at(self, t: float) -> Reference:
        """At t s: f_d in N and its rate in N/s."""
        ...


@dataclass(frozen=True, slots=True)
class Step:
    """One force, N, from the touch on: the step is the touch itself."""

    force: float

    def __post_init__(self) -> None:
        _positive(force=self.force)

    def at(self, t: float) -> Reference:
        return Reference(self.force)


@dataclass(frozen=True, slots=True)
class Ramp:
    """From one force to another, N, in so many s, after a rest (s) at the first."""

    start: float
    end: float
    duration: float
    rest: float = 1.0

    def __post_init__(self) -> None:
        _positive(start=self.start, end=self.end, duration=self.duration)

    def at(self, t: float) -> Reference:
        since = t - self.rest
        if since <= 0.0:
            return Reference(self.start)
        if since >= self.duration:
            return Reference(self.end)
        rate = (self.end - self.start) / self.duration
        return Reference(self.start + rate * since, rate)


@dataclass(frozen=True, slots=True)
class Sine:
    """mean + amplitude sin(2 pi frequency t), N and Hz, after a rest (s) at the mean."""

    mean: float
    amplitude: float
    frequency: float
    rest: float = 1.0

    def __post_init__(self) -> None:
        _positive(mean=self.mean, frequency=self.frequency)
        if not 0.0 <= self.amplitude < self.mean:
            raise ValueError(
                f"amplitude must lie in 0 .. mean ({self.mean} N), or contact is lost; "
                f"found {self.amplitude}"
            )

    def at(self, t: float) -> Reference:
        if t <= self.rest:
            return Reference(self.mean)
        w = 2.0 * pi * self.frequency
        phase = w * (t - self.rest)
        return Reference(self.mean + self.amplitude * sin(phase), self.amplitude * w * cos(phase))


@dataclass(frozen=True, slots=True)
class Slide:
    """Motion along x: to `speed` (m/s) at `acceleration` (m/s²), then on for ever."""

    speed: float = 20e-3
    acceleration: float = 0.1

    def __post_init__(self) -> None:
        _positive(acceleration=self.acceleration)
        if not isfinite(self.speed):
            raise ValueError(f"speed must be finite, found {self.speed}")

    def at(self, t: float) -> float:
        """Way from the start after t s, m."""
        rise = abs(self.speed) / self.acceleration
        if t <= 0.0:
            return 0.0
        if t < rise:
            return 0.5 * self.speed / rise * t * t
        return self.speed * (t - 0.5 * rise)


def _positive(**values: float) -> None:
    for name, value in values.items():
        if not (isfinite(value) and value > 0.0):
            raise ValueError(f"{name} must be positive and finite, found {value}")
