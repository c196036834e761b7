"""Settings, kinematics and questions of RTDEControlInterface."""

import math
import time
from collections.abc import Iterator
from contextlib import contextmanager

from case import NEVER, Case, Cases, Check
from expect import becomes, equal, near, true_soon
from robot import Robot

ZERO = [0.0] * 6
FAR = [5.0, 0.0, 0.3, 3.14, 0.0, 0.0]
TOOL = [0.0, 0.0, 0.12, 0.0, 0.0, 0.0]
RAISES = "the client raises an error: it reads registers that it did not ask for"
SINCE_5_23 = (NEVER, (5, 23))
HAS_SOLUTION = ((3, 15), (5, 10))


def _below(pose: list[float], length: float) -> list[float]:
    """A tool that looks down has its tip below the flange."""
    return [pose[0], pose[1], pose[2] - length, *pose[3:]]


@contextmanager
def mounted(robot: Robot) -> Iterator[list[float]]:
    """The tool as TCP for the block, which gets the flange's pose; all see the flange after it."""
    flange = robot.receive.getActualTCPPose()
    try:
        equal(robot.control.setTcp(TOOL), True)
        yield flange
    finally:
        robot.control.setTcp(ZERO)
        becomes(robot.receive.getActualTCPPose, flange, 0.2e-3)


def set_tcp(robot: Robot) -> None:
    with mounted(robot) as flange:
        becomes(robot.receive.getActualTCPPose, _below(flange, TOOL[2]), 0.2e-3)


def tcp_offset(robot: Robot) -> None:
    with mounted(robot):
        near(robot.control.getTCPOffset(), TOOL, 1e-6)


def flange_pose(robot: Robot) -> None:
    """Told apart from the TCP's; a call returns what the one before found."""
    with mounted(robot) as flange:
        becomes(robot.control.getActualToolFlangePose, flange, 0.2e-3)


def set_payload(robot: Robot) -> None:
    equal(robot.control.setPayload(1.25, [0.01, 0.02, 0.03]), True)
    becomes(lambda: [robot.receive.getPayload()], [1.25], 1e-6)
    near(robot.receive.getPayloadCog(), [0.01, 0.02, 0.03], 1e-6)
    robot.control.setPayload(0.6, [0.0, 0.0, 0.06])


def set_target_payload(robot: Robot) -> None:
    inertia = [0.01, 0.02, 0.03, 0.001, 0.002, 0.003]
    equal(robot.control.setTargetPayload(1.5, [0.0, 0.0, 0.05], inertia), True)
    becomes(lambda: [robot.receive.getPayload()], [1.5], 1e-6)
    near(robot.receive.getPayloadInertia(), inertia, 1e-6)
    robot.control.setPayload(0.6, [0.0, 0.0, 0.06])


def set_gravity(robot: Robot) -> None:
    """A wall mount is taken; the arm stands, its script goes on."""
    try:
        equal(robot.control.setGravity([9.82, 0.0, 0.0]), True)
        robot.stands()
        equal(robot.control.isProgramRunning(), True)
    finally:
        robot.control.setGravity([0.0, 0.0, 9.82])


def inverse(robot: Robot) -> None:
    near(robot.control.getInverseKinematics(robot.shifted()), robot.receive.getTargetQ(), 1e-3)


def inverse_near(robot: Robot) -> None:
    """The solution near given joints: the other way round the last wrist joint."""
    other = [*robot.home[:5], robot.home[5] - 2 * math.pi]
    found = robot.control.getInverseKinematics(robot.shifted(), other)
    near([math.remainder(a - b, math.tau) for a, b in zip(found, other, strict=True)], ZERO, 1e-3)


def has_solution(robot: Robot) -> None:
    equal(robot.control.getInverseKinematicsHasSolution(robot.shifted()), True)
    equal(robot.control.getInverseKinematicsHasSolution(FAR), False)


def forward(robot: Robot) -> None:
    near(robot.control.getForwardKinematics(), robot.receive.getTargetTCPPose(), 0.2e-3)


def forward_q_tcp(robot: Robot) -> None:
    found = robot.control.getForwardKinematics(robot.home, TOOL)
    near(found, _below(robot.receive.getActualTCPPose(), TOOL[2]), 0.5e-3)


