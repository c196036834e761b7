"""Six axes, each under position, force or no control of its own (task-frame formalism)."""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import TypeAlias

from controller.laws.interface import AxisLaw, AxisReading, Reference
from drivers.interfaces import Vector6

References: TypeAlias = Sequence[Reference]
"""One an axis: x, y, z, then the turns about them."""


class SelectionLaw:
    """One `AxisLaw` an axis: `Governor` by force, `PositionAxis`, or `FreeAxis`.

    Poses and wrenches are taken along the axes of one task frame; turns are small rotation vectors,
    rad. An axis whose surface faces the other way is a `Mirrored` one.
    """

    __slots__ = ("_axes",)

    def __init__(self, axes: Sequence[AxisLaw]) -> None:
        if len(axes) != 6:
            raise ValueError(f"six axes are to be selected, found {len(axes)}")
        self._axes = tuple(axes)

    def reset(self, pose: Vector6) -> None:
        """Begin at rest at this pose, m and rad."""
        for axis, position in zip(self._axes, pose, strict=True):
            axis.reset(position)

    def step(
        self, t: int, wrenches: Sequence[Vector6], pose: Vector6 | None, references: References
    ) -> Vector6:
        """Change of the commanded pose, m and rad.

        t: ns. wrenches: new samples of the environment's push on the tool, N and N·m; empty when
        none came. pose: measured, or None.
        """
        pushes = tuple(zip(*wrenches, strict=True)) or ((),) * 6
        places = pose or (None,) * 6
        x, y, z, rx, ry, rz = (
            axis.step(AxisReading(t, push, place), reference)
            for axis, push, place, reference in zip(
                self._axes, pushes, places, references, strict=True
            )
        )
        return (x, y, z, rx, ry, rz)

    @property
    def velocity(self) -> Vector6:
        """Of the commanded pose, m/s and rad/s."""
        x, y, z, rx, ry, rz = (axis.velocity for axis in self._axes)
        return (x, y, z, rx, ry, rz)


@dataclass(frozen=True, slots=True)
class Mirrored:
    """The same law on an axis whose outward normal points the negative way."""

    law: AxisLaw

    @property
    def velocity(self) -> float:
        return -self.law.velocity

    def reset(self, position: float) -> None:
        self.law.reset(-position)

    def step(self, reading: AxisReading, reference: Reference) -> float:
        push = tuple(-sample for sample in reading.push)
        place = None if reading.position is None else -reading.position
        target = None if reference.position is None else -reference.position
        mirrored = reference._replace(speed=-reference.speed, position=target)
        return -self.law.step(AxisReading(reading.t, push, place), mirrored)
