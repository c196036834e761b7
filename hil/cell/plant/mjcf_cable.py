"""The cable in the jaws: a compliant pad, and below it a chain of plates on elastic hinges."""

from math import sqrt
from typing import NamedTuple, TypedDict

import mujoco

from hil.cell.plant import beam
from hil.cell.plant.mjcf_contact import cable_side
from hil.cell.rig.parts import Cable, Connector, Pad

PAD_MASS = 0.05
"""Armature of the pad's joints, kg. MuJoCo's contact stiffness grows with the effective mass: the
cable's own 0.05 g would sink in or diverge; 50 g is harmless below about 50 Hz."""
BENDING_ARMATURE, TWIST_ARMATURE = 1e-6, 1e-5
"""Armatures of the chain's hinges, kg·m^2."""
CHAIN_DAMPING_RATIO = 0.3
PLATE_MASS = 1e-5
RGBA = [0.2, 0.4, 0.9, 1.0]

X, Y, Z = [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]


def add_cable(jaws: mujoco.MjsBody, cable: Cable, pad: Pad, connector: Connector) -> None:
    """Hang a cable on the jaws: its root at their origin, its tip free_length below."""
    parent = _body(jaws, "pad", 0.0)
    _add_pad(parent, pad, cable.width)
    length = cable.free_length / cable.segments
    for index in range(cable.segments):
        last = index == cable.segments - 1
        parent = _body(parent, "tip" if last else f"plate{index}", -length if index else 0.0)
        _add_hinges(parent, cable, index)
        parent.add_geom(
            name=f"cable{index}", type=mujoco.mjtGeom.mjGEOM_BOX, mass=PLATE_MASS, rgba=RGBA,
            pos=[0.0, 0.0, -length / 2],
            size=[cable.width / 2, cable.thickness / 2, length / 2],
            **cable_side(connector),
        )  # fmt: skip


def _body(parent: mujoco.MjsBody, name: str, z: float) -> mujoco.MjsBody:
    """A body too light to matter, but not massless: the joints' armatures carry the inertia."""
    return parent.add_body(
        name=name, pos=[0.0, 0.0, z], explicitinertial=True,
        mass=1e-4, ipos=[0.0, 0.0, 0.0], inertia=[1e-9] * 3,
    )  # fmt: skip


class SpringOptions(TypedDict):
    """Keyword arguments of MjsBody.add_joint that make a joint springy."""

    armature: float
    stiffness: list[float]
    damping: list[float]


class Spring(NamedTuple):
    """Stiffness, armature and damping ratio of a joint, in SI for its kind."""

    stiffness: float
    armature: float
    damping_ratio: float


def _add_pad(body: mujoco.MjsBody, pad: Pad, width: float) -> None:
    inertia, zeta = PAD_MASS * width**2 / 12, pad.damping_ratio
    _add_slide(body, "pad_y", Y, Spring(pad.stiffness_y, PAD_MASS, zeta))
    _add_slide(body, "pad_x", X, Spring(pad.stiffness_x, PAD_MASS, zeta))
    _add_slide(body, "pad_z", Z, Spring(pad.stiffness_z, PAD_MASS, zeta))
    _add_hinge(body, "pad_tilt", Y, Spring(pad.stiffness_rotation, inertia, zeta))


def _add_hinges(body: mujoco.MjsBody, cable: Cable, index: int) -> None:
    zeta = CHAIN_DAMPING_RATIO
    bend = Spring(beam.bending_hinge(cable, index), BENDING_ARMATURE, zeta)
    _add_hinge(body, f"bend{index}", X, bend)
    _add_hinge(body, f"twist{index}", Z, Spring(beam.twist_hinge(cable), TWIST_ARMATURE, zeta))


def _add_slide(body: mujoco.MjsBody, name: str, axis: list[float], spring: Spring) -> None:
    body.add_joint(
        name=name, type=mujoco.mjtJoint.mjJNT_SLIDE, axis=axis, **_spring_options(spring)
    )


def _add_hinge(body: mujoco.MjsBody, name: str, axis: list[float], spring: Spring) -> None:
    body.add_joint(
        name=name, type=mujoco.mjtJoint.mjJNT_HINGE, axis=axis, **_spring_options(spring)
    )


def _spring_options(spring: Spring) -> SpringOptions:
    """MuJoCo takes stiffness and damping as polynomials, here of degree one."""
    damping = 2 * spring.damping_ratio * sqrt(spring.stiffness * spring.armature)
    return SpringOptions(
        armature=spring.armature,
        stiffness=[spring.stiffness, 0.0, 0.0],
        damping=[damping, 0.0, 0.0],
    )
