"""The stage that stands for the arm, the tool below it, and the sensor between them."""

import mujoco

from hil.cell.errors import RigError
from hil.cell.plant import servo
from hil.cell.rig.parts import Cable, Tool
from hil.cell.rig.robot import Servo

AXES = ("x", "y", "z", "theta")
TOOL_INERTIA = [5e-4, 5e-4, 2e-4]
"""About the tool's centre of mass, kg·m^2 (assumed)."""
FACING_DOWN = [0.0, 1.0, 0.0, 0.0]
"""Quaternion of a half turn about x: the sensor's z points out of the tool."""
JAW_RGBA = [0.3, 0.3, 0.32, 1.0]


def add_stage(spec: mujoco.MjSpec, tool: Tool, cable: Cable, arm: Servo) -> mujoco.MjsBody:
    """Add stage, servos and tool; returns the jaws' body, free_length above the TCP.

    The stage's origin is the TCP. gravcomp: the arm carries its payload, so weight does not sag
    the stage; the sensor still feels it.
    """
    stage = spec.worldbody.add_body(
        name="stage", explicitinertial=True, gravcomp=1.0,
        mass=1e-3, ipos=[0.0, 0.0, 0.0], inertia=[1e-6] * 3,
    )  # fmt: skip
    _add_servos(spec, stage, tool, arm)
    body = stage.add_body(
        name="tool", pos=[0.0, 0.0, tool.length], gravcomp=1.0, explicitinertial=True,
        mass=tool.mass, ipos=[0.0, 0.0, -tool.centre_of_mass], inertia=TOOL_INERTIA,
    )  # fmt: skip
    body.add_site(name="sensor", quat=FACING_DOWN)
    jaws = body.add_body(name="jaws", pos=[0.0, 0.0, cable.free_length - tool.length])
    _add_jaw_shapes(body, tool, cable)
    return jaws


def add_sensor(spec: mujoco.MjSpec, history: int) -> None:
    """Force and torque at the sensor's site, each keeping its last `history` physics steps."""
    kinds = {"force": mujoco.mjtSensor.mjSENS_FORCE, "torque": mujoco.mjtSensor.mjSENS_TORQUE}
    for name, kind in kinds.items():
        spec.add_sensor(
            name=name, type=kind, objtype=mujoco.mjtObj.mjOBJ_SITE, objname="sensor",
            nsample=history,
        )  # fmt: skip


def _add_servos(spec: mujoco.MjSpec, stage: mujoco.MjsBody, tool: Tool, arm: Servo) -> None:
    armature = servo.MASS - tool.mass
    if armature <= 0:
        raise RigError(
            f"tool.mass: {tool.mass} kg exceeds the arm's {servo.MASS} kg of moving mass"
        )
    slide, hinge = mujoco.mjtJoint.mjJNT_SLIDE, mujoco.mjtJoint.mjJNT_HINGE
    axes = {"x": [1.0, 0.0, 0.0], "y": [0.0, 1.0, 0.0], "z": [0.0, 0.0, 1.0]}
    for name, axis in axes.items():
        stage.add_joint(name=name, type=slide, axis=axis, armature=armature)
        _add_servo(spec, name, servo.MASS, arm)
    stage.add_joint(name="theta", type=hinge, axis=axes["z"], armature=servo.INERTIA)
    _add_servo(spec, "theta", servo.INERTIA, arm)


def _add_servo(spec: mujoco.MjSpec, joint: str, mass: float, arm: Servo) -> None:
    w = servo.frequency(arm)
    motor = spec.add_actuator(name=joint, target=joint, trntype=mujoco.mjtTrn.mjTRN_JOINT)
    motor.set_to_position(kp=mass * w**2, kv=2 * mass * w)


def _add_jaw_shapes(tool: mujoco.MjsBody, size: Tool, cable: Cable) -> None:
    """What a picture shows of the jaws: two plates that hold the cable; they touch nothing."""
    root = cable.free_length - size.length
    for side in (-1, 1):
        tool.add_geom(
            name=f"jaw{side:+d}", type=mujoco.mjtGeom.mjGEOM_BOX, mass=0.0, contype=0,
            conaffinity=0, rgba=JAW_RGBA,
            pos=[0.0, side * (1.5e-3 + cable.thickness / 2), root + 6e-3],
            size=[cable.width / 2 + 1e-3, 1.5e-3, 6e-3],
        )  # fmt: skip
