"""Moves, servoing, speeds, jogging and stops of RTDEControlInterface, by where the arm gets."""

import math
import time

from case import Case, Cases
from expect import becomes, equal, near, true_soon, worst
from robot import Robot
from rtde_control import Path, PathEntry, RTDEControlInterface

JOINT = 2e-3  # rad
POSE = 1e-3  # m, rad


def move_j(robot: Robot) -> None:
    target = robot.turned(0, 0.15)
    equal(robot.control.moveJ(target, 1.0, 3.0), True)
    becomes(robot.receive.getActualQ, target, JOINT)


def move_j_path(robot: Robot) -> None:
    corner, target = robot.turned(0, 0.1), robot.turned(0, 0.2)
    path = [[*corner, 1.0, 3.0, 0.02], [*target, 1.0, 3.0, 0.0]]
    equal(robot.control.moveJ(path), True)
    becomes(robot.receive.getActualQ, target, JOINT)


def move_j_async(robot: Robot) -> None:
    target = robot.turned(0, 0.2)
    equal(robot.control.moveJ(target, 0.5, 2.0, True), True)
    assert worst(robot.receive.getActualQ(), target) > JOINT, "an asynchronous move had ended"
    becomes(robot.receive.getActualQ, target, JOINT)


def move_j_ik(robot: Robot) -> None:
    target = robot.shifted(x=0.03, z=-0.02)
    equal(robot.control.moveJ_IK(target, 1.0, 3.0), True)
    becomes(robot.receive.getActualTCPPose, target, POSE)


def move_l(robot: Robot) -> None:
    """Straight: what is not commanded to move stays where it is all the way."""
    target = robot.shifted(y=0.05)
    equal(robot.control.moveL(target, 0.2, 1.0, True), True)
    start = time.monotonic()
    while abs((pose := robot.receive.getActualTCPPose())[1] - target[1]) > POSE:
        near([pose[0], pose[2]], [target[0], target[2]], POSE)
        assert time.monotonic() < start + 10, "the target was not reached in 10 s"
    near(robot.receive.getActualTCPPose(), target, POSE)


def move_l_path(robot: Robot) -> None:
    corner, target = robot.shifted(x=0.03), robot.shifted(x=0.03, y=0.03)
    equal(robot.control.moveL([[*corner, 0.3, 1.5, 0.01], [*target, 0.3, 1.5, 0.0]]), True)
    becomes(robot.receive.getActualTCPPose, target, POSE)


def move_l_fk(robot: Robot) -> None:
    target = robot.turned(0, 0.1)
    equal(robot.control.moveL_FK(target, 0.3, 1.5), True)
    becomes(robot.receive.getActualQ, target, JOINT)


def _square(robot: Robot) -> tuple[Path, list[float]]:
    path, limits = Path(), [0.3, 1.5]
    corners = (robot.shifted(x=0.03), robot.shifted(x=0.03, y=0.03), robot.shifted(z=0.02))
    for corner, blend in zip(corners, (0.01, 0.01, 0.0), strict=True):
        entry = PathEntry(PathEntry.MoveL, PathEntry.PositionTcpPose, [*corner, *limits, blend])
        path.addEntry(entry)
    return path, corners[-1]


def move_path(robot: Robot) -> None:
    path, target = _square(robot)
    equal(robot.control.movePath(path, False), True)
    becomes(robot.receive.getActualTCPPose, target, POSE)


def move_path_progress(robot: Robot) -> None:
    """An asynchronous path tells its way-points one after the other and its end."""
    path, target = _square(robot)
    equal(robot.control.movePath(path, True), True)
    seen: list[int] = []
    true_soon(lambda: robot.control.getAsyncOperationProgress() >= 0, "a running operation")
    end = time.monotonic() + 20
    while (progress := robot.control.getAsyncOperationProgress()) >= 0:
        seen += [] if progress in seen else [progress]
        assert time.monotonic() < end, "the operation did not end in 20 s"
    equal(seen, sorted(seen))
    assert len(seen) > 1, f"progress was {seen}"
    becomes(robot.receive.getActualTCPPose, target, POSE)


def progress_ex(robot: Robot) -> None:
    before = robot.control.getAsyncOperationProgressEx()
    equal(before.isAsyncOperationRunning(), False)
    robot.control.moveJ(robot.turned(0, 0.1), 0.5, 2.0, True)
    running = robot.control.getAsyncOperationProgressEx
    true_soon(lambda: running().isAsyncOperationRunning(), "operation running")
    true_soon(lambda: not running().isAsyncOperationRunning(), "operation ended")
    assert running().operationId() != before.operationId(), "the operation had no id of its own"


def servo_j(robot: Robot) -> None:
    """A slow swing of the base joint is followed, and ends where the last target was."""
    q = robot.home
    for k in range(1, 101):
        start = robot.control.initPeriod()
        q = robot.turned(0, 0.05 * (1 - math.cos(math.pi * k / 100)))
        equal(robot.control.servoJ(q, 0.5, 0.5, 0.008, 0.1, 300), True)
        robot.control.waitPeriod(start)
    becomes(robot.receive.getActualQ, q, JOINT)
    robot.control.servoStop()


