"""Rig sections of what is assembled: cable, connector, fixtures, and the physics between them.

Numbers marked assumed are not in the paper or on a card; they are axes of `randomisation`.
"""

from math import cos, sin
from typing import Literal

from pydantic import Field

from hil.cell.rig.quantity import (
    Angle,
    Kilograms,
    Length,
    Metres,
    NewtonMetresPerRadian,
    Newtons,
    NewtonsPerMetre,
    Pascals,
    Radians,
    Seconds,
)  # fmt: skip
from hil.cell.rig.section import Section


class Cable(Section):
    """The flexible flat cable beyond the jaws, as a chain of plates on a compliant pad."""

    width: Length = Field(default=18.5e-3, gt=0)
    thickness: Length = Field(default=0.3e-3, gt=0)
    free_length: Length = Field(default=6e-3, gt=0)  # assumed
    modulus: Pascals = Field(default=5e9, gt=0)  # assumed: effective, copper included
    poisson: float = Field(default=0.35, ge=0, lt=0.5)
    segments: int = Field(default=4, ge=1, le=16)


class Pad(Section):
    """Rubber of the jaws: what the cable is held by, and the grip beyond which it slips."""

    stiffness_x: NewtonsPerMetre = Field(default=5e3, gt=0)  # assumed
    stiffness_y: NewtonsPerMetre = Field(default=8e3, gt=0)  # assumed
    stiffness_z: NewtonsPerMetre = Field(default=20e3, gt=0)  # assumed
    stiffness_rotation: NewtonMetresPerRadian = Field(default=0.57, gt=0)  # assumed
    damping_ratio: float = Field(default=0.4, gt=0, le=2)
    slip_force: Newtons = 30.0  # assumed: friction times clamping force
    slip_torque: float = Field(default=0.2, gt=0)  # assumed, N·m about the jaws' closing axis


class Connector(Section):
    """The slot: mouth, depth, chamfer, and the springs inside that resist mating."""

    width: Length = Field(default=18.56e-3, gt=0)
    height: Length = Field(default=0.37e-3, gt=0)
    depth: Length = Field(default=2.5e-3, gt=0)
    chamfer: Length = 0.25e-3  # assumed
    friction: float = Field(default=0.2, ge=0, le=1)  # assumed
    mating_force: Newtons = 4.0  # assumed
    mating_start: Length = 0.8e-3  # assumed: depth at which the terminals begin to grip
    mating_ramp: Length = Field(
        default=0.4e-3, gt=0
    )  # assumed: depth over which they reach the full force
    position: tuple[Metres, Metres, Metres] = (-0.45, -0.11, 0.05)
    """Middle of the slot's mouth in the robot's base frame."""
    rotation: Radians = 0.0
    """About the base's z."""
    offset_x: Metres = 0.0
    offset_y: Metres = 0.0
    offset_rotation: Radians = 0.0
    """Where it truly stands off that place, along its own axes; the near side is not told."""

    def as_placed(self) -> "Connector":
        """The connector where it truly stands."""
        c, s = cos(self.rotation), sin(self.rotation)
        x, y, z = self.position
        dx, dy = self.offset_x, self.offset_y
        return self.model_copy(
            update={
                "position": (x + c * dx - s * dy, y + s * dx + c * dy, z),
                "rotation": self.rotation + self.offset_rotation,
                "offset_x": 0.0,
                "offset_y": 0.0,
                "offset_rotation": 0.0,
            }
        )


class Part(Section):
    """One cable waiting in its fixture; position of its tip in the robot's base frame."""

    name: str
    position: tuple[Metres, Metres, Metres]
    rotation: Radians = 0.0


class Fixture(Section):
    """Where parts wait, and how far one can lie from its nominal place (full width)."""

    play: Length = 0.8e-3
    play_rotation: Angle = 0.0174532925199433
    capture: Length = 2e-3
    """Jaws that close further off than this catch nothing."""
    parts: tuple[Part, ...] = ()


class Tool(Section):
    """What hangs below the sensor: its weight and inertia are in every reading."""

    mass: Kilograms = 0.6
    centre_of_mass: Metres = 0.06
    length: Length = 0.12
    """From the sensor's origin to the TCP (the nominal cable tip)."""


class Physics(Section):
    """Which plant, and how finely it is stepped."""

    plant: Literal["mujoco", "analytic", "wall", "surface", "surface_mujoco"] = "mujoco"
    step: Seconds = Field(default=0.5e-3, gt=0)
    wall_stiffness: NewtonsPerMetre = 10e3
    wall_damping: float = Field(default=20.0, ge=0)
    """N s/m, of the `wall` plant."""
