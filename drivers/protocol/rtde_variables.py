"""The variables RTDE can carry, their types, and the first software that knows each.

Types: RTDE guide and record_configuration.xml of UR's client library. First versions: the guide;
where it gives none, 3.4.0 and 5.0.0, the first software with RTDE. Variables only UR's ROS client
library lists have no published first version: CB3 answers NOT_FOUND unless seen there, and
e-Series is assumed to know them from 5.0.0.
"""

from collections.abc import Iterable, Iterator, Mapping
from types import MappingProxyType
from typing import Final, NamedTuple, TypeAlias

from drivers.protocol.rtde import FieldType

Version: TypeAlias = tuple[int, int, int]

_BOOL, _U8, _U32, _U64 = FieldType.BOOL, FieldType.UINT8, FieldType.UINT32, FieldType.UINT64
_I32, _DOUBLE = FieldType.INT32, FieldType.DOUBLE
_V3, _V6, _V6I = FieldType.VECTOR3D, FieldType.VECTOR6D, FieldType.VECTOR6INT32


class Variable(NamedTuple):
    """cb3, e_series: the first version that knows it, None for never."""

    name: str
    type: FieldType
    cb3: Version | None
    e_series: Version | None

    def known_to(self, version: tuple[int, ...]) -> bool:
        """Whether URControl of this version (major, minor, bugfix, ...) knows it."""
        first = self.cb3 if version[0] < 5 else self.e_series
        return first is not None and version[:3] >= first


_FIRST: Final = ((3, 4, 0), (5, 0, 0))
_UPPER: Final = ((3, 9, 0), (5, 3, 0))  # bit registers 64..127, number registers 24..47
_UNDATED: Final = (None, (5, 0, 0))
_ENERGY: Final = (None, (5, 23, 0))

_ALWAYS: Final = (
    (_DOUBLE, """timestamp actual_execution_time speed_scaling target_speed_fraction actual_momentum
        actual_main_voltage actual_robot_voltage actual_robot_current standard_analog_input0
        standard_analog_input1 standard_analog_output0 standard_analog_output1 io_current
        euromap67_24V_voltage euromap67_24V_current tool_analog_input0 tool_analog_input1
        tool_output_current tool_temperature tcp_force_scalar"""),
    (_V6, """target_q target_qd target_qdd target_current target_moment actual_q actual_qd
        actual_current joint_control_output actual_TCP_pose actual_TCP_speed actual_TCP_force
        target_TCP_pose target_TCP_speed joint_temperatures actual_joint_voltage"""),
    (_V3, "actual_tool_accelerometer"),
    (_V6I, "joint_mode"),
    (_I32, "robot_mode safety_mode tool_output_voltage"),
    (_U32, """runtime_state robot_status_bits safety_status_bits analog_io_types
        euromap67_input_bits euromap67_output_bits tool_mode tool_analog_input_types"""),
    (_U64, "actual_digital_input_bits actual_digital_output_bits"),
)  # fmt: skip

_LATER: Final = (
    (_I32, "safety_status", (3, 10, 0), (5, 4, 0)),
    (_V3, "elbow_position elbow_velocity", (3, 5, 0), (5, 0, 0)),
    (_DOUBLE, "payload", (3, 11, 0), (5, 5, 1)),
    (_V3, "payload_cog", (3, 11, 0), (5, 5, 1)),
    (_V6, "payload_inertia", (3, 15, 0), (5, 11, 0)),
    (_U32, "script_control_line", (3, 14, 0), (5, 9, 0)),
    (_V6, "ft_raw_wrench", None, (5, 9, 0)),
    (_V6, "tcp_offset", (3, 15, 8), (5, 0, 0)),  # reported on URSim 3.15.8
    (_U8, "tool_output_mode tool_digital_output0_mode tool_digital_output1_mode", *_UNDATED),
    (_V6, "actual_current_as_torque", *_ENERGY),
    (_DOUBLE, "actual_robot_energy_consumed actual_robot_braking_energy_dissipated", *_ENERGY),
    (_V6, """actual_current_window actual_TCP_acceleration target_TCP_acceleration
        wrench_calc_from_currents target_base_acceleration target_base_wrench""", *_UNDATED),
    (_V3, "target_gravity", *_UNDATED),
    (_U64, """actual_configurable_digital_input_bits actual_configurable_digital_output_bits
        control_step""", *_UNDATED),
    (_DOUBLE, """target_execution_time joint_position_deviation_ratio
        collision_detection_ratio""", *_UNDATED),
    (_I32, "encoder0_raw encoder1_raw time_scale_source", *_UNDATED),
)  # fmt: skip

_IO_INPUTS: Final = (
    (_U32, "speed_slider_mask"),
    (_DOUBLE, "speed_slider_fraction standard_analog_output_0 standard_analog_output_1"),
    (_U8, """standard_digital_output_mask standard_digital_output
        configurable_digital_output_mask configurable_digital_output
        tool_digital_output_mask tool_digital_output
        standard_analog_output_mask standard_analog_output_type"""),
    (_V6, "external_force_torque"),
)  # fmt: skip


def _since(type: FieldType, names: str, cb3: Version | None, e: Version | None) -> list[Variable]:
    return [Variable(name, type, cb3, e) for name in names.split()]


def _registers(side: str) -> Iterator[Variable]:
    """Registers of one side; numbers 0..23 and bits 0..63 are the fieldbus range."""
    for name in (f"{side}_bit_registers0_to_31", f"{side}_bit_registers32_to_63"):
        yield Variable(name, _U32, *_FIRST)
    for bit in range(64, 128):
        yield Variable(f"{side}_bit_register_{bit}", _BOOL, *_UPPER)
    for kind, type in (("int", _I32), ("double", _DOUBLE)):
        for n in range(48):
            yield Variable(f"{side}_{kind}_register_{n}", type, *(_FIRST if n < 24 else _UPPER))


def _outputs() -> Iterator[Variable]:
    for type, names in _ALWAYS:
        yield from _since(type, names, *_FIRST)
    for type, names, cb3, e_series in _LATER:
        yield from _since(type, names, cb3, e_series)
    yield from _registers("output")
    yield from _registers("input")  # read-back


def _inputs() -> Iterator[Variable]:
    for type, names in _IO_INPUTS:
        yield from _since(type, names, *_FIRST)
    yield from _registers("input")


def _by_name(variables: Iterable[Variable]) -> Mapping[str, Variable]:
    return MappingProxyType({variable.name: variable for variable in variables})


OUTPUTS: Final[Mapping[str, Variable]] = _by_name(_outputs())
"""What the controller can send."""

INPUTS: Final[Mapping[str, Variable]] = _by_name(_inputs())
"""What a client can set."""
