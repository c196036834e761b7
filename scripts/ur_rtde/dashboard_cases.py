"""Every call of DashboardClient, with RTDE as the witness of what it did."""

from collections.abc import Callable

from case import Case, Cases
from expect import equal, true_soon
from robot import RUNNING, Robot

POWER_OFF = 3
MISSING = "no_such_program.urp"


def _says(call: str, wanted: str) -> Case:
    """The answer holds the wanted words."""

    def check(robot: Robot) -> None:
        found = getattr(robot.dashboard, call)()
        assert wanted in found, f"answered {found!r}, wanted {wanted!r}"

    return Case(check)


def _accepted(call: str, *arguments: str) -> Case:
    """Taken without an error, and the dashboard goes on answering."""

    def check(robot: Robot) -> None:
        getattr(robot.dashboard, call)(*arguments)
        equal(robot.dashboard.robotmode(), "Robotmode: RUNNING")

    return Case(check)


def connect(robot: Robot) -> None:
    robot.dashboard.disconnect()
    equal(robot.dashboard.isConnected(), False)
    robot.dashboard.connect()
    equal(robot.dashboard.isConnected(), True)
    equal(robot.dashboard.robotmode(), "Robotmode: RUNNING")


def leave(robot: Robot) -> None:
    robot.dashboard.quit()
    robot.dashboard.disconnect()
    robot.dashboard.connect()
    equal(robot.dashboard.robotmode(), "Robotmode: RUNNING")


def power(robot: Robot) -> None:
    """Off ends the program; on and brakes released, the robot runs."""
    robot.dashboard.powerOff()
    true_soon(lambda: robot.receive.getRobotMode() == POWER_OFF, "POWER_OFF")
    robot.dashboard.powerOn()
    true_soon(lambda: robot.receive.getRobotMode() not in {POWER_OFF, RUNNING}, "powering on")
    robot.dashboard.brakeRelease()
    true_soon(lambda: robot.receive.getRobotMode() == RUNNING, "RUNNING")


def restart_safety(robot: Robot) -> None:
    robot.dashboard.restartSafety()
    true_soon(lambda: robot.receive.getRobotMode() == POWER_OFF, "POWER_OFF")
    robot.power_up()


def pause_and_play(robot: Robot) -> None:
    """A paused program goes on where it was."""
    robot.dashboard.pause()
    true_soon(lambda: robot.receive.getRuntimeState() == 4, "PAUSED")
    robot.dashboard.play()
    true_soon(lambda: robot.receive.getRuntimeState() == 2, "PLAYING")


def stop(robot: Robot) -> None:
    robot.dashboard.stop()
    true_soon(lambda: robot.receive.getRuntimeState() == 1, "STOPPED")


def running(robot: Robot) -> None:
    """Of the pendant's program: one that came by socket is not it, as URSim 3.15 has it."""
    equal(robot.control.isProgramRunning(), True)
    equal(robot.dashboard.running(), False)


def program_state(robot: Robot) -> None:
    found = robot.dashboard.programState()
    assert found.startswith("STOPPED"), found


def _refusal(call: Callable[[], object]) -> str:
    """What the client's error says."""
    try:
        call()
    except Exception as refused:
        return str(refused)
    raise AssertionError("accepted, wanted a refusal")


def unlock(robot: Robot) -> None:
    """Not within 5 s of the stop."""
    robot.control.triggerProtectiveStop()
    true_soon(robot.receive.isProtectiveStopped, "protective stop")
    early = _refusal(robot.dashboard.unlockProtectiveStop)
    assert "5s" in early, early
    robot.unlock()


def load(robot: Robot) -> None:
    """A program that is not there is said to be missing."""
    missing = _refusal(lambda: robot.dashboard.loadURP(MISSING))
    assert MISSING in missing, missing


def serial_number(robot: Robot) -> None:
    assert robot.dashboard.getSerialNumber().isdigit(), "not a number"


def remote_control(robot: Robot) -> None:
    equal(robot.dashboard.isInRemoteControl(), True)


def version(robot: Robot) -> None:
    major, minor = robot.version
    assert robot.dashboard.polyscopeVersion().startswith(f"{major}.{minor}."), "another version"


def model(robot: Robot) -> None:
    assert robot.dashboard.getRobotModel().startswith("UR5"), robot.dashboard.getRobotModel()


def saved(robot: Robot) -> None:
    equal(robot.dashboard.isProgramSaved() in {True, False}, True)


def send_and_receive(robot: Robot) -> None:
    robot.dashboard.send("robotmode\n")
    equal(robot.dashboard.receive(), "Robotmode: RUNNING")


def role(robot: Robot) -> None:
    robot.dashboard.setUserRole("programmer")  # type: ignore[arg-type]


def _no_call(_: Robot) -> None:
    raise AssertionError("not called")


SINCE_5_6 = ((4, 0), (5, 6))

CASES: Cases = {
    "connect": Case(connect),
    "disconnect": Case(connect),
    "isConnected": Case(connect),
    "quit": Case(leave),
    "powerOn": Case(power),
    "powerOff": Case(power),
    "brakeRelease": Case(power),
    "restartSafety": Case(restart_safety),
    "pause": Case(pause_and_play),
    "play": Case(pause_and_play),
    "stop": Case(stop),
    "running": Case(running),
    "programState": Case(program_state),
    "unlockProtectiveStop": Case(unlock),
    "closeSafetyPopup": _accepted("closeSafetyPopup"),
    "popup": _accepted("popup", "hello"),
    "closePopup": _accepted("closePopup"),
    "addToLog": _accepted("addToLog", "hello"),
    "loadURP": Case(load),
    "getLoadedProgram": _says("getLoadedProgram", "rogram"),
    "isProgramSaved": Case(saved),
    "robotmode": _says("robotmode", "Robotmode: RUNNING"),
    "safetymode": _says("safetymode", "Safetymode: NORMAL"),
    "safetystatus": _says("safetystatus", "Safetystatus: NORMAL"),
    "polyscopeVersion": Case(version),
    "getRobotModel": Case(model),
    "getSerialNumber": Case(serial_number, SINCE_5_6, lambda robot: robot.dashboard.robotmode()),
    "isInRemoteControl": Case(
        remote_control, SINCE_5_6, lambda robot: robot.dashboard.isInRemoteControl()
    ),
    "send": Case(send_and_receive),
    "receive": Case(send_and_receive),
    "setUserRole": Case(role, bug="its argument's type, UserRole, is not exported to Python"),
    "shutdown": Case(
        _no_call, bug="would end the cell; `shutdown` itself is in the dashboard's tests"
    ),
}
