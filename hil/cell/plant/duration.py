"""How a control period divides into milliseconds and those into physics steps."""

from hil.cell.errors import PlantError, RigError
from hil.cell.rig.parts import Physics

MILLISECOND = 1_000_000
"""Sensor period in ns; the plants give one true wrench for each."""


def milliseconds(duration: int) -> int:
    """Wrench samples in `duration` ns; PlantError unless it is a whole number above 0."""
    count, rest = divmod(duration, MILLISECOND)
    if rest or count < 1:
        raise PlantError(f"a period of {duration} ns is not a positive multiple of 1 ms")
    return count


def steps_per_millisecond(physics: Physics) -> int:
    """Physics steps between two wrench samples; RigError unless 1 ms is a whole number of them."""
    steps = round(1e-3 / physics.step) if physics.step > 0 else 0
    if steps < 1 or abs(steps * physics.step - 1e-3) > 1e-12:
        raise RigError(f"physics.step: {physics.step} s does not divide 1 ms (try '0.5 ms')")
    return steps
