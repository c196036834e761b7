"""Episodes straight on the plant, without a wire: to look into the task, never for verdicts.

The phases of contact, search and insertion are those of a run over the wire; left out are sockets,
RTDE, CAN frames, URScript, inverse kinematics, jitter of the delays, of the sensor's errors all but
noise and rounding, and the way from the fixture.
"""

from collections import deque
from collections.abc import Callable
from itertools import repeat
from math import cos, sin

import numpy as np

from controller.action import Observation, Policy, observation
from controller.course import Course
from controller.cycle import Cycle
from controller.errors import GuardTrip, Trip
from controller.filters import MovingMean
from controller.frames import wrench_to_task
from controller.guard import Guard
from controller.job import find_and_insert
from controller.outcome import Kind
from controller.place import Place
from controller.settings import Plan
from drivers.interfaces import ArmState, Freshness, RobotMode, SafetyMode, Vector6, WrenchReading
from hil.app.near import limits, part_named
from hil.app.near import plan as planned
from hil.cell.plant.ffc import FfcPlant
from hil.cell.plant.interface import Plant, PlantStep, StageTarget
from hil.cell.rig import Rig

MILLISECOND = 1_000_000
STILL: Vector6 = (0.0, 0.0, 0.0, 0.0, 0.0, 0.0)
STATE = ArmState(
    0, STILL, STILL, STILL, STILL, RobotMode.RUNNING, SafetyMode.NORMAL, True, 0, 0
)  # fmt: skip
"""What the phases never look at."""
HEIGHT = 0.3e-3
"""Of an episode's beginning above the face, m: the rest of the way down tells nothing."""

Offset = tuple[float, float, float]
"""x, y in m and theta in rad."""
NewPlant = Callable[[Rig, np.random.Generator], Plant]


class DirectCell:
    """One part in the jaws over one connector. slot: where that truly stands off the task frame;
    grip: how the part lies in the jaws.
    """

    def __init__(
        self,
        rig: Rig,
        slot: Offset,
        grip: Offset,
        rng: np.random.Generator,
        plant: NewPlant = FfcPlant,
    ) -> None:
        self._rig, self._slot, self._rng = rig, slot, rng
        self._period = rig.robot.period
        self.plan: Plan = planned(rig, part_named(rig, rig.first_part), (0, 0, 0))
        self._start = self.plan.start.at(HEIGHT)
        self._plant = plant(_gripped(rig, self._target(self._start), grip), rng)
        self._guard_limits = limits(rig)
        late = rig.latency.can.from_cell.mean
        self._delay = max(1, round(late * 1e3))

    def attempt(self, policy: Policy) -> tuple[Kind, int, Observation]:
        """An episode: how it ended, its steps, the last sight of it."""
        course = self._begin(self._start)
        phase = find_and_insert(course, self.plan, policy)
        guard = Guard(self._guard_limits, self._period)
        cycle = course.cycle
        try:
            setpoint = next(phase)
            while True:
                cycle = self._pass(setpoint)
                guard.check(cycle)
                setpoint = phase.send(cycle)
        except StopIteration as end:
            kind: Kind = end.value.kind
        except GuardTrip as trip:
            kind = Kind.DANGER if trip.trip is Trip.FORCE else Kind.FAULT
        return kind, course.steps, observation(cycle)

    @property
    def truth(self) -> PlantStep:
        """The plant at the end of the last period."""
        return self._step

    def _begin(self, start: Place) -> Course:
        """Hang the part at the start, zero the sensor there."""
        target = self._target(start)
        self._plant.reset(target._replace(jaws_closed=False))
        self._step = self._plant.step(target, self._period)
        self._tare = self._step.wrenches[-1].copy()
        self._mean = MovingMean(1000.0)
        self._t = 0
        self._on_the_way = deque(repeat(self._tare, self._delay))
        self._setpoint = start
        return Course(self._cycle(), self._period * 1e-9)

    def _pass(self, setpoint: Place) -> Cycle:
        """One period: the command takes effect one late, as over the wire."""
        target, self._setpoint = self._target(self._setpoint), setpoint
        self._step = self._plant.step(target, self._period)
        self._t += self._period
        return self._cycle()

    def _cycle(self) -> Cycle:
        stage = self._nominal(self._step.stage)
        reading = self._reading(self._step)
        wrench = wrench_to_task(self._mean(reading), stage.theta)
        return Cycle(self._t, STATE, reading, wrench, stage)

    def _reading(self, step: PlantStep) -> WrenchReading:
        self._on_the_way.extend(step.wrenches)
        arrived = np.array([self._on_the_way.popleft() for _ in step.wrenches]) - self._tare
        sensor = self._rig.sensor
        noise = self._rng.standard_normal(arrived.shape)
        noise *= [sensor.errors.noise_force] * 3 + [sensor.errors.noise_torque] * 3
        fine = np.array([sensor.resolution_force] * 3 + [sensor.resolution_torque] * 3)
        samples = tuple(tuple(row) for row in (np.rint((arrived + noise) / fine) * fine).tolist())
        age = self._delay * MILLISECOND
        return WrenchReading(samples[-1], samples, 0, age, Freshness.OK, True)

    def _target(self, place: Place) -> StageTarget:
        """The task frame's place in the frame of the connector as it truly stands."""
        dx, dy, turn = self._slot
        c, s = cos(turn), sin(turn)
        x, y = place.x - dx, place.y - dy
        return StageTarget(
            c * x + s * y, c * y - s * x, place.z, place.theta - turn, jaws_closed=True
        )

    def _nominal(self, stage: tuple[float, float, float, float]) -> Place:
        """Inverse of `_target`."""
        dx, dy, turn = self._slot
        c, s = cos(turn), sin(turn)
        x, y, z, theta = stage
        return Place(c * x - s * y + dx, s * x + c * y + dy, z, theta + turn)


def _gripped(rig: Rig, start: StageTarget, grip: Offset) -> Rig:
    """The rig with one part, waiting without play where jaws at `start` grip it so."""
    c, s = cos(start.theta), sin(start.theta)
    x = start.x + c * grip[0] - s * grip[1]
    y = start.y + s * grip[0] + c * grip[1]
    connector = rig.connector.model_copy(update={"rotation": 0.0})
    origin = connector.position
    place = {
        "position": (origin[0] + x, origin[1] + y, origin[2] + start.z),
        "rotation": start.theta + grip[2],
    }
    part = rig.fixture.parts[0].model_copy(update=place)
    still = {"parts": (part,), "play": 0.0, "play_rotation": 0.0}
    fixture = rig.fixture.model_copy(update=still)
    return rig.model_copy(update={"fixture": fixture, "connector": connector})
