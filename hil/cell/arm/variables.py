"""Where each RTDE output variable's value comes from; a recipe becomes a list of calls.

What the emulation does not model has a constant, named as such: thermal, electrical and dynamic
quantities of the joints, EUROMAP 67, the tool's power supply.
"""

from collections.abc import Callable, Mapping
from functools import partial
from math import hypot
from operator import attrgetter, getitem
from types import MappingProxyType
from typing import Final, TypeAlias

from hil.cell.arm.box import ControlBox
from hil.cell.arm.pose import ZERO6, transpose, turn
from hil.cell.arm.registers import BITS, COUNT, Bank

Reader: TypeAlias = Callable[[], object]

GRAVITY: Final = 9.82  # m/s^2, what URControl itself assumes

MODELLED: Final[Mapping[str, str]] = MappingProxyType(
    {
        "timestamp": "seconds",
        "target_q": "servo.q",
        "target_qd": "servo.qd",
        "target_qdd": "servo.qdd",
        "target_TCP_pose": "target.pose",
        "target_TCP_speed": "target.twist",
        "actual_q": "measured.q",
        "actual_qd": "measured.qd",
        "actual_TCP_pose": "measured.pose",
        "actual_TCP_speed": "measured.twist",
        "actual_TCP_force": "estimate.wrench",
        "ft_raw_wrench": "measured.force",
        "tcp_offset": "tool.offset",
        "payload": "tool.mass",
        "payload_cog": "tool.centre_of_gravity",
        "payload_inertia": "tool.inertia",
        "robot_mode": "modes.robot",
        "safety_mode": "modes.safety",
        "safety_status": "modes.safety",
        "runtime_state": "modes.program",
        "joint_mode": "modes.joint_modes",
        "robot_status_bits": "modes.robot_bits",
        "safety_status_bits": "modes.safety_bits",
        "actual_digital_input_bits": "signals.inputs",
        "actual_digital_output_bits": "signals.outputs",
        "target_speed_fraction": "signals.speed_fraction",
        "tool_output_voltage": "signals.tool_voltage",
        "analog_io_types": "signals.analog_types",
        "tool_analog_input_types": "signals.tool_analog_types",
        "tool_output_mode": "signals.tool_mode",
    }
)
"""Attribute of the control box by variable."""

NOT_MODELLED: Final[Mapping[str, object]] = MappingProxyType(
    {
        "target_current": ZERO6,
        "target_moment": ZERO6,
        "actual_current": ZERO6,
        "actual_current_window": ZERO6,
        "actual_current_as_torque": ZERO6,
        "joint_control_output": ZERO6,
        "wrench_calc_from_currents": ZERO6,
        "actual_TCP_acceleration": ZERO6,
        "target_TCP_acceleration": ZERO6,
        "target_base_acceleration": ZERO6,
        "target_base_wrench": ZERO6,
        "target_gravity": (0.0, 0.0, GRAVITY),
        "joint_temperatures": (30.0,) * 6,
        "tool_temperature": 30.0,
        "actual_joint_voltage": (48.0,) * 6,
        "actual_main_voltage": 48.0,
        "actual_robot_voltage": 48.0,
        "actual_robot_current": 0.5,
        "actual_robot_energy_consumed": 0.0,
        "actual_robot_braking_energy_dissipated": 0.0,
        "actual_momentum": 0.0,
        "actual_execution_time": 0.0,
        "target_execution_time": 0.0,
        "joint_position_deviation_ratio": 0.0,
        "speed_scaling": 1.0,  # of the trajectory limiter; clients multiply it by the slider's
        "collision_detection_ratio": 0.0,
        "time_scale_source": 0,
        "script_control_line": 0,
        "io_current": 0.0,
        "tool_mode": 253,
        "tool_output_current": 0.0,
        "euromap67_input_bits": 0,
        "euromap67_output_bits": 0,
        "euromap67_24V_voltage": 0.0,
        "euromap67_24V_current": 0.0,
        "encoder0_raw": 0,
        "encoder1_raw": 0,
    }
)


def readers(box: ControlBox) -> dict[str, Reader]:
    """What reads each variable from `box` as it is at the time of the call."""
    table: dict[str, Reader] = {n: partial(_constant, v) for n, v in NOT_MODELLED.items()}
    table |= {name: partial(attrgetter(path), box) for name, path in MODELLED.items()}
    table |= _bank_readers("input", box.registers.inputs)
    table |= _bank_readers("output", box.registers.outputs)
    return table | _analog_readers(box) | _derived_readers(box)


def _constant(value: object) -> object:
    return value


def _bank_readers(side: str, bank: Bank) -> dict[str, Reader]:
    table: dict[str, Reader] = {}
    for n in range(COUNT):
        table[f"{side}_int_register_{n}"] = partial(getitem, bank.integers, n)
        table[f"{side}_double_register_{n}"] = partial(getitem, bank.floats, n)
    for n in range(64, BITS):
        table[f"{side}_bit_register_{n}"] = partial(getitem, bank.booleans, n)
    for first in (0, 32):
        table[f"{side}_bit_registers{first}_to_{first + 31}"] = partial(bank.word, first)
    return table


def _analog_readers(box: ControlBox) -> dict[str, Reader]:
    table: dict[str, Reader] = {}
    for n in (0, 1):
        table[f"tool_analog_input{n}"] = partial(getitem, box.signals.tool_analog_inputs, n)
        table[f"tool_digital_output{n}_mode"] = partial(getitem, box.signals.tool_output_modes, n)
        table[f"standard_analog_input{n}"] = partial(getitem, box.signals.analog_inputs, n)
        table[f"standard_analog_output{n}"] = partial(getitem, box.signals.analog_outputs, n)
    return table


def _derived_readers(box: ControlBox) -> dict[str, Reader]:
    signals, measured, kinematics = box.signals, box.measured, box.kinematics
    return {
        "control_step": lambda: box.t // box.period,
        "tcp_force_scalar": lambda: hypot(*box.estimate.wrench[:3]),
        "elbow_position": lambda: kinematics.elbow(measured.q),
        "elbow_velocity": lambda: kinematics.elbow_velocity(measured.q, measured.qd),
        "actual_configurable_digital_input_bits": lambda: signals.inputs >> 8 & 0xFF,
        "actual_configurable_digital_output_bits": lambda: signals.outputs >> 8 & 0xFF,
        # At rest an accelerometer feels the table's push: +g along the base's z.
        "actual_tool_accelerometer": lambda: turn(
            transpose(measured.flange.rotation), (0.0, 0.0, GRAVITY)
        ),
    }
