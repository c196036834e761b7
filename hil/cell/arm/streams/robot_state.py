"""The robot state that the primary and secondary ports send, read off the control box.

What the emulation does not model has the constants that `variables` gives RTDE for it.
"""

from itertools import chain
from typing import Final

from drivers.protocol.primary_state import StateType, Values, encode_part, encode_state
from drivers.protocol.rtde_states import RuntimeState, SafetyMode
from hil.cell.arm.box import ControlBox
from hil.cell.arm.streams.dh import table

S: Final = StateType

ROBOT_TYPES: Final = {
    "ur5": 1, "ur5e": 1, "ur7e": 1, "ur10": 2, "ur10e": 2, "ur12e": 2, "ur3": 3, "ur3e": 3,
    "ur16e": 4, "ur18": 5, "ur8long": 6, "ur20": 7, "ur30": 8, "ur15": 9,
}  # fmt: skip
"""Numbers of UR's client library (datatypes.h); UR7e and UR12e are renamed UR5e and UR10e."""

_EMERGENCIES: Final = (SafetyMode.ROBOT_EMERGENCY_STOP, SafetyMode.SYSTEM_EMERGENCY_STOP)
_JOINT: Final = (0.0, 48.0, 30.0, 0.0)  # current, A; voltage, V; temperature, degC; unused
_DEFAULTS: Final = (1.05, 1.4, 0.25, 1.2, 0.0)
"""Joint speed, rad/s, and acceleration, tool speed, m/s, and acceleration that scripts default to
(Script Manual, movej and movel), and no equivalent radius."""
_ACCELERATION: Final = 40.0
"""Joint acceleration limit, rad/s^2; assumed."""


def first_state(box: ControlBox) -> bytes:
    """The package that a new connection gets first: the state, and what never changes."""
    return encode_state((*_parts(box), _kinematics(box), _configuration(box)))


def state(box: ControlBox) -> bytes:
    """The package of every tenth of a second."""
    return encode_state(_parts(box))


def _parts(box: ControlBox) -> tuple[bytes, ...]:
    parts = (
        encode_part(S.ROBOT_MODE, _robot_mode(box)),
        encode_part(S.JOINTS, _joints(box)),
        encode_part(S.CARTESIAN, (*box.measured.pose, *box.tool.offset)),
        encode_part(S.MASTERBOARD, _masterboard(box)),
        encode_part(S.TOOL, (1, 1, 0.0, 0.0, 48.0, 0, 0.0, 30.0, box.modes.joint_modes[5])),
        encode_part(S.FORCE_MODE, (*box.measured.force, 1.0)),
        encode_part(S.ADDITIONAL, (0, True, False, 0)),
    )
    return parts if box.version[0] < 5 else (*parts, *_TOOL_PARTS)


_TOOL_PARTS: Final = (
    encode_part(S.TOOL_COMMUNICATION, (False, 115200, 0, 1, 1.5, 3.5)),
    encode_part(S.TOOL_MODE, (0, 1, 1)),
)
"""The e-Series tool's serial line, which is off, at its factory settings."""


def _robot_mode(box: ControlBox) -> Values:
    modes = box.modes
    stopped = modes.safety is SafetyMode.PROTECTIVE_STOP
    program = (modes.program is RuntimeState.PLAYING, modes.program is RuntimeState.PAUSED)
    flags = (True, modes.powered, modes.powered, modes.safety in _EMERGENCIES, stopped, *program)
    speed = (box.signals.speed_fraction, 1.0, 1.0)
    return (box.t, *flags, modes.robot, 0, *speed, 0)


def _joints(box: ControlBox) -> Values:
    angles = zip(box.measured.q, box.servo.q, box.measured.qd, box.modes.joint_modes, strict=True)
    return tuple(chain.from_iterable((q, to, qd, *_JOINT, mode) for q, to, qd, mode in angles))


def _masterboard(box: ControlBox) -> Values:
    signals, types = box.signals, box.signals.analog_types
    inputs = (types & 1, types >> 1 & 1, *signals.analog_inputs[:2])
    outputs = (types >> 2 & 1, types >> 3 & 1, *signals.analog_outputs)
    electrical = (30.0, 48.0, 0.5, 0.0)
    safety = (box.modes.safety, box.modes.safety is SafetyMode.REDUCED)
    return (signals.inputs, signals.outputs, *inputs, *outputs, *electrical, *safety, 0, 0, 1, 1, 1)


def _kinematics(box: ControlBox) -> bytes:
    dh = table(box.kinematics)
    rows = (*dh.checksums, *dh.theta, *dh.a, *dh.d, *dh.alpha)
    return encode_part(S.KINEMATICS, (*rows, 0))


def _configuration(box: ControlBox) -> bytes:
    dh, limits = table(box.kinematics), box.robot.safety
    positions = (-limits.joint_range, limits.joint_range) * 6
    motions = (limits.joint_speed, _ACCELERATION) * 6
    rows = (*dh.a, *dh.d, *dh.alpha, *dh.theta)
    board = (box.version[0], box.version[0], ROBOT_TYPES[box.robot.model], 1)
    return encode_part(S.CONFIGURATION, (*positions, *motions, *_DEFAULTS, *rows, *board))
