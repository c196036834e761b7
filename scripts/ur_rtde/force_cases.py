"""Force mode, contact and force sensing of RTDEControlInterface, on the plant's own contact."""

import time

from case import NEVER, Case, Cases
from expect import becomes, equal, near, true_soon
from robot import CONTACT, STIFFNESS, Robot

FRAME = [0.0] * 6
ALONG_Z = [0, 0, 1, 0, 0, 0]
DOWN = [0.0, 0.0, -10.0, 0.0, 0.0, 0.0]
LIMITS = [0.1, 0.1, 0.05, 0.5, 0.5, 0.5]
SINCE_5_4 = (NEVER, (5, 4))
SINCE_5_9 = (NEVER, (5, 9))
SINCE_5_10 = (NEVER, (5, 10))
ANY = [0.0] * 6


def _press(robot: Robot) -> None:
    equal(robot.control.forceMode(FRAME, ALONG_Z, DOWN, 2, LIMITS), True)


def force_mode(robot: Robot) -> None:
    """10 N on the plate, as deep in it as its stiffness says, and nowhere else."""
    robot.hover()
    before = robot.receive.getActualTCPPose()
    _press(robot)
    try:
        becomes(lambda: [robot.push()], [10.0], 1.0)
        becomes(lambda: [robot.height()], [CONTACT - 10.0 / STIFFNESS], 0.3e-3)
        near(robot.receive.getActualTCPPose()[:2], before[:2], 0.5e-3)
    finally:
        robot.control.forceModeStop()


def force_mode_stop(robot: Robot) -> None:
    robot.hover()
    _press(robot)
    time.sleep(0.1)
    equal(robot.control.forceModeStop(), True)
    robot.stands()
    equal(robot.control.moveL(robot.shifted(z=0.02), 0.2, 1.0), True)


def _fall(robot: Robot) -> float:
    """How far the arm sinks in free space within 0.3 s of a 10 N pull, m."""
    start = robot.height()
    _press(robot)
    time.sleep(0.3)
    depth = start - robot.height()
    robot.control.forceModeStop()
    return depth


def damping(robot: Robot) -> None:
    """A force mode with more damping sinks more slowly."""
    equal(robot.control.forceModeSetDamping(1.0), True)
    slow = _fall(robot)
    equal(robot.control.forceModeSetDamping(0.0), True)
    fast = _fall(robot)
    robot.control.forceModeSetDamping(0.025)
    assert slow < fast, f"sank {slow:.4f} m with full damping, {fast:.4f} m with none"


def gain_scaling(robot: Robot) -> None:
    equal(robot.control.forceModeSetGainScaling(0.25), True)
    slow = _fall(robot)
    equal(robot.control.forceModeSetGainScaling(2.0), True)
    fast = _fall(robot)
    robot.control.forceModeSetGainScaling(1.0)
    assert 0 < slow < fast, f"sank {slow:.4f} m at gain 0.25, {fast:.4f} m at gain 2"


def _lean(robot: Robot) -> None:
    """Half a millimetre into the plate: 5 N."""
    robot.hover()
    robot.control.moveL(robot.shifted(z=-4.5e-3), 0.05, 0.5)
    robot.stands()


def zero_ft_sensor(robot: Robot) -> None:
    """The load of the moment reads zero; without it the sensor reads the opposite."""
    robot.hover()
    equal(robot.control.zeroFtSensor(), True)
    _lean(robot)
    becomes(lambda: [robot.push()], [5.0], 1.0)
    equal(robot.control.zeroFtSensor(), True)
    becomes(lambda: [robot.push()], [0.0], 0.3)
    robot.hover()
    becomes(lambda: [robot.push()], [-5.0], 1.0)
    equal(robot.control.zeroFtSensor(), True)
    becomes(lambda: [robot.push()], [0.0], 0.3)


def move_until_contact(robot: Robot) -> None:
    """Ends at the first point of contact."""
    robot.hover()
    equal(robot.control.moveUntilContact([0, 0, -0.02, 0, 0, 0]), True)
    becomes(lambda: [robot.height()], [CONTACT], 1e-3)


