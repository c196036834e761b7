"""The record of the real-time interface: a size, then doubles, every control period.

Each version sends the record of the one before it, and more (UR's client interface manual, tables
"RealTime 3.2" to "RealTime 5.10"; where it dates only one series, the other's twin is assumed).
"""

import struct
from collections.abc import Sequence
from typing import Final, NamedTuple

from drivers.protocol.errors import WireError

_SIZE: Final = struct.Struct(">i")

FIELDS: Final = (
    ("time", 1), ("q_target", 6), ("qd_target", 6), ("qdd_target", 6), ("i_target", 6),
    ("m_target", 6), ("q_actual", 6), ("qd_actual", 6), ("i_actual", 6), ("i_control", 6),
    ("tool_vector_actual", 6), ("tcp_speed_actual", 6), ("tcp_force", 6),
    ("tool_vector_target", 6), ("tcp_speed_target", 6), ("digital_input_bits", 1),
    ("motor_temperatures", 6), ("controller_timer", 1), ("test_value", 1), ("robot_mode", 1),
    ("joint_modes", 6), ("safety_mode", 1), ("unused_1", 6), ("tool_accelerometer", 3),
    ("unused_2", 6), ("speed_scaling", 1), ("linear_momentum_norm", 1), ("unused_3", 2),
    ("v_main", 1), ("v_robot", 1), ("i_robot", 1), ("v_actual", 6), ("digital_outputs", 1),
    ("program_state", 1), ("elbow_position", 3), ("elbow_velocity", 3), ("safety_status", 1),
    ("unused_4", 3), ("payload_mass", 1), ("payload_cog", 3), ("payload_inertia", 6),
)  # fmt: skip
"""Name and count of doubles, in order."""


class _Growth(NamedTuple):
    """Doubles of a record, and the first versions with that many."""

    doubles: int
    cb3: tuple[int, int]
    e_series: tuple[int, int]


_GROWTH: Final = (
    _Growth(152, (3, 15), (5, 10)),
    _Growth(142, (3, 14), (5, 9)),
    _Growth(139, (3, 10), (5, 4)),
    _Growth(138, (3, 5), (5, 0)),
    _Growth(132, (3, 2), (5, 0)),
)


def doubles_of(version: Sequence[int]) -> int:
    """How many doubles a controller of this version sends; ValueError before 3.2."""
    for growth in _GROWTH:
        if tuple(version[:2]) >= (growth.cb3 if version[0] < 5 else growth.e_series):
            return growth.doubles
    raise ValueError(f"the real-time record of version {version[0]}.{version[1]} is not known")


class Record:
    """The record of one controller version."""

    __slots__ = ("_struct", "size")

    def __init__(self, version: Sequence[int]) -> None:
        self._struct = struct.Struct(f">i{doubles_of(version)}d")
        self.size = self._struct.size

    @property
    def doubles(self) -> int:
        return (self.size - _SIZE.size) // 8

    def pack(self, values: Sequence[float]) -> bytes:
        """The record; `values` beyond what this version sends are left out."""
        return self._struct.pack(self.size, *values[: self.doubles])

    def unpack(self, record: bytes) -> dict[str, tuple[float, ...]]:
        """The values by name, as far as this version sends them; WireError for another size."""
        if len(record) != self.size or _SIZE.unpack_from(record)[0] != self.size:
            raise WireError(f"real-time record of {len(record)} bytes, allowed are {self.size}")
        _, *values = self._struct.unpack(record)
        found, at = {}, 0
        for name, count in FIELDS:
            if at + count > len(values):
                break
            found[name] = tuple(values[at : at + count])
            at += count
        return found
