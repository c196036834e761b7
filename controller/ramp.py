"""A step of the set-point, spread over a few periods."""

from collections.abc import Iterator

from controller.place import Place

RAMP = 0.048
"""Duration of a ramped step, s. A 0.3 mm step at once shakes 0.6 kg of tool with 3 N, twice the
lateral bound, without any contact; over 48 ms it is 0.2 N in the 8 ms mean.
"""


def ramp_periods(period: float, duration: float = RAMP) -> int:
    """How many control periods (s) a ramp takes: 6 at 125 Hz, 24 at 500 Hz."""
    return max(1, round(duration / period))


def ramp(dx: float, dy: float, dtheta: float, periods: int) -> Iterator[tuple[float, float, float]]:
    """Equal increments of x, y (m) and theta (rad), one a period, that add up to the step."""
    for _ in range(periods):
        yield dx / periods, dy / periods, dtheta / periods


def line(start: Place, end: Place, fraction: float) -> Place:
    """The place at a fraction of the straight way; exactly `end` at 1."""
    if fraction >= 1.0:
        return end
    return Place(*(a + (b - a) * fraction for a, b in zip(start, end, strict=True)))