def servo_l(robot: Robot) -> None:
    first = robot.shifted()
    pose = first
    for k in range(1, 101):
        start = robot.control.initPeriod()
        pose = [first[0], first[1], first[2] + 0.01 * (1 - math.cos(math.pi * k / 100)), *first[3:]]
        equal(robot.control.servoL(pose, 0.5, 0.5, 0.008, 0.1, 300), True)
        robot.control.waitPeriod(start)
    becomes(robot.receive.getActualTCPPose, pose, POSE)
    robot.control.servoStop()


def servo_c(robot: Robot) -> None:
    """The client leaves this command standing, so that its next call times out once."""
    target = robot.shifted(x=0.03)
    equal(robot.control.servoC(target, 0.25, 1.2, 0.0), True)
    becomes(robot.receive.getActualTCPPose, target, POSE)
    true_soon(robot.control.servoStop, "servoing stopped", 15.0)


def servo_stop(robot: Robot) -> None:
    for k in range(30):
        robot.control.servoJ(robot.turned(0, 0.003 * k), 0.5, 0.5, 0.008, 0.1, 300)
        time.sleep(0.008)
    equal(robot.control.servoStop(), True)
    robot.stands()


def speed_j(robot: Robot) -> None:
    speed = [0.2, 0.0, 0.0, 0.0, 0.0, 0.0]
    equal(robot.control.speedJ(speed, 1.0), True)
    becomes(robot.receive.getActualQd, speed, 5e-3)
    robot.control.speedStop()


def speed_l(robot: Robot) -> None:
    speed = [0.0, 0.0, 0.05, 0.0, 0.0, 0.0]
    equal(robot.control.speedL(speed, 0.5), True)
    becomes(robot.receive.getActualTCPSpeed, speed, 2e-3)
    robot.control.speedStop()


def speed_stop(robot: Robot) -> None:
    robot.control.speedJ([0.2, 0, 0, 0, 0, 0], 1.0)
    true_soon(lambda: robot.receive.getActualQd()[0] > 0.1, "arm moving")
    equal(robot.control.speedStop(), True)
    robot.stands()


def stop_j(robot: Robot) -> None:
    target = robot.turned(0, 0.5)
    robot.control.moveJ(target, 0.3, 1.0, True)
    true_soon(lambda: robot.receive.getActualQd()[0] > 0.1, "arm moving")
    robot.control.stopJ(2.0)
    robot.stands()
    assert robot.receive.getActualQ()[0] < target[0] - 0.1, "the move went on"


def stop_l(robot: Robot) -> None:
    target = robot.shifted(z=0.10)
    robot.control.moveL(target, 0.1, 0.5, True)
    true_soon(lambda: robot.receive.getActualTCPSpeed()[2] > 0.03, "arm moving")
    robot.control.stopL(2.0)
    robot.stands()
    assert robot.height() < target[2] - 0.02, "the move went on"


def stop_l_async(robot: Robot) -> None:
    robot.control.moveL(robot.shifted(z=0.10), 0.1, 0.5, True)
    true_soon(lambda: robot.receive.getActualTCPSpeed()[2] > 0.03, "arm moving")
    robot.control.stopL(2.0, True)
    robot.stands()


def jog_start(robot: Robot) -> None:
    equal(robot.control.jogStart([0, 0, 0.03, 0, 0, 0]), True)
    becomes(robot.receive.getActualTCPSpeed, [0, 0, 0.03, 0, 0, 0], 2e-3)
    robot.control.jogStop()


def jog_start_tool(robot: Robot) -> None:
    """The tool looks down: its z is against the base's."""
    feature = RTDEControlInterface.FEATURE_TOOL
    equal(robot.control.jogStart([0, 0, -0.03, 0, 0, 0], feature), True)
    becomes(robot.receive.getActualTCPSpeed, [0, 0, 0.03, 0, 0, 0], 2e-3)
    robot.control.jogStop()


def jog_stop(robot: Robot) -> None:
    robot.control.jogStart([0, 0, 0.03, 0, 0, 0])
    true_soon(lambda: robot.receive.getActualTCPSpeed()[2] > 0.01, "arm moving")
    equal(robot.control.jogStop(), True)
    robot.stands()


def period(robot: Robot) -> None:
    """Twenty waited periods last no less than twenty periods of the controller."""
    begin = time.monotonic()
    for _ in range(20):
        start = robot.control.initPeriod()
        robot.control.waitPeriod(start)
    assert time.monotonic() - begin >= 0.95 * 20 * robot.step, "periods were too short"


CASES: Cases = {
    "moveJ": Case(move_j),
    "moveJ (path)": Case(move_j_path),
    "moveJ (asynchronous)": Case(move_j_async),
    "moveJ_IK": Case(move_j_ik),
    "moveL": Case(move_l),
    "moveL (path)": Case(move_l_path),
    "moveL_FK": Case(move_l_fk),
    "movePath": Case(move_path),
    "getAsyncOperationProgress": Case(move_path_progress),
    "getAsyncOperationProgressEx": Case(progress_ex),
    "servoJ": Case(servo_j),
    "servoL": Case(servo_l),
    "servoC": Case(servo_c),
    "servoStop": Case(servo_stop),
    "speedJ": Case(speed_j),
    "speedL": Case(speed_l),
    "speedStop": Case(speed_stop),
    "stopJ": Case(stop_j),
    "stopL": Case(stop_l),
    "stopL (asynchronous)": Case(stop_l_async),
    "jogStart": Case(jog_start),
    "jogStart (tool)": Case(jog_start_tool),
    "jogStop": Case(jog_stop),
    "initPeriod": Case(period),
    "waitPeriod": Case(period),
}
