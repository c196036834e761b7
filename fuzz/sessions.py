"""Targets of whole sessions: what any client may send to any port of box and sensor.

Bytes go in as TCP would bring them, periods pass in between, and the box must go on.
"""

from itertools import count, repeat
from typing import Final

import numpy as np

from drivers.protocol import nrs_tcp, rtde, rtde_setup
from drivers.protocol.errors import WireError
from drivers.protocol.frame import CanFrame
from drivers.protocol.nrs_can import Identifiers
from drivers.protocol.rtde_states import RobotMode
from fuzz.target import Target
from hil.cell.arm.connection import Session
from hil.cell.arm.controller import ArmController
from hil.cell.arm.dashboard_commands import COMMANDS
from hil.cell.arm.dashboard_session import DashboardSession
from hil.cell.arm.modes import Event
from hil.cell.arm.rtde_session import RtdeSession
from hil.cell.arm.script_session import ScriptSession
from hil.cell.arm.streams.stream import PrimaryStream
from hil.cell.rig.robot import Robot
from hil.cell.rig.sensor import Sensor
from hil.cell.sensor.node import SensorNode
from hil.cell.sensor.tcp_session import TcpSession

ZERO6: Final = (0.0,) * 6
PIECE: Final = 48
PERIODS: Final = 3
READY: Final = 2_000_000_000
STRIDE: Final = 250_000_000
"""Between two looks at a box that wakes up: nothing moves, so most periods can be left out."""
NEWEST: Final = "5.21.0.1"


def running_arm() -> ArmController:
    """An arm in free space with its brakes open."""
    robot = Robot(series="e-series", model="ur5e", version=NEWEST)
    arm = ArmController(robot, np.random.default_rng(1))
    arm.box.post(Event.BRAKE_RELEASE)
    for _ in range(READY // STRIDE):
        arm.box.t += STRIDE
        periods(arm, 1)
    assert arm.box.modes.robot is RobotMode.RUNNING, "the brakes take longer than READY"
    return arm


def periods(arm: ArmController, number: int) -> None:
    """Pass so many control periods."""
    for _ in range(number):
        target = arm.frame(arm.box.t)
        arm.observe(arm.box.t + arm.box.period, target.flange, ZERO6, ZERO6, False)


def check(session: Session, arm: ArmController, octets: bytes) -> None:
    """Feed a session in pieces, with control periods between them."""
    steps = count(1)
    try:
        for at in range(0, len(octets), PIECE):
            session.receive(octets[at : at + PIECE], arm.box.t)
            periods(arm, 1)
            session.publish(next(steps))
    except WireError:
        pass
    finally:
        session.close()
    periods(arm, PERIODS)
    arm.box.sockets.close_all()


def check_rtde(octets: bytes) -> None:
    arm = running_arm()
    check(RtdeSession(arm, 1, repeat(0)), arm, octets)


def check_dashboard(octets: bytes) -> None:
    arm = running_arm()
    check(DashboardSession(arm), arm, octets)


def check_script(octets: bytes) -> None:
    arm = running_arm()
    check(ScriptSession(arm, PrimaryStream(arm.box)), arm, octets)


def check_sensor(octets: bytes) -> None:
    """CAN commands of the first half, TCP bytes of the second, on one node."""
    sensor = Sensor()
    node = SensorNode(sensor, np.random.default_rng(1))
    session = TcpSession(node, sensor)
    half, t, period = len(octets) // 2, READY, 8_000_000
    wrenches = np.zeros((8, 6))
    node.advance(t, wrenches)
    try:
        for at in range(0, half, 8):
            command = CanFrame(Identifiers.of(1).command, octets[at : min(at + 8, half)])
            node.receive(command, t)
            session.receive(octets[half + at : half + at + 8], t)
            t += period
            node.advance(t, wrenches)
            session.publish(t)
    except WireError:
        return


def _package(kind: rtde.PackageType, payload: bytes = b"") -> bytes:
    return rtde.encode(kind, payload)


_SET_UP = (
    _package(rtde.PackageType.REQUEST_PROTOCOL_VERSION, rtde_setup.encode_protocol_version(2))
    + _package(rtde.PackageType.SETUP_OUTPUTS, rtde_setup.encode_names(("actual_q",), 125.0))
    + _package(rtde.PackageType.SETUP_INPUTS, rtde_setup.encode_names(("input_int_register_0",)))
    + _package(rtde.PackageType.START)
    + _package(rtde.PackageType.DATA, b"\1\0\0\0\5")
)
_SCRIPTS = (
    b"def p():\n while True:\n  sync()\n end\nend\n",
    b"sec s():\n set_digital_out(1, True)\nend\n",
    b"movej([0,-1.5,1.5,-1.5,-1.5,0], a=1.4, v=1)\n",
)

TARGETS = {
    "rtde-session": Target(
        check_rtde,
        (_SET_UP, _SET_UP * 2),
        (b"speed_slider_mask", b"external_force_torque", b"standard_analog_output_mask", b"\0\3S"),
    ),
    "dashboard-session": Target(
        check_dashboard,
        tuple(f"{name}\n".encode() for name in COMMANDS),
        (b"play\n", b"power on\n", b"/programs/x.urp"),
    ),
    "script-session": Target(check_script, _SCRIPTS, (b"end\n", b"def ", b"power off\n", b'"')),
    "sensor-session": Target(
        check_sensor, (bytes(32), b"\7\1\1\0\0\0\0\0" + nrs_tcp.encode(7, 1)), (b"\3\x15\1",)
    ),
}
