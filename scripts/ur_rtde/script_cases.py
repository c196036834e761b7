"""Every call of ScriptClient, by whether the program that it sends runs."""

import tempfile
from pathlib import Path

from case import Case, Cases
from expect import equal, true_soon
from robot import Robot
from script_client import ScriptClient

OUTPUT = 7
PROGRAM = f"def lamp():\n  set_standard_digital_out({OUTPUT}, True)\n  sleep(0.1)\nend\n"


def _client(robot: Robot) -> ScriptClient:
    client = ScriptClient(robot.host, *robot.version)
    client.connect()
    return client


def _lamp_off(robot: Robot) -> None:
    robot.io.setStandardDigitalOut(OUTPUT, False)
    true_soon(lambda: not robot.receive.getDigitalOutState(OUTPUT), "output off")


def connect(robot: Robot) -> None:
    client = _client(robot)
    equal(client.isConnected(), True)
    client.disconnect()
    equal(client.isConnected(), False)


def command(robot: Robot) -> None:
    _lamp_off(robot)
    equal(_client(robot).sendScriptCommand(PROGRAM), True)
    true_soon(lambda: robot.receive.getDigitalOutState(OUTPUT), "output on")


def send_file(robot: Robot) -> None:
    _lamp_off(robot)
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / "lamp.script"
        path.write_text(PROGRAM)
        equal(_client(robot).sendScript(str(path)), True)
    true_soon(lambda: robot.receive.getDigitalOutState(OUTPUT), "output on")


def send_control_script(robot: Robot) -> None:
    """Sent again while it runs, the control script takes the old one's place."""
    robot.control.stopScript()
    true_soon(lambda: robot.receive.getRuntimeState() == 1, "STOPPED")
    client = _client(robot)
    client_script_needs_offset = "# float register offset\n"
    assert client_script_needs_offset in client.getScript(), "another control script"
    equal(client.sendScript(), True)
    true_soon(lambda: robot.receive.getRuntimeState() == 2, "PLAYING", 4.0)


def get_script(robot: Robot) -> None:
    """Nothing is left in it that this controller's version does not know."""
    script = ScriptClient(robot.host, *robot.version).getScript()
    assert "process_cmd" in script, "not a control script"
    equal("direct_torque(" in script, robot.version >= (5, 26))


def _no_call(_: Robot) -> None:
    raise AssertionError("not called")


CASES: Cases = {
    "connect": Case(connect),
    "disconnect": Case(connect),
    "isConnected": Case(connect),
    "sendScriptCommand": Case(command),
    "sendScript (file)": Case(send_file),
    "sendScript": Case(
        send_control_script,
        bug="of a client made alone: the script's register offsets are filled in by "
        "RTDEControlInterface only",
    ),
    "getScript": Case(get_script),
    "setScriptFile": Case(_no_call, bug="bound to Python without its argument; not called"),
}
