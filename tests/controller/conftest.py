"""In-memory arm, sensor and gripper around one small world; time moves when the arm is told so."""

from math import cos, exp, isfinite, pi, sin

import pytest

from controller.frames import TaskFrame
from controller.loop import Loop
from controller.place import Place
from drivers.errors import NotReadyError, StaleSampleError
from drivers.interfaces import (
    ArmState,
    Freshness,
    RobotMode,
    SafetyMode,
    SensorHealth,
    Vector6,
    WrenchReading,
)

MS = 1_000_000
TURN = 0.3
FRAME = TaskFrame((0.45, -0.1, 0.05), TURN)
OMEGA = 2 * pi * 22.0
MAX_AGE = 10 * MS


class SpringWorld:
    """A stage with the arm's lag, a spring face at z = 0 and a slot in it, stepped at 1 ms.

    slot: x, y of the tip at which it falls in (m), None for a closed face. The slot's walls push
    back with 5 N/mm, its floor is 2.5 mm deep. mass: of the tool, which feels its inertia, kg.
    """

    def __init__(self, stiffness=16.5e3, slot=None, part=None, at=(0.0, 0.0, 0.02, 0.0), mass=0.0):
        self.stiffness = stiffness
        self.mass = mass
        self.acceleration = [0.0] * 3
        self.slot = slot
        self.part = part
        self.stage = list(at)
        self.velocity = [0.0] * 4
        self.jaws_closed = False
        self.holding = False
        self.inside = False
        self.extra = (0.0,) * 6

    def step(self, target, jaws_closed, duration):
        """Wrenches in the sensor frame, one a millisecond."""
        self._jaws(jaws_closed)
        wrenches = []
        for _ in range(duration // MS):
            before = self.velocity[:3]
            self._lag(target)
            pairs = zip(self.velocity, before, strict=False)
            self.acceleration = [(after - v) / 1e-3 for after, v in pairs]
            wrenches.append(self._wrench())
        return wrenches

    def _jaws(self, closed):
        if closed and not self.jaws_closed:
            near = self.part and all(
                abs(a - b) < 2e-3 for a, b in zip(self.stage[:3], self.part[:3], strict=True)
            )
            self.holding = bool(near)
        self.holding = self.holding and closed
        self.jaws_closed = closed

    def _lag(self, target):
        """Critically damped second order, exact over 1 ms."""
        decay = exp(-OMEGA * 1e-3)
        for i in range(4):
            e, v = self.stage[i] - target[i], self.velocity[i]
            slope = v + OMEGA * e
            self.stage[i] = target[i] + (e + slope * 1e-3) * decay
            self.velocity[i] = (v - OMEGA * slope * 1e-3) * decay

    def _push(self):
        x, y, z, _ = self.stage
        at_slot = self.slot is not None and (
            abs(x - self.slot[0]) < 0.25e-3 and abs(y - self.slot[1]) < 0.25e-3
        )
        if z >= 0.0:
            self.inside = False
            return 0.0, 0.0, 0.0
        self.inside = self.inside or at_slot
        if self.inside:
            floor = self.stiffness * max(0.0, -2.5e-3 - z)
            return -5e3 * (x - self.slot[0]), -5e3 * (y - self.slot[1]), floor
        return 0.0, 0.0, -self.stiffness * z

    def _wrench(self):
        pushes = zip(self._push(), self.acceleration, strict=True)
        fx, fy, fz = (push - self.mass * a for push, a in pushes)
        theta = self.stage[3]
        c, s = cos(theta), sin(theta)
        pushed = (c * fx + s * fy, s * fx - c * fy, -fz, 0.0, 0.0, 0.0)
        return tuple(a + b for a, b in zip(pushed, self.extra, strict=True))


class FakeArm:
    """Steps the world by one period at each command; `faults[n]` is raised by the n-th read."""

    def __init__(self, world, rate=125):
        self.world = world
        self.period = 1_000_000_000 // rate
        self.t = 0
        self.faults = {}
        self.skips = {}
        self.reads = 0
        self.stops = 0
        self.sent = []
        self.outputs = 0
        self.wrenches = []
        self._target = Place(*world.stage)
        self._in_flight = False

    def connect(self) -> ArmState:
        self.hold()
        return self._state()

    def close(self) -> None:
        pass

    def read(self) -> ArmState:
        assert self._in_flight, "read without a command in flight: a lockstep cell would hang"
        self._in_flight = False
        self.reads += 1
        if self.reads in self.faults:
            raise self.faults[self.reads]
        return self._state()

    def servo(self, pose: Vector6) -> Vector6:
        if not all(map(isfinite, pose)):
            raise ValueError(f"a set-point is six finite numbers, found {pose}")
        self._target = FRAME.from_base(pose)
        self.sent.append(self._target)
        self._advance()
        return pose

    def hold(self) -> Vector6:
        self._advance()
        return FRAME.to_base(self._target)

    def stop(self) -> None:
        self.stops += 1
        self._target = Place(*self.world.stage)
        self._advance()

    def set_output(self, bit: int, on: bool) -> None:
        self.outputs = self.outputs & ~(1 << bit) | on << bit

    def _advance(self):
        self._in_flight = True
        for _ in range(1 + self.skips.get(len(self.sent), 0)):
            self.t += self.period
            self.wrenches += self.world.step(self._target, bool(self.outputs & 1), self.period)

    def _state(self):
        zero = (0.0,) * 6
        pose = FRAME.to_base(Place(*self.world.stage))
        return ArmState(
            self.t,
            zero,
            pose,
            FRAME.to_base(self._target),
            self._twist(),
            RobotMode.RUNNING,
            SafetyMode.NORMAL,
            True,
            int(self.world.holding),
            self.outputs,
        )

    def _twist(self):
        vx, vy, vz, turn = self.world.velocity
        c, s = cos(TURN), sin(TURN)
        return (c * vx - s * vy, s * vx + c * vy, vz, 0.0, 0.0, turn)


class FakeSensor:
    """Gives what the world felt since the last read; `faults[n]` is raised by the n-th read."""

    def __init__(self, arm, boot=0):
        self.arm = arm
        self.boot = boot
        self.faults = {}
        self.reads = 0
        self.tares = 0
        self._last = None
        self._last_t = 0
        self._zero = (0.0,) * 6
        self._counter = 0
        self._tare_left = 0
        self.axes = tuple  # what the sensor makes of a wrench

    def connect(self) -> None:
        pass

    def close(self) -> None:
        pass

    def start(self) -> None:
        pass

    @property
    def ready(self) -> bool:
        return self.arm.t >= self.boot

    def poll(self, t: int) -> None:
        if self._tare_left == 1 and self.arm.wrenches:
            self._zero = self.arm.wrenches[-1]
        self._tare_left = max(0, self._tare_left - 1)

    def read(self, t: int) -> WrenchReading:
        self.poll(t)
        self.reads += 1
        if self.reads in self.faults:
            raise self.faults[self.reads]
        samples, self.arm.wrenches = tuple(map(self._zeroed, self.arm.wrenches)), []
        self._counter += len(samples)
        if samples:
            self._last, self._last_t = samples[-1], t
        elif self._last is None:
            raise NotReadyError("no sample yet")
        age = t - self._last_t
        if age > MAX_AGE:
            raise StaleSampleError(f"the last sample is {age} ns old")
        freshness = Freshness.OK if samples else Freshness.HELD
        return WrenchReading(self._last, samples, self._counter, age, freshness, self.tares > 0)

    def _zeroed(self, wrench):
        return tuple(a - b for a, b in zip(self.axes(wrench), self._zero, strict=True))

    def begin_tare(self, samples: int) -> None:
        self.tares += 1
        self._tare_left = 10

    @property
    def tare_pending(self) -> bool:
        return self._tare_left > 0

    @property
    def health(self) -> SensorHealth:
        return SensorHealth(self._counter, 0, 0, 0, 0, 0, True, "")


class FakeGripper:
    """Digital output 0 closes, digital input 0 says that something is held."""

    def __init__(self, arm):
        self._arm = arm

    def open(self) -> None:
        self._arm.set_output(0, False)

    def close(self) -> None:
        self._arm.set_output(0, True)

    def holds(self, state: ArmState) -> bool:
        return bool(state.inputs & 1)


class Cell:
    """World, fakes and loop, connected; `seen` holds what the observer was given."""

    def __init__(self, rate=125, **world):
        self.world = SpringWorld(**world)
        self.arm = FakeArm(self.world, rate)
        self.sensor = FakeSensor(self.arm)
        self.gripper = FakeGripper(self.arm)
        self.seen = []
        self.loop = Loop(self.arm, self.sensor, FRAME, observe=lambda *row: self.seen.append(row))
        self.arm.connect()

    def phases(self):
        names = [phase for _, _, phase in self.seen]
        return [name for name, before in zip(names, [None, *names], strict=False) if name != before]


@pytest.fixture(scope="session")
def make_cell():
    return Cell
