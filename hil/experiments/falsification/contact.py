"""One run of the study: the near side presses on a surface while the bus fails, without a wire.

Real here: plant, CAN codec, the driver's session, guard, force law, job, faults and triggers, and
monitor F1. Left out: sockets, arm, gravity, tare. A run takes 20 ms instead of a second.
"""

from collections import deque
from collections.abc import Mapping
from typing import Final, NamedTuple

import numpy as np

from controller.course import Course, Phase
from controller.cycle import Cycle
from controller.errors import ControlError
from controller.guard import Guard, Limits
from controller.laws.bounds import Bounds
from controller.laws.build import build, settings_of
from controller.outcome import Ending
from controller.place import Place
from controller.reference import Step
from controller.track import Tracking, tracking
from drivers.errors import DriverError
from drivers.nrs.session import Heard, Session
from drivers.protocol.nrs_can import FORCE_LSB, TARED, VALID, Identifiers
from drivers.protocol.nrs_sample import encode_pair
from drivers.protocol.nrs_status import Status, StatusBit, encode_status
from hil.cell.faults.injector import Injector
from hil.cell.faults.situation import Situation
from hil.cell.plant.interface import PlantStep, StageTarget
from hil.cell.plant.surface import SurfacePlant
from hil.cell.rig import Rig
from hil.cell.streams import stream
from hil.experiments.falsification.bugs import PATIENCE, SOUND, Bug, Driver
from hil.experiments.falsification.bus import FaultyBus
from hil.experiments.force_tracking.direct import STATE
from hil.experiments.force_tracking.trace import G
from hil.falsify.faults import schedule
from hil.falsify.space import Case, Value
from hil.monitors.monitor import Monitor

PERIOD: Final = 8_000_000
MILLISECOND: Final = 1_000_000
IDS: Final = Identifiers.of(1)
AFTER_STOP: Final = 12
"""Periods that a stopped run is still watched."""
F1: Final = "once[0:1](f_ratio <= 1) or stopped > 0.5"
SCALES: Final = {"f_ratio": 1.0, "stopped": 1.0}


class Press(NamedTuple):
    """What varies besides the fault: N/m, m of free air, m/s inward in air."""

    stiffness: float = 10e3
    gap: float = 2e-3
    approach: float = 4e-3

    @classmethod
    def of(cls, values: Mapping[str, Value]) -> "Press":
        return cls(**{name: float(value) for name, value in values.items()})


def robustness(rig: Rig, case: Case, bug: Bug, seed: int) -> float:
    """Of F1 over one run, in force bounds: below 0 the true force was over f_b for two periods and
    nothing had stopped the arm.

    case: its first part holds the fields of Press, the others are faults.
    """
    return _Run(rig, case, bug, seed).judged()


class _Run:
    def __init__(self, rig: Rig, case: Case, bug: Bug, seed: int) -> None:
        press = Press.of(case[0].values)
        surface = {"stiffness": press.stiffness, "gap": press.gap, "friction": 0.0}
        self._rig = rig.model_copy(update={"surface": rig.surface.model_copy(update=surface)})
        self._plant = SurfacePlant(self._rig)
        self._faults = Injector(schedule(case[1:]).numbered(seed), seed, PERIOD)
        self._bus = FaultyBus(self._faults)
        age = SOUND if bug is Bug.NONE else PATIENCE
        limits = Limits(force_bound=(10.0, 10.0, 10.0, 1.0), sample_age=age)
        self._bound = limits.force_bound[2]
        self._guard = Guard(limits, PERIOD)
        self._session = _started(age)
        self._driver = Driver(bug, PERIOD // MILLISECOND)
        self._noise = stream(seed, "sensor")
        bounds = Bounds(approach=press.approach, push=press.approach, stop=400.0)
        settings = settings_of("constant", {"mass": 1.0, "damping": 1000.0})
        self._axis = build("constant", settings, bounds, PERIOD)
        self._commands = deque([Place(0.0, 0.0, 0.0, 0.0)] * 2)
        self._t = self._count = 0
        self._step = self._plant.reset(StageTarget(0.0, 0.0, 0.0, 0.0, jaws_closed=False))

    def judged(self) -> float:
        monitor = Monitor(F1, SCALES)
        self._pass_period(self._commands[-1], "start")
        course = Course(self._cycle(), PERIOD * 1e-9)
        job = Tracking(force=Step(4.8), rest=0.02, hold=0.3, moving=0.0, patience=1.2)
        phase = tracking(course, self._axis, job)
        setpoint, stopped, worst = next(phase), 0, 1.0
        while stopped < AFTER_STOP:
            self._pass_period(setpoint, course.name)
            values = {"f_ratio": self._push() / self._bound, "stopped": float(stopped > 0)}
            worst = min(worst, monitor.step(values).robustness)
            if stopped:
                stopped += 1
                continue
            try:
                setpoint = self._decided(phase)
            except StopIteration:
                break
            except (ControlError, DriverError):
                stopped = 1
        return worst

    def _decided(self, phase: Phase[Ending]) -> Place:
        cycle = self._cycle()
        self._guard.check(cycle)
        setpoint = phase.send(cycle)
        self._guard.check_setpoint(setpoint, cycle.stage)
        return setpoint

    def _pass_period(self, setpoint: Place, phase: str) -> None:
        push = self._push()
        self._faults.look(
            Situation(self._t, self._t // PERIOD, phase, contact=push > 0.2, force=push)
        )
        self._commands.append(setpoint)
        self._step = self._plant.step(
            StageTarget(*self._commands.popleft(), jaws_closed=False), PERIOD
        )
        felt = enumerate(self._felt(self._step), 1)
        self._bus.put([(self._t + n * MILLISECOND, self._frames(fz)) for n, fz in felt])
        self._t += PERIOD
        self._session.take(self._bus.due(self._t), self._t)

    def _felt(self, step: PlantStep) -> list[float]:
        """Fz of each millisecond, less the tool's weight, with the sensor's noise, N."""
        fz = step.wrenches[:, 2] - self._rig.tool.mass * G
        noisy = fz + self._rig.sensor.errors.noise_force * self._noise.standard_normal(len(fz))
        return [float(value) for value in noisy]

    def _frames(self, fz: float) -> tuple[Heard, Heard]:
        counts = (0, 0, round(fz / FORCE_LSB), 0, 0, 0)
        pair = encode_pair(IDS, counts, VALID | TARED, self._count)
        self._count += 1
        force, torque = ((frame.id, frame.data, False) for frame in pair)
        return force, torque

    def _cycle(self) -> Cycle:
        reading = self._driver.read(self._session.reading(self._t))
        samples = reading.samples or (reading.wrench,)
        push = -float(np.mean([sample[2] for sample in samples]))
        wrench = (0.0, 0.0, push, 0.0, 0.0, 0.0)
        return Cycle(self._t, STATE, reading, wrench, Place(*self._step.stage))

    def _push(self) -> float:
        """True push of the last period, mean, N."""
        return float(self._rig.tool.mass * G - self._step.wrenches[:, 2].mean())


def _started(patience: int) -> Session:
    session = Session(node=1, fd=False, period=MILLISECOND, max_age=patience)
    session.start()
    frame = encode_status(IDS, Status(StatusBit.TRANSMIT_ON, 25.0, 0, 0))
    session.take([(frame.id, frame.data, False)], 0)
    return session
