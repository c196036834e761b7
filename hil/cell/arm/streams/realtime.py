"""The real-time port's record of a control period, read off the control box as RTDE reads it."""

from collections.abc import Callable
from itertools import chain
from typing import Final

from drivers.protocol.realtime import FIELDS, Record
from hil.cell.arm.box import ControlBox
from hil.cell.arm.variables import Reader, readers

_VARIABLES: Final = {
    "time": "timestamp",
    "q_target": "target_q",
    "qd_target": "target_qd",
    "qdd_target": "target_qdd",
    "i_target": "target_current",
    "m_target": "target_moment",
    "q_actual": "actual_q",
    "qd_actual": "actual_qd",
    "i_actual": "actual_current",
    "i_control": "joint_control_output",
    "tool_vector_actual": "actual_TCP_pose",
    "tcp_speed_actual": "actual_TCP_speed",
    "tcp_force": "actual_TCP_force",
    "tool_vector_target": "target_TCP_pose",
    "tcp_speed_target": "target_TCP_speed",
    "digital_input_bits": "actual_digital_input_bits",
    "motor_temperatures": "joint_temperatures",
    "controller_timer": "actual_execution_time",
    "robot_mode": "robot_mode",
    "joint_modes": "joint_mode",
    "safety_mode": "safety_mode",
    "tool_accelerometer": "actual_tool_accelerometer",
    "speed_scaling": "speed_scaling",
    "linear_momentum_norm": "actual_momentum",
    "v_main": "actual_main_voltage",
    "v_robot": "actual_robot_voltage",
    "i_robot": "actual_robot_current",
    "v_actual": "actual_joint_voltage",
    "digital_outputs": "actual_digital_output_bits",
    "program_state": "runtime_state",
    "elbow_position": "elbow_position",
    "elbow_velocity": "elbow_velocity",
    "safety_status": "safety_status",
    "payload_mass": "payload",
    "payload_cog": "payload_cog",
    "payload_inertia": "payload_inertia",
}
"""RTDE's name of each field; those left out are unused."""


def recorder(box: ControlBox) -> Callable[[], bytes]:
    """What makes the record of the present period."""
    record = Record(box.version)
    table = readers(box)
    sources = [_source(table, name, count) for name, count in FIELDS]

    def record_now() -> bytes:
        return record.pack(list(chain.from_iterable(source() for source in sources)))

    return record_now


def _source(table: dict[str, Reader], field: str, count: int) -> Callable[[], tuple[float, ...]]:
    """A field's doubles, whatever RTDE sends for it."""
    variable = _VARIABLES.get(field)
    if variable is None:
        nothing = (0.0,) * count
        return lambda: nothing
    read = table[variable]
    return (lambda: (read(),)) if count == 1 else read  # type: ignore[return-value]  # by FIELDS