def forward_q(robot: Robot) -> None:
    q = robot.turned(0, 0.3)
    near([*robot.control.getForwardKinematics(q)[2:3]], [robot.height()], 0.5e-3)


def forward_tcp(robot: Robot) -> None:
    found = robot.control.getForwardKinematics([], TOOL)
    near(found, _below(robot.receive.getActualTCPPose(), TOOL[2]), 0.5e-3)


def pose_trans(robot: Robot) -> None:
    """A quarter turn about z carries x to y."""
    frame = [0.1, 0.2, 0.3, 0.0, 0.0, math.pi / 2]
    found = robot.control.poseTrans(frame, [0.5, 0.0, 0.0, 0.0, 0.0, 0.0])
    near(found, [0.1, 0.7, 0.3, 0.0, 0.0, math.pi / 2], 1e-6)


def pose_safe(robot: Robot) -> None:
    equal(robot.control.isPoseWithinSafetyLimits(robot.shifted()), True)
    equal(robot.control.isPoseWithinSafetyLimits(FAR), False)


def joints_safe(robot: Robot) -> None:
    equal(robot.control.isJointsWithinSafetyLimits(robot.home), True)
    equal(robot.control.isJointsWithinSafetyLimits(robot.turned(0, 7.0)), False)


def is_steady(robot: Robot) -> None:
    true_soon(robot.control.isSteady, "steady at rest")
    robot.control.moveJ(robot.turned(0, 0.2), 0.3, 1.0, True)
    true_soon(lambda: robot.receive.getActualQd()[0] > 0.1, "arm moving")
    equal(robot.control.isSteady(), False)
    robot.control.stopJ(2.0)


def joints_history(robot: Robot) -> None:
    becomes(lambda: robot.control.getActualJointPositionsHistory(0), robot.home, 1e-3)


def target_waypoint(robot: Robot) -> None:
    target = robot.shifted(y=0.05)
    robot.control.moveL(target, 0.05, 0.5, True)
    becomes(robot.control.getTargetWaypoint, target, 1e-4, limit=1.0)
    robot.control.stopL(2.0)


def joint_torques(robot: Robot) -> None:
    """Six finite numbers, the same as long as the arm stands; see `becomes` on the first call."""
    robot.control.getJointTorques()
    time.sleep(0.1)
    found = robot.control.getJointTorques()
    equal(len(found), 6)
    becomes(robot.control.getJointTorques, found, 1.0)


def step_time(robot: Robot) -> None:
    becomes(lambda: [robot.control.getStepTime()], [robot.step], 1e-9)


def robot_status(robot: Robot) -> None:
    """Power on, program running."""
    equal(robot.control.getRobotStatus() & 3, 3)


def teach_mode(robot: Robot) -> None:
    """The arm stands, taken by no hand, and moves again afterwards."""
    equal(robot.control.teachMode(), True)
    robot.stands()
    equal(robot.control.isProgramRunning(), True)
    equal(robot.control.endTeachMode(), True)
    target = robot.turned(0, 0.05)
    equal(robot.control.moveJ(target, 1.0, 3.0), True)
    becomes(robot.receive.getActualQ, target, 2e-3)


def freedrive(robot: Robot) -> None:
    equal(robot.control.freedriveMode(), True)
    robot.stands()
    equal(robot.control.isProgramRunning(), True)
    equal(robot.control.endFreedriveMode(), True)
    target = robot.turned(0, 0.05)
    equal(robot.control.moveJ(target, 1.0, 3.0), True)
    becomes(robot.receive.getActualQ, target, 2e-3)


def freedrive_status(robot: Robot) -> None:
    """Far from every singularity: normal operation."""
    robot.control.freedriveMode()
    try:
        equal(robot.control.getFreedriveStatus(), 0)
    finally:
        robot.control.endFreedriveMode()


def direct_torque(robot: Robot) -> None:
    equal(robot.control.directTorque(ZERO), True)
    robot.stands()


def torque_below(robot: Robot) -> None:
    robot.control.directTorque(ZERO)
    true_soon(lambda: not robot.control.isProgramRunning(), "the controller ends the script")
    robot.restart_script()


