"""The robot as its URScript program sees it: `RobotPort` on the control box."""

from collections.abc import Sequence

from drivers.protocol.primary_messages import Text
from hil.cell.arm.box import ControlBox
from hil.cell.arm.pose import Vector6, compose, inverse, of, vector6, vector_of


class ScriptPort:
    """Implements `hil.cell.arm.port.RobotPort`; ValueError for an index or value out of range."""

    __slots__ = ("_box",)

    def __init__(self, box: ControlBox) -> None:
        self._box = box

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

    def tcp_force(self) -> Vector6:
        return self._box.measured.force

    def tcp_offset(self) -> Vector6:
        return self._box.tool.offset

    def set_tcp(self, pose: Vector6) -> None:
        self._box.tool.mount(vector6(pose))

    def set_payload(self, mass: float, cog: tuple[float, float, float]) -> None:
        self._box.tool.mass = mass
        self._box.tool.centre_of_gravity = cog

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

    def brake(self, deceleration: float) -> bool:
        return self._box.servo.brake(deceleration)

    def message(self, text: str) -> None:
        self._box.say(text)
        self._box.announce(Text(text))

    def protective_stop(self, reason: str) -> None:
        self._box.protective_stop(reason)

    def watch(self, register: str, minimum_frequency: float, action: str) -> None:
        self._box.watchdog.watch(register, minimum_frequency, action, self._box.t)


def _index(index: int, count: int) -> int:
    if not 0 <= index < count:
        raise ValueError(f"index must be 0..{count - 1}, found {index}")
    return index
