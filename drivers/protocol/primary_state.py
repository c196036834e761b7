"""Sub-packages of the robot state that the primary and secondary interfaces send at 10 Hz.

Layouts: UR's client interface manual, "Robot state message", 3.15 and 5.11; sizes agree with the
capture of a controller in UR's client library. `int32 size, uint8 type` precede each.
"""

import struct
from collections.abc import Iterable, Mapping
from enum import IntEnum
from types import MappingProxyType
from typing import Final, TypeAlias

from drivers.protocol.errors import WireError
from drivers.protocol.primary import HEADER, PackageType, encode

Values: TypeAlias = tuple[object, ...]


class StateType(IntEnum):
    ROBOT_MODE = 0
    JOINTS = 1
    TOOL = 2
    MASTERBOARD = 3
    CARTESIAN = 4
    KINEMATICS = 5
    CONFIGURATION = 6
    FORCE_MODE = 7
    ADDITIONAL = 8
    TOOL_COMMUNICATION = 11
    TOOL_MODE = 12


LAYOUTS: Final[Mapping[StateType, struct.Struct]] = MappingProxyType(
    {
        # timestamp; connected, enabled, powered, emergency stopped, protective stopped, program
        # running, program paused; robot mode, control mode; slider, scaling, slider's limit
        StateType.ROBOT_MODE: struct.Struct(">Q7?BB3dB"),
        # for each joint: q, target q, qd; current, voltage, motor temperature, unused; mode
        StateType.JOINTS: struct.Struct(">" + "dddffffB" * 6),
        # analog ranges and inputs; supply voltage, output voltage, current, temperature; mode
        StateType.TOOL: struct.Struct(">BBddfBffB"),
        # digital inputs, outputs; analog ranges, inputs; domains, outputs; temperature, robot
        # voltage, robot current, I/O current; safety mode, reduced, EUROMAP 67; unused; operational
        # mode selector, three-position enabling device, unused
        StateType.MASTERBOARD: struct.Struct(">IIBBddbbddffffB?BIBBB"),
        # TCP pose, TCP offset
        StateType.CARTESIAN: struct.Struct(">6d6d"),
        # checksums; DH theta, a, d, alpha; calibration status
        StateType.KINEMATICS: struct.Struct(">6I6d6d6d6dI"),
        # joint position limits, speed and acceleration limits; default joint speed, acceleration,
        # tool speed, acceleration, equivalent radius; DH a, d, alpha, theta; masterboard version,
        # controller box type, robot type, robot subtype
        StateType.CONFIGURATION: struct.Struct(">12d12d5d6d6d6d6d4i"),
        # wrench, dexterity
        StateType.FORCE_MODE: struct.Struct(">6dd"),
        # teach button, freedrive enabled, freedrive by I/O, unused
        StateType.ADDITIONAL: struct.Struct(">B??B"),
        # enabled; baud rate, parity, stop bits; receive and transmit idle characters
        StateType.TOOL_COMMUNICATION: struct.Struct(">?IIIff"),
        # output mode, modes of both digital outputs
        StateType.TOOL_MODE: struct.Struct(">BBB"),
    }
)


def encode_part(type: StateType, values: Values) -> bytes:
    """One sub-package."""
    body = LAYOUTS[type].pack(*values)
    return HEADER.pack(HEADER.size + len(body), type) + body


def encode_state(parts: Iterable[bytes]) -> bytes:
    """The package of these sub-packages."""
    return encode(PackageType.ROBOT_STATE, b"".join(parts))


def decode_state(body: bytes) -> dict[StateType, Values]:
    """The sub-packages of a ROBOT_STATE package that are known here, by type.

    What a newer controller adds at a sub-package's end is left out, as the manual asks.
    """
    found: dict[StateType, Values] = {}
    at = 0
    while at < len(body):
        if len(body) - at < HEADER.size:
            raise WireError(f"robot state ends within a header, {len(body) - at} bytes")
        size, kind = HEADER.unpack_from(body, at)
        if not HEADER.size <= size <= len(body) - at:
            raise WireError(f"robot state part {kind} of {size} bytes, {len(body) - at} are left")
        if kind in LAYOUTS:
            found[StateType(kind)] = _values(StateType(kind), body[at + HEADER.size : at + size])
        at += size
    return found


def _values(type: StateType, body: bytes) -> Values:
    layout = LAYOUTS[type]
    if len(body) < layout.size:
        raise WireError(f"robot state part {type.name} of {len(body)} bytes, needs {layout.size}")
    return layout.unpack_from(body)
