"""The robot as its URScript program sees it: `RobotPort` on the control box."""

from collections.abc import Sequence

import numpy as np

from drivers.protocol.primary_messages import Popup, Text
from hil.cell.arm.box import ControlBox
from hil.cell.arm.force.access import ForceAccess
from hil.cell.arm.modes import Event
from hil.cell.arm.pose import Vector3, Vector6, compose, inverse, of, vector6, vector_of
from hil.cell.arm.safety import out_of_range


class ScriptPort:
    """Implements `hil.cell.arm.port.RobotPort`; ValueError for an index or value out of range."""

    __slots__ = ("_box", "_rng", "force", "sockets")

    def __init__(self, box: ControlBox, rng: np.random.Generator) -> None:
        """rng: what `random` draws from."""
        self._box = box
        self._rng = rng
        self.force = ForceAccess(box)
        self.sockets = box.sockets

    @property
    def period(self) -> int:
        return self._box.period

    @property
    def t(self) -> int:
        return self._box.t

    def input_integer(self, index: int) -> int:
        return self._box.registers.inputs.integers[_index(index, 48)]

    def input_float(self, index: int) -> float:
        return self._box.registers.inputs.floats[_index(index, 48)]

    def input_boolean(self, index: int) -> bool:
        return self._box.registers.inputs.booleans[_index(index, 128)]

    def written_integer(self, index: int) -> int:
        return self._box.registers.outputs.integers[_index(index, 48)]

    def written_float(self, index: int) -> float:
        return self._box.registers.outputs.floats[_index(index, 48)]

    def written_boolean(self, index: int) -> bool:
        return self._box.registers.outputs.booleans[_index(index, 128)]

    def output_integer(self, index: int, value: int) -> None:
        if not -(2**31) <= value < 2**31:
            raise ValueError(f"an integer register holds 32 bits, found {value}")
        self._box.registers.outputs.integers[_index(index, 48)] = value

    def output_float(self, index: int, value: float) -> None:
        self._box.registers.outputs.floats[_index(index, 48)] = float(value)

    def output_boolean(self, index: int, value: bool) -> None:
        self._box.registers.outputs.booleans[_index(index, 128)] = value

    def digital_input(self, bit: int) -> bool:
        return bool(self._box.signals.inputs >> _index(bit, 18) & 1)

    def digital_output(self, bit: int) -> bool:
        return bool(self._box.signals.outputs >> _index(bit, 18) & 1)

    def analog_input(self, index: int) -> float:
        signals = self._box.signals
        return (*signals.analog_inputs, *signals.tool_analog_inputs)[_index(index, 4)]

    def analog_output(self, index: int) -> float:
        return self._box.signals.analog_outputs[_index(index, 2)]

    def set_analog_output(self, index: int, ratio: float) -> None:
        signals = self._box.signals
        voltage = bool(signals.analog_types >> (2 + _index(index, 2)) & 1)
        signals.set_analog(index, ratio, voltage=voltage)

    def set_analog_domain(self, index: int, *, voltage: bool) -> None:
        self._box.signals.set_domain(_index(index, 6), voltage=voltage)

    def set_runstate(self, bit: int, choice: int) -> None:
        self._box.signals.runstates[_index(bit, 18)] = choice

    def flag(self, index: int) -> bool:
        return bool(self._box.signals.flags >> _index(index, 32) & 1)

    def set_flag(self, index: int, on: bool) -> None:
        bit, flags = 1 << _index(index, 32), self._box.signals.flags
        self._box.signals.flags = flags | bit if on else flags & ~bit

    def set_tool_mode(self, output: int | None, mode: int) -> None:
        signals = self._box.signals
        if output is None:
            signals.tool_mode = mode
        else:
            signals.tool_output_modes[_index(output, 2)] = mode

    def random(self) -> float:
        return float(self._rng.random())

    def power_down(self) -> None:
        self._box.post(Event.POWER_OFF)

    def set_tool_voltage(self, volts: int) -> None:
        self._box.signals.tool_voltage = volts

    def set_digital_output(self, bit: int, on: bool) -> None:
        self._box.signals.set_output(_index(bit, 18), on)

    def actual_q(self) -> Vector6:
        return self._box.measured.q

    def target_q(self) -> Vector6:
        return self._box.servo.q

    def actual_qd(self) -> Vector6:
        return self._box.measured.qd

    def target_qd(self) -> Vector6:
        return self._box.servo.qd

    def actual_tcp_pose(self) -> Vector6:
        return self._box.measured.pose

    def target_tcp_pose(self) -> Vector6:
        return self._box.target.pose

    def actual_tcp_speed(self) -> Vector6:
        return self._box.measured.twist

    def target_qdd(self) -> Vector6:
        return self._box.servo.qdd

    def target_tcp_speed(self) -> Vector6:
        return self._box.target.twist

    def joint_torques(self) -> Vector6:
        rows = self.jacobian(self._box.measured.q)
        wrench = self._box.estimate.wrench
        a, b, c, d, e, f = (
            sum(rows[i][j] * wrench[i] for i in range(6)) for j in range(6)
        )  # J^T w
        return (a, b, c, d, e, f)

    def jacobian(self, q: Sequence[float]) -> tuple[Vector6, ...]:
        return self._box.kinematics.jacobian(q, self._box.tool.pose)

    def refusal(self, q: Sequence[float]) -> str | None:
        return out_of_range(q, self._box.robot.safety)

    def tcp_offset(self) -> Vector6:
        return self._box.tool.offset

    def set_tcp(self, pose: Vector6) -> None:
        self._box.tool.mount(vector6(pose))

    def payload(self) -> tuple[float, Vector3, Vector6]:
        tool = self._box.tool
        return tool.mass, tool.centre_of_gravity, tool.inertia

    def set_payload(self, mass: float, cog: Vector3, inertia: Vector6 | None = None) -> None:
        tool = self._box.tool
        tool.mass, tool.centre_of_gravity = mass, cog
        tool.inertia = tool.inertia if inertia is None else inertia

    def set_gravity(self, gravity: Vector3) -> None:
        self._box.estimate.gravity = gravity

    def forward_kin(self, q: Sequence[float], tcp: Vector6 | None) -> Vector6:
        tool = self._box.tool.pose if tcp is None else of(tcp)
        return vector_of(compose(self._box.kinematics.forward(q), tool))

    def inverse_kin(
        self, pose: Vector6, near: Sequence[float] | None, tcp: Vector6 | None
    ) -> Vector6:
        """Joint angles nearest `near` (default: the target), ValueError when there are none."""
        to_flange = self._box.tool.to_flange if tcp is None else inverse(of(tcp))
        flange = compose(of(pose), to_flange)
        return self._box.kinematics.inverse(flange, self._box.servo.q if near is None else near)

    def servo_q(self, q: Sequence[float]) -> None:
        a, b, c, d, e, f = q
        self._box.servo.command((float(a), float(b), float(c), float(d), float(e), float(f)))

    def coast(self, points: Sequence[Vector6]) -> None:
        self._box.servo.coast(points)

    def coasting(self) -> tuple[Vector6, ...]:
        return self._box.servo.coasting

    def speed_limits(self) -> tuple[float, float]:
        limits = self._box.robot.safety
        return limits.joint_speed, limits.tcp_speed

    def speed_fraction(self) -> float:
        return self._box.signals.speed_fraction

    def brake(self, deceleration: float) -> bool:
        return self._box.servo.brake(deceleration)

    def message(self, text: str) -> None:
        self._box.say(text)
        self._box.announce(Text(text))

    def popup(self, text: str, title: str, *, warning: bool, error: bool, blocking: bool) -> None:
        self._box.say(f"{title}: {text}")
        self._box.announce(Popup(title, text, warning, error, blocking))

    def protective_stop(self, reason: str) -> None:
        self._box.protective_stop(f"C209A0: {reason}")  # UR error code 209: by the program

    def watch(self, register: str, minimum_frequency: float, action: str) -> None:
        self._box.watchdog.watch(register, minimum_frequency, action, self._box.t)


def _index(index: int, count: int) -> int:
    if not 0 <= index < count:
        raise ValueError(f"index must be 0..{count - 1}, found {index}")
    return index
