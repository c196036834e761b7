"""Connection, control script, watchdog and protective stop of RTDEControlInterface."""

import tempfile
import time
from pathlib import Path

from case import Case, Cases
from expect import becomes, equal, true_soon
from robot import Robot
from script_client import ScriptClient

OUTPUT = 5
"""Standard digital output that custom scripts set."""
SET_OUTPUT = f"set_standard_digital_out({OUTPUT}, True)"


def _still_moves(robot: Robot) -> None:
    target = robot.turned(0, 0.05)
    equal(robot.control.moveJ(target, 1.0, 3.0), True)
    becomes(robot.receive.getActualQ, target, 2e-3)


def _sets_output(robot: Robot, send: object) -> None:
    """The script that `send` sends sets the output, and the control script runs again after it."""
    robot.io.setStandardDigitalOut(OUTPUT, False)
    true_soon(lambda: not robot.receive.getDigitalOutState(OUTPUT), "output off")
    assert callable(send)
    assert send() is not False, "the call returned False"
    true_soon(lambda: robot.receive.getDigitalOutState(OUTPUT), "output on")
    true_soon(robot.control.isProgramRunning, "control script running")
    _still_moves(robot)


def _program() -> str:
    """A whole program that tells ur_rtde when it begins and when it has ended."""
    lines = (
        "def custom():",
        "  write_output_integer_register(0, 1)",
        f"  {SET_OUTPUT}",
        "  sleep(0.05)",
        "  write_output_integer_register(0, 2)",
        "end",
    )
    return "\n".join(lines) + "\n"


def send_custom_script(robot: Robot) -> None:
    _sets_output(robot, lambda: robot.control.sendCustomScript(_program()))


def send_custom_function(robot: Robot) -> None:
    body = f"{SET_OUTPUT}\nsleep(0.05)\n"
    _sets_output(robot, lambda: robot.control.sendCustomScriptFunction("custom", body))


def send_custom_file(robot: Robot) -> None:
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / "custom.script"
        path.write_text(_program())
        _sets_output(robot, lambda: robot.control.sendCustomScriptFile(str(path)))


def set_custom_file(robot: Robot) -> None:
    """A control script of one's own: the client's, which first sets an output."""
    script = ScriptClient(robot.host, *robot.version).getScript()
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / "control.script"
        path.write_text(f"def own_control():\n  {SET_OUTPUT}\n{script}\nend\n")
        _sets_output(robot, lambda: robot.control.setCustomScriptFile(str(path)))
        robot.control.setCustomScriptFile("")
    true_soon(robot.control.isProgramRunning, "the client's own script running")


def is_connected(robot: Robot) -> None:
    equal(robot.control.isConnected(), True)


def reconnect(robot: Robot) -> None:
    robot.control.disconnect()
    equal(robot.control.isConnected(), False)
    equal(robot.control.reconnect(), True)
    true_soon(robot.control.isProgramRunning, "control script running")
    _still_moves(robot)


def reupload(robot: Robot) -> None:
    equal(robot.control.reuploadScript(), True)
    true_soon(robot.control.isProgramRunning, "control script running")
    _still_moves(robot)


def stop_script(robot: Robot) -> None:
    equal(robot.control.isProgramRunning(), True)
    robot.control.stopScript()
    true_soon(lambda: not robot.control.isProgramRunning(), "script stopped")
    true_soon(lambda: robot.receive.getRuntimeState() == 1, "runtime state STOPPED")
    robot.restart_script()
    _still_moves(robot)


def protective_stop(robot: Robot) -> None:
    """Ends the program; after unlocking and a new upload the arm moves again."""
    robot.control.triggerProtectiveStop()
    true_soon(robot.receive.isProtectiveStopped, "protective stop")
    equal(robot.control.moveJ(robot.turned(0, 0.1)), False)
    robot.unlock()
    robot.restart_script()
    _still_moves(robot)


def watchdog(robot: Robot) -> None:
    """Kicked it stays quiet; left alone it stops the robot."""
    equal(robot.control.setWatchdog(2.0), True)
    end = time.monotonic() + 1.5
    while time.monotonic() < end:
        equal(robot.control.kickWatchdog(), True)
        time.sleep(0.05)
    equal(robot.receive.isProtectiveStopped(), False)
    equal(robot.control.isProgramRunning(), True)
    true_soon(lambda: not robot.control.isProgramRunning(), "the watchdog ends the program")
    if robot.receive.isProtectiveStopped():
        robot.unlock()
    robot.restart_script()
    _still_moves(robot)


CASES: Cases = {
    "isConnected": Case(is_connected),
    "isProgramRunning": Case(stop_script),
    "stopScript": Case(stop_script),
    "reuploadScript": Case(reupload),
    "disconnect": Case(reconnect),
    "reconnect": Case(reconnect),
    "sendCustomScript": Case(send_custom_script),
    "sendCustomScriptFunction": Case(send_custom_function),
    "sendCustomScriptFile": Case(send_custom_file),
    "setCustomScriptFile": Case(set_custom_file),
    "triggerProtectiveStop": Case(protective_stop),
    "setWatchdog": Case(watchdog),
    "kickWatchdog": Case(watchdog),
}
