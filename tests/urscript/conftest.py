"""An in-memory robot for programs, and the two ways tests run one on it."""

from collections.abc import Callable, Iterator, Sequence

import pytest

from hil.cell.arm.sockets import Sockets
from hil.cell.arm.urscript import Runtime, RuntimeStatus, compile_program

Vector6 = tuple[float, float, float, float, float, float]
ZERO6: Vector6 = (0.0,) * 6


class FakeForce:
    """Remembers what force control was asked for; pushes with what the test says."""

    def __init__(self) -> None:
        self.felt: Vector6 = (3.0, 4.0, 12.0, 0.0, 0.0, 0.0)
        self.freedrive = False
        self.calls: list[tuple[object, ...]] = []
        self.contact = 0
        self.past: dict[int, Vector6] = {0: ZERO6}

    def wrench(self) -> Vector6:
        return self.felt

    def zero(self) -> None:
        self.calls.append(("zero",))

    def believe(self, external: bool, at: tuple[float, float, float]) -> None:
        self.calls.append(("believe", external, at))

    def start(self, *task: object) -> None:
        if task[3] not in (1, 2, 3):
            raise ValueError("no such type")
        self.calls.append(("start", *task))

    def release(self, frame: Vector6, selection: tuple[bool, ...]) -> None:
        self.freedrive = True
        self.calls.append(("release", frame, selection))

    def end(self) -> None:
        self.freedrive = False
        self.calls.append(("end",))

    def damp(self, damping: float) -> None:
        self.calls.append(("damp", damping))

    def scale(self, gain: float) -> None:
        self.calls.append(("scale", gain))

    def cycles_since_contact(self, direction: tuple[float, float, float]) -> int:
        return self.contact

    def joints_before(self, cycles: int) -> Vector6:
        if cycles not in self.past:
            raise ValueError("not remembered")
        return self.past[cycles]


