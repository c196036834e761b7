"""MuJoCo's model of the curved surface: hard facets on a spring, and the stylus over it."""

from itertools import pairwise
from math import atan2, cos, dist, sin, sqrt
from typing import NamedTuple, TypedDict

import mujoco

from hil.cell.errors import PlantError, RigError
from hil.cell.plant.mjcf import set_options
from hil.cell.plant.mjcf_contact import CABLE, CONNECTOR, ContactOptions
from hil.cell.plant.mjcf_stage import add_sensor, add_stage
from hil.cell.plant.scenery import add_scenery
from hil.cell.plant.surface_contact import height_and_slope, relief_of
from hil.cell.rig import Rig
from hil.cell.rig.surface import Surface

RADIUS = 2e-3
"""Of the stylus' ball, m; its lowest point is the TCP."""
PITCH = 1e-3
"""Length of a facet, m: those of a 60 mm wave are then 3 um from the curve."""
LEAD, HALF_WIDTH, BASE = 20e-3, 5e-3, 5e-3
"""Flat part on either side, half width along y, half thickness of a facet; m."""
RGBA = [0.6, 0.65, 0.7, 1.0]
MASS, DAMPING_RATIO = 0.05, 0.3
"""Of the sprung surface, kg and -: its own ringing (225 Hz at 100 N/mm) must die out."""


class Point(NamedTuple):
    """Of the profile, m."""

    x: float
    z: float


class SpringOptions(TypedDict):
    """Keyword arguments of MjsBody.add_joint."""

    stiffness: list[float]
    damping: list[float]


def build(rig: Rig, history: int) -> mujoco.MjModel:
    """Compile the model; its sensor keeps `history` physics steps. Raises PlantError, RigError."""
    if rig.surface.bottoming_force > 0:
        raise RigError(
            "surface.bottoming_force: the MuJoCo surface has one stiffness; use plant: surface"
        )
    spec = mujoco.MjSpec()
    spec.modelname = rig.name
    set_options(spec, rig.physics.step)
    add_scenery(spec, "surface")
    _add_surface(spec, rig.surface)
    jaws = add_stage(spec, rig.tool, rig.cable, rig.robot.servo)
    jaws.add_geom(
        name="stylus", type=mujoco.mjtGeom.mjGEOM_SPHERE, mass=0.0, size=[RADIUS, 0.0, 0.0],
        pos=[0.0, 0.0, RADIUS - rig.cable.free_length],
        **_contact(CABLE, CONNECTOR),
    )  # fmt: skip
    add_sensor(spec, history)
    try:
        return spec.compile()
    except ValueError as error:
        raise PlantError(f"MuJoCo cannot build rig {rig.name!r}: {error}") from error


def _add_surface(spec: mujoco.MjSpec, surface: Surface) -> None:
    """Put the surface on its spring; sprung along z, so stiffness is k_e where it lies flat."""
    body = spec.worldbody.add_body(
        name="surface", pos=[0.0, 0.0, -surface.gap], gravcomp=1.0, explicitinertial=True,
        mass=MASS, ipos=[0.0, 0.0, 0.0], inertia=[1e-6] * 3,
    )  # fmt: skip
    body.add_joint(
        name="surface", type=mujoco.mjtJoint.mjJNT_SLIDE, axis=[0.0, 0.0, 1.0], **_spring(surface)
    )
    for left, right in pairwise(profile(surface)):
        _add_facet(body, left, right, _contact(CONNECTOR, CABLE))


def _add_facet(body: mujoco.MjsBody, left: Point, right: Point, contact: ContactOptions) -> None:
    """A box whose top goes from one point of the profile to the next."""
    length = dist(left, right)
    c, s = (right.x - left.x) / length, (right.z - left.z) / length
    middle = [(left.x + right.x) / 2 + s * BASE, 0.0, (left.z + right.z) / 2 - c * BASE]
    half = atan2(-s, c) / 2
    body.add_geom(
        type=mujoco.mjtGeom.mjGEOM_BOX, size=[length / 2, HALF_WIDTH, BASE], pos=middle,
        quat=[cos(half), 0.0, sin(half), 0.0], rgba=RGBA,
        **contact,
    )  # fmt: skip


def profile(surface: Surface) -> list[Point]:
    """Points of the surface a PITCH apart, heights above its flat part."""
    relief = relief_of(surface)._replace(floor=0.0)
    count = round((LEAD + surface.length + LEAD) / PITCH) + 1
    places = (PITCH * i - LEAD for i in range(count))
    return [Point(x, height_and_slope(relief, x)[0]) for x in places]


def _spring(surface: Surface) -> SpringOptions:
    own = 2 * DAMPING_RATIO * sqrt(surface.stiffness * MASS)
    return SpringOptions(
        stiffness=[surface.stiffness, 0.0, 0.0], damping=[surface.damping + own, 0.0, 0.0]
    )


def _contact(own: int, other: int) -> ContactOptions:
    """Frictionless: `surface_mujoco` lays friction over it."""
    return ContactOptions(
        contype=own,
        conaffinity=other,
        condim=1,
        solref=[2e-3, 1.0],
        solimp=[0.999, 0.999, 1e-5, 0.5, 2.0],
    )
