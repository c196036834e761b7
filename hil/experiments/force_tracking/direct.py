"""The same job straight on the plant, without a wire: for maps and tuning, never for verdicts.

Left out: sockets, RTDE, CAN frames, URScript, inverse kinematics, jitter of the delays, and of the
sensor's errors all but noise and rounding. What is left runs a hundred times faster than real time.
"""

from collections import deque
from itertools import repeat
from math import ceil

import numpy as np

from controller.course import Course, Phase
from controller.cycle import Cycle
from controller.outcome import Ending, Kind
from controller.place import Place
from controller.track import Tracking, tracking
from drivers.interfaces import ArmState, Freshness, RobotMode, SafetyMode, Vector6, WrenchReading
from hil.cell.plant.interface import PlantStep, StageTarget
from hil.cell.plant.surface import SurfacePlant
from hil.cell.rig import Rig, drawn
from hil.cell.streams import stream
from hil.experiments.force_tracking.figures import Figures, figures
from hil.experiments.force_tracking.trace import G, trace_of
from hil.experiments.force_tracking.variant import Variant, axis_of, job_of, rig_of

MILLISECOND = 1_000_000
STILL: Vector6 = (0.0, 0.0, 0.0, 0.0, 0.0, 0.0)
STATE = ArmState(
    0, STILL, STILL, STILL, STILL, RobotMode.RUNNING, SafetyMode.NORMAL, True, 0, 0
)  # fmt: skip
"""What the job never looks at."""


class DelayedSensor:
    """Noise, rounding and a constant delay on the tared push along z."""

    def __init__(self, rig: Rig, rng: np.random.Generator) -> None:
        self._rng, self._noise = rng, rig.sensor.errors.noise_force
        self._resolution, self._weight = rig.sensor.resolution_force, rig.tool.mass * G
        delay = round(rig.latency.can.from_cell.mean * 1e3)
        # Time stamps do not show a constant delay, only how much later than others a sample came.
        self.age = MILLISECOND
        self._on_the_way: deque[float] = deque(repeat(0.0, delay))

    def read(self, step: PlantStep) -> WrenchReading:
        """Samples that have arrived by the end of a period; push is a negative fz."""
        fz = step.wrenches[:, 2] - self._weight
        fz = fz + self._noise * self._rng.standard_normal(len(fz))
        rounded = np.rint(fz / self._resolution) * self._resolution
        self._on_the_way.extend(rounded.tolist())
        arrived = [self._on_the_way.popleft() for _ in range(len(fz))]
        samples = tuple([(0.0, 0.0, value, 0.0, 0.0, 0.0) for value in arrived])
        return WrenchReading(samples[-1], samples, 0, self.age, Freshness.OK, True)


def direct(rig: Rig, seed: int, variant: Variant, job: Tracking | None = None) -> Figures:
    """Figures of one run; a tripped force stop counts as unstable, as over the wire."""
    rig = drawn(rig_of(rig, variant), stream(seed, "randomisation"))
    bench = _Bench(rig, stream(seed, "sensor"))
    course = Course(bench.cycle(), rig.robot.period * 1e-9)
    axis = axis_of(variant, rig.robot.period)
    phase = tracking(course, axis, job or job_of(variant))
    completed = _drive(phase, course, bench, rig.limits.force_bound[2])
    trace = trace_of(bench.history, rig.tool.mass, bench.lower, bench.slide)
    return figures(trace, variant.force, completed)


def _drive(phase: Phase[Ending], course: Course, bench: "_Bench", bound: float) -> bool:
    """Whether the job came to its end within the guard's bound on the mean push, N."""
    try:
        setpoint = next(phase)
        while True:
            cycle = bench.pass_period(setpoint, course.name)
            if abs(cycle.wrench[2]) > bound:
                return False
            setpoint = phase.send(cycle)
    except StopIteration as end:
        ending: Ending = end.value
        return ending.kind is Kind.DONE


class _Bench:
    """Plant, sensor and a command that takes effect some whole periods late."""

    def __init__(self, rig: Rig, rng: np.random.Generator) -> None:
        self._plant = SurfacePlant(rig)
        self._sensor = DelayedSensor(rig, rng)
        self._period = rig.robot.period
        late = ceil(rig.latency.rtde.to_cell.mean * 1e9 / self._period)
        self._commands = deque(repeat(Place(0.0, 0.0, 0.0, 0.0), late))
        self._t = 0
        self._step = self._plant.reset(StageTarget(0.0, 0.0, 0.0, 0.0, jaws_closed=False))
        self.history: list[PlantStep] = []
        self.lower: int | None = None
        self.slide: int | None = None

    def pass_period(self, setpoint: Place, phase: str) -> Cycle:
        self._mark(phase)
        self._commands.append(setpoint)
        target = StageTarget(*self._commands.popleft(), jaws_closed=False)
        self._step = self._plant.step(target, self._period)
        self._t += self._period
        self.history.append(self._step)
        return self.cycle()

    def _mark(self, phase: str) -> None:
        if self.lower is None and phase == "lower":
            self.lower = len(self.history)
        if self.slide is None and phase == "slide":
            self.slide = len(self.history)

    def cycle(self) -> Cycle:
        reading = self._sensor.read(self._step)
        push = -sum(sample[2] for sample in reading.samples) / len(reading.samples)
        wrench = (0.0, 0.0, push, 0.0, 0.0, 0.0)
        return Cycle(self._t, STATE, reading, wrench, Place(*self._step.stage))