class FakePort:
    """A robot that stands where its last set-point was, and whose pose equals its joints."""

    def __init__(self, period: int = 8_000_000) -> None:
        self.period = period
        self.t = 0
        self.q = ZERO6
        self.qd = ZERO6
        self.inputs: dict[int, int] = {}
        self.float_inputs: dict[int, float] = {}
        self.outputs: dict[int, int | float | bool] = {}
        self.digital: dict[int, bool] = {}
        self.messages: list[str] = []
        self.setpoints: list[Vector6 | None] = []
        self.watched: list[tuple[str, float, str]] = []
        self.stops: list[str] = []
        self.tcp = ZERO6
        self.load = (0.0, (0.0, 0.0, 0.0), ZERO6)
        self.force = FakeForce()
        self.sockets = Sockets()
        self.slider = 1.0
        self.gravity = (0.0, 0.0, 9.82)
        self.voltage = 0
        self.analog = [0.0] * 4
        self.domains: dict[int, bool] = {}
        self.runstates: dict[int, int] = {}
        self.flags: dict[int, bool] = {}
        self.tool_modes: dict[int | None, int] = {}
        self.off = False
        self._tail: list[Vector6] = []
        self._next: Vector6 | None = None

    def end_cycle(self) -> None:
        if self._next is None and self._tail:
            self._next = self._tail.pop(0)
        self.setpoints.append(self._next)
        after = self._next or self.q
        rate = 1e9 / self.period
        self.qd = tuple((b - a) * rate for a, b in zip(self.q, after, strict=True))
        self.q = after
        self._next = None
        self.t += self.period

    def input_integer(self, index: int) -> int:
        return self.inputs.get(index, 0)

    def input_float(self, index: int) -> float:
        return self.float_inputs.get(index, 0.0)

    def input_boolean(self, index: int) -> bool:
        return bool(self.inputs.get(index, 0))

    def written_integer(self, index: int) -> int:
        return self.outputs.get(index, 0)

    written_float = written_boolean = written_integer

    def output_integer(self, index: int, value: int) -> None:
        self.outputs[index] = value

    def output_float(self, index: int, value: float) -> None:
        self.outputs[index] = value

    def output_boolean(self, index: int, value: bool) -> None:
        self.outputs[index] = value

    def digital_input(self, bit: int) -> bool:
        return self.digital.get(bit, False)

    def set_digital_output(self, bit: int, on: bool) -> None:
        self.digital[bit] = on

    def digital_output(self, bit: int) -> bool:
        return self.digital.get(bit, False)

    def analog_input(self, index: int) -> float:
        return self.analog[index]

    analog_output = analog_input

    def set_analog_output(self, index: int, ratio: float) -> None:
        self.analog[index] = ratio * 10.0

    def set_analog_domain(self, index: int, *, voltage: bool) -> None:
        self.domains[index] = voltage

    def set_runstate(self, bit: int, choice: int) -> None:
        self.runstates[bit] = choice

    def flag(self, index: int) -> bool:
        return self.flags.get(index, False)

    def set_flag(self, index: int, on: bool) -> None:
        self.flags[index] = on

    def set_tool_mode(self, output: int | None, mode: int) -> None:
        self.tool_modes[output] = mode

    def random(self) -> float:
        return 0.25

    def power_down(self) -> None:
        self.off = True

    def set_tool_voltage(self, volts: int) -> None:
        self.voltage = volts

    def actual_q(self) -> Vector6:
        return self.q

    target_q = actual_tcp_pose = target_tcp_pose = actual_q

    def actual_qd(self) -> Vector6:
        return self.qd

    target_qd = actual_tcp_speed = target_tcp_speed = actual_qd

    def target_qdd(self) -> Vector6:
        return ZERO6

    def joint_torques(self) -> Vector6:
        return self.force.felt

    def jacobian(self, q: Sequence[float]) -> tuple[Vector6, ...]:
        return tuple(tuple(float(i == j) for j in range(6)) for i in range(6))

    def refusal(self, q: Sequence[float]) -> str | None:
        return "too far" if max(map(abs, q)) > 6.3 else None

    def tcp_offset(self) -> Vector6:
        return self.tcp

    def set_tcp(self, pose: Vector6) -> None:
        self.tcp = pose

    def payload(self) -> tuple[float, tuple[float, float, float], Vector6]:
        return self.load

    def set_payload(
        self, mass: float, cog: tuple[float, float, float], inertia: Vector6 | None = None
    ) -> None:
        self.load = (mass, cog, inertia or self.load[2])

    def set_gravity(self, gravity: tuple[float, float, float]) -> None:
        self.gravity = gravity

    def forward_kin(self, q: Sequence[float], tcp: Vector6 | None) -> Vector6:
        return tuple(q)

    def inverse_kin(
        self, pose: Vector6, near: Sequence[float] | None, tcp: Vector6 | None
    ) -> Vector6:
        if max(map(abs, pose[:3])) > 1.0:
            raise ValueError("out of reach")
        return pose

    def servo_q(self, q: Sequence[float]) -> None:
        self._next = tuple(q)
        self._tail = []

    def coast(self, points: Sequence[Vector6]) -> None:
        self._tail = list(points)

    def coasting(self) -> tuple[Vector6, ...]:
        return tuple(self._tail)

    def speed_limits(self) -> tuple[float, float]:
        return 1000.0, 1000.0

    def speed_fraction(self) -> float:
        return self.slider

    def brake(self, deceleration: float) -> bool:
        loss = deceleration * self.period * 1e-9
        qd = [0.0 if abs(v) <= loss else v - loss if v > 0 else v + loss for v in self.qd]
        self._next = tuple(q + v * self.period * 1e-9 for q, v in zip(self.q, qd, strict=True))
        return not any(qd)

    def message(self, text: str) -> None:
        self.messages.append(text)

    def popup(self, text: str, title: str, **kind: bool) -> None:
        self.messages.append(f"{title}: {text}")

    def protective_stop(self, reason: str) -> None:
        self.stops.append(reason)

    def watch(self, register: str, minimum_frequency: float, action: str) -> None:
        self.watched.append((register, minimum_frequency, action))


@pytest.fixture(scope="session")
def robots() -> type[FakePort]:
    """For tests that need a new robot for each of hypothesis' examples."""
    return FakePort


@pytest.fixture
def robot() -> Iterator[FakePort]:
    robot = FakePort()
    yield robot
    robot.sockets.close_all()


@pytest.fixture
def start(robot) -> Callable[[str], Runtime]:
    """Compile a program on the robot without running it."""
    return lambda text: Runtime(compile_program(text), robot)


@pytest.fixture
def run(robot, start) -> Callable[..., Runtime]:
    """Run a program until it ends, or for so many control cycles."""

    def run(text: str, cycles: int = 1000) -> Runtime:
        runtime = start(text)
        for _ in range(cycles):
            runtime.step()
            robot.end_cycle()
            if runtime.status is not RuntimeStatus.RUNNING:
                break
        return runtime

    return run


@pytest.fixture
def said(robot, run) -> Callable[[str], list[str]]:
    """What a program that ends well has put into the log."""

    def said(text: str) -> list[str]:
        runtime = run(text)
        assert runtime.status is RuntimeStatus.FINISHED, runtime.error
        return robot.messages

    return said