def tool_contact(robot: Robot) -> None:
    """Positive in contact, zero away from it; a call returns what the one before found."""
    robot.hover()
    true_soon(lambda: robot.control.toolContact(ANY) == 0, "no contact above the plate")
    equal(robot.control.speedL([0, 0, -0.02, 0, 0, 0], 0.5), True)
    true_soon(lambda: robot.push() > 10, "10 N")
    true_soon(lambda: robot.control.toolContact(ANY) > 0, "contact", 3.0)
    robot.control.speedStop()


def contact_detection(robot: Robot) -> None:
    """A running move meets the plate: contact is told, and the arm stops there."""
    robot.hover()
    robot.control.moveL(robot.shifted(z=0.012), 0.1, 1.0)  # time to begin before it is touched
    robot.control.moveL(robot.shifted(z=-0.03), 0.02, 0.5, True)
    equal(robot.control.startContactDetection(), True)
    equal(robot.control.readContactDetection(), False)
    true_soon(lambda: robot.push() > 1.0, "met the plate")
    time.sleep(0.5)  # a question while contact is met makes the client's script forget to stop
    robot.stands()
    becomes(lambda: [robot.height()], [CONTACT], 1e-3)
    equal(robot.control.readContactDetection(), True)
    equal(robot.control.stopContactDetection(), True)


def stop_contact_detection(robot: Robot) -> None:
    """Without contact there is none to tell."""
    robot.hover()
    equal(robot.control.startContactDetection(), True)
    equal(robot.control.stopContactDetection(), False)


def _watch_slowly(robot: Robot) -> None:
    """A program with a watchdog of its own gets none for the external wrench, which nobody sends:
    that one would pause it after 0.1 s.
    """
    equal(robot.control.setWatchdog(0.02), True)


def ft_rtde_input(robot: Robot) -> None:
    """The wrench then comes from RTDE, where nobody writes one, and not from contact."""
    _lean(robot)
    _watch_slowly(robot)
    becomes(lambda: [robot.push()], [5.0], 1.0)
    equal(robot.control.ftRtdeInputEnable(True), True)
    becomes(lambda: [robot.push()], [0.0], 0.3)
    equal(robot.control.ftRtdeInputEnable(False), True)
    becomes(lambda: [robot.push()], [5.0], 1.0)


def external_sensor(robot: Robot) -> None:
    _lean(robot)
    _watch_slowly(robot)
    equal(robot.control.enableExternalFtSensor(True), True)
    becomes(lambda: [robot.push()], [0.0], 0.3)
    equal(robot.control.enableExternalFtSensor(False), True)
    becomes(lambda: [robot.push()], [5.0], 1.0)


def external_wrench(robot: Robot) -> None:
    wrench = [1.0, 2.0, 3.0, 0.1, 0.2, 0.3]
    _watch_slowly(robot)
    robot.control.enableExternalFtSensor(True)
    try:
        equal(robot.control.setExternalForceTorque(wrench), True)
        becomes(robot.receive.getActualTCPForce, wrench, 0.1, limit=1.0)
    finally:
        robot.control.enableExternalFtSensor(False)


CASES: Cases = {
    "forceMode": Case(force_mode),
    "forceModeStop": Case(force_mode_stop),
    "forceModeSetDamping": Case(damping),
    "forceModeSetGainScaling": Case(
        gain_scaling, (NEVER, (5, 0)), lambda robot: robot.control.forceModeSetGainScaling(0.5)
    ),
    "zeroFtSensor": Case(zero_ft_sensor),
    "moveUntilContact": Case(
        move_until_contact,
        SINCE_5_4,
        lambda robot: robot.control.moveUntilContact([0, 0, -0.02, 0, 0, 0]),
    ),
    "toolContact": Case(tool_contact, SINCE_5_4, lambda robot: robot.control.toolContact(ANY)),
    "startContactDetection": Case(
        contact_detection, SINCE_5_4, lambda robot: robot.control.startContactDetection()
    ),
    "readContactDetection": Case(
        contact_detection, SINCE_5_4, lambda robot: robot.control.readContactDetection()
    ),
    "stopContactDetection": Case(
        stop_contact_detection, SINCE_5_4, lambda robot: robot.control.stopContactDetection()
    ),
    "ftRtdeInputEnable": Case(
        ft_rtde_input, SINCE_5_9, lambda robot: robot.control.ftRtdeInputEnable(False)
    ),
    "enableExternalFtSensor": Case(external_sensor),
    "setExternalForceTorque": Case(
        external_wrench,
        bug="sends the wrench as a data package of the wrong size, which a controller discards",
    ),
}
