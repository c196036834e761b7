"""The cable in the jaws: a compliant pad, and below it a chain of plates on elastic hinges."""

from math import sqrt

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
SLIDE, HINGE = mujoco.mjtJoint.mjJNT_SLIDE, mujoco.mjtJoint.mjJNT_HINGE


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
        name=name, pos=[0.0, 0.0, z], mass=1e-4, inertia=[1e-9] * 3, explicitinertial=True
    )


def _add_pad(body: mujoco.MjsBody, pad: Pad, width: float) -> None:
    inertia = PAD_MASS * width**2 / 12
    zeta = pad.damping_ratio
    _add_spring(body, "pad_y", SLIDE, Y, pad.stiffness_y, PAD_MASS, zeta)
    _add_spring(body, "pad_x", SLIDE, X, pad.stiffness_x, PAD_MASS, zeta)
    _add_spring(body, "pad_z", SLIDE, Z, pad.stiffness_z, PAD_MASS, zeta)
    _add_spring(body, "pad_tilt", HINGE, Y, pad.stiffness_rotation, inertia, zeta)


def _add_hinges(body: mujoco.MjsBody, cable: Cable, index: int) -> None:
    bend, twist = beam.bending_hinge(cable, index), beam.twist_hinge(cable)
    _add_spring(body, f"bend{index}", HINGE, X, bend, BENDING_ARMATURE, CHAIN_DAMPING_RATIO)
    _add_spring(body, f"twist{index}", HINGE, Z, twist, TWIST_ARMATURE, CHAIN_DAMPING_RATIO)


def _add_spring(
    body: mujoco.MjsBody, name: str, kind: mujoco.mjtJoint, axis: list[float],
    stiffness: float, armature: float, damping_ratio: float,
) -> None:  # fmt: skip
    """A joint with a spring and damping; MuJoCo takes both as polynomials, here of degree 1."""
    damping = 2 * damping_ratio * sqrt(stiffness * armature)
    body.add_joint(
        name=name, type=kind, axis=axis, armature=armature,
        stiffness=[stiffness, 0.0, 0.0], damping=[damping, 0.0, 0.0],
    )  # fmt: skip