def raises(name: str) -> Check:
    """The client asks for registers that it has not subscribed to."""

    def check(robot: Robot) -> None:
        try:
            getattr(robot.control, name)()
        except RuntimeError:
            return
        raise AssertionError("no error")

    return check


def matrix(name: str) -> Case:
    """A 6 x 6 matrix of dynamics, from 5.23 on."""

    def check(robot: Robot) -> None:
        found = getattr(robot.control, name)()
        equal(len(found), 36)
        assert any(found), "all zero"

    return Case(check, SINCE_5_23, raises(name), below=RAISES)


def vector(name: str) -> Case:
    """Six numbers of dynamics, zero at rest, from 5.23 on."""
    return Case(
        lambda robot: near(getattr(robot.control, name)(), ZERO, 1e-3),
        SINCE_5_23,
        lambda robot: getattr(robot.control, name)(),
    )


SINCE_5_10 = (NEVER, (5, 10))

CASES: Cases = {
    "setTcp": Case(set_tcp),
    "getTCPOffset": Case(tcp_offset),
    "getActualToolFlangePose": Case(flange_pose),
    "setPayload": Case(set_payload),
    "setTargetPayload": Case(
        set_target_payload, SINCE_5_10, lambda robot: robot.control.setTargetPayload(1.0, [0, 0, 0])
    ),
    "setGravity": Case(set_gravity),
    "getInverseKinematics": Case(inverse),
    "getInverseKinematics (near)": Case(inverse_near),
    "getInverseKinematicsHasSolution": Case(
        has_solution,
        HAS_SOLUTION,
        lambda robot: robot.control.getInverseKinematicsHasSolution(robot.shifted()),
    ),
    "getForwardKinematics": Case(forward),
    "getForwardKinematics (joints and TCP)": Case(forward_q_tcp),
    "getForwardKinematics (joints)": Case(
        forward_q, bug="sends no TCP, and the script takes what the registers last held for one"
    ),
    "getForwardKinematics (TCP)": Case(
        forward_tcp, bug="sends a data package of the wrong size, which a controller discards"
    ),
    "poseTrans": Case(pose_trans),
    "isPoseWithinSafetyLimits": Case(pose_safe),
    "isJointsWithinSafetyLimits": Case(joints_safe),
    "isSteady": Case(is_steady),
    "getActualJointPositionsHistory": Case(
        joints_history,
        (NEVER, (5, 4)),
        lambda robot: robot.control.getActualJointPositionsHistory(0),
    ),
    "getTargetWaypoint": Case(
        target_waypoint, (NEVER, (5, 3)), lambda robot: robot.control.getTargetWaypoint()
    ),
    "getJointTorques": Case(joint_torques),
    "getStepTime": Case(step_time, (NEVER, (5, 4)), lambda robot: robot.control.getStepTime()),
    "getRobotStatus": Case(robot_status),
    "teachMode": Case(teach_mode),
    "endTeachMode": Case(teach_mode),
    "freedriveMode": Case(freedrive, SINCE_5_10, lambda robot: robot.control.freedriveMode()),
    "endFreedriveMode": Case(freedrive, SINCE_5_10, lambda robot: robot.control.endFreedriveMode()),
    "getFreedriveStatus": Case(
        freedrive_status, SINCE_5_10, lambda robot: robot.control.getFreedriveStatus()
    ),
    "directTorque": Case(
        direct_torque,
        (NEVER, (5, 26)),
        torque_below,
        below="the client's script then loops without end, and the controller ends it",
    ),
    "getMassMatrix": matrix("getMassMatrix"),
    "getJacobian": matrix("getJacobian"),
    "getJacobianTimeDerivative": Case(
        lambda robot: equal(len(robot.control.getJacobianTimeDerivative()), 36),
        SINCE_5_23,
        raises("getJacobianTimeDerivative"),
        below=RAISES,
    ),
    "getCoriolisAndCentrifugalTorques": vector("getCoriolisAndCentrifugalTorques"),
    "getTargetJointAccelerations": vector("getTargetJointAccelerations"),
}
