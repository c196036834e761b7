"""Takes one row of signals a control period: the cell's truth and what the near side knew.

The cell tells each period as it ends; the near side tells each cycle before the command that
releases the next period. In lockstep they take turns, and a row has what the near side knew when it
gave its last command, so a row is the same on every machine. Of a near side whose link was cut, and
that learns so while the cell goes on by itself, it has nothing newer.
"""

from collections import deque
from collections.abc import Callable, Sequence
from math import dist, hypot
from typing import Final, NamedTuple

from controller.course import Course
from controller.cycle import Cycle
from drivers.protocol.rtde_states import RuntimeState, SafetyMode
from drivers.ur.program import SEQUENCE_MASK, Command
from hil.cell.bench import Bench
from hil.cell.rig import Rig
from hil.cell.serve import Tick
from hil.trial.always import monitors
from hil.trial.signals import NAMES
from hil.trial.trace import Trace, trace
from hil.trial.truth import Push, Vector4
from hil.trial.verdict import Judge

_COMMAND, _ANSWERED, _ECHO = 24, 26, 24
_SAFE: Final = (SafetyMode.NORMAL, SafetyMode.REDUCED)
REMEMBERED: Final = 4096
"""Commands whose time of reading is known: 8 s of them at 500 Hz."""

Forces = Callable[[bool], tuple[int, bool]]
"""How many faults are in force, and whether one of them has to stop the arm."""


def no_faults(_running: bool) -> tuple[int, bool]:
    return 0, False


class _Told(NamedTuple):
    """What the near side knew as it gave its last command."""

    phase: str = "start"
    episode: int = 0
    running: bool = False
    stopping: bool = False
    finite: bool = True
    measured: Vector4 = (0.0, 0.0, 0.0, 0.0)
    age: int = 0
    steps: int = 0


class Sampler:
    """far: its `tick` is the cell's observer. near: `command`, `cycle` and `stopping`.

    leaving: the near side has done its work; its next command is no longer part of it. judge: the
    always-on monitors, which see each period as it ends.
    """

    def __init__(self, rig: Rig) -> None:
        self._bound = rig.limits.force_bound
        self._length = rig.tool.length
        self._push = Push(rig.tool.mass, rig.robot.period)
        self.judge = Judge(monitors(rig))
        self.faults: Forces = no_faults
        self.noticed: int | None = None
        self._rows: list[tuple[float, ...]] = []
        self._phases: list[str] = []
        self._reads: deque[tuple[int, int]] = deque(maxlen=REMEMBERED)
        self._upon = self._burst = 0
        self._sent: dict[int, int] = {}
        self._followed: int | None = None
        self._target: tuple[float, ...] = ()
        self.bench: Bench | None = None
        self.phase, self.episode = "start", 0
        self.running = self.stopping = False
        self.finite, self.leaving = True, False
        self._measured: Vector4 = (0.0, 0.0, 0.0, 0.0)
        self._age, self._steps = 0, 0
        self._told = _Told()
        self.answered = 0  # controller time, ns, of the package that the last command answers

    def command(self, name: tuple[int, int], read: int, *, stopping: bool) -> None:
        """The near side sent this command, knowing the package of controller time `read`, ns.

        name: its sequence and the robot's cycle that it answers.
        """
        withdrawing = self.running and self.noticed is not None and not stopping
        if withdrawing:  # the job is over, and the arm draws back from what ended it
            self.phase = "withdraw"
        self.stopping = stopping
        self.running = self.running and not (self.leaving or withdrawing)
        if self.running and stopping and self.noticed is None:
            self.noticed = read
        if not stopping:
            self._upon += 1
            self._burst = max(self._burst, self._upon)
        sequence, answered = name
        self._reads.append((sequence, read))
        self._sent[sequence] = answered
        if len(self._sent) > REMEMBERED:
            del self._sent[next(iter(self._sent))]
        self.answered = read
        self._told = _Told(
            self.phase, self.episode, self.running, self.stopping, self.finite, self._measured,
            self._age, self._steps,
        )  # fmt: skip

    def package(self) -> None:
        """The near side read a package: it may answer once."""
        self._upon = 0

    def cycle(self, cycle: Cycle, course: Course) -> None:
        """What the near side knows in this cycle."""
        self.phase, self._steps, self._age = course.name, course.steps, cycle.reading.age
        fx, fy, fz, _, _, tau_z = cycle.wrench
        self._measured = fx, fy, fz, tau_z

    def tick(self, tick: Tick) -> None:
        """One period of the cell has ended."""
        bench = self.bench
        if bench is None:
            return
        force, told = self._push.take(tick.truth), self._told
        faults, owed = self.faults(told.running)
        (vx, vy, vz, turning), part = tick.truth.velocity, tick.truth.part
        row = (
            tick.t * 1e-9,
            float(told.episode),
            float(told.running),
            float(part.contact.value != "free"),
            *force,
            *told.measured,
            self._share(force),
            self._share(told.measured),
            told.age * 1e-9,
            *self._robot(bench, tick.t),
            hypot(vx, vy, vz),
            abs(turning),
            float(told.finite),
            float(bench.arm.box.modes.safety in _SAFE),
            float(faults),
            float(owed),
            float(told.steps),
        )
        self._burst = 0
        self._rows.append(row)
        self._phases.append(told.phase)
        self.judge.step(dict(zip(NAMES, row, strict=True)), told.phase)

    @property
    def trace(self) -> Trace:
        """All rows so far."""
        return trace(self._rows, self._phases)

    def _share(self, forces: Vector4) -> float:
        return max(abs(f) / bound for f, bound in zip(forces, self._bound, strict=True))

    def _robot(self, bench: Bench, t: int) -> Sequence[float]:
        """command_age, commands, order, servoing, stopping, step, turn."""
        box = bench.arm.box
        integers = box.registers.inputs.integers
        sequence = box.registers.outputs.integers[_ECHO]
        plays = box.modes.moving and box.modes.program is RuntimeState.PLAYING
        servoing = plays and integers[_COMMAND] == Command.SERVO
        (x, y, z), rotation = box.target.flange
        tip = [at + self._length * row[2] for at, row in zip((x, y, z), rotation, strict=True)]
        heading = rotation[0]
        last, self._target = self._target, (*tip, heading[0], heading[1])
        step = dist(tip, last[:3]) if last else 0.0
        turn = hypot(heading[0] - last[3], heading[1] - last[4]) if last else 0.0
        age = self._command_age(sequence, t) if servoing else 0.0
        order = self._order(sequence, integers[_ANSWERED]) if servoing else 0
        self._followed = self._followed if servoing else None
        stopping = self._told.stopping or not plays
        return (age, float(self._burst), float(order), float(servoing), float(stopping), step, turn)

    def _order(self, sequence: int, answered: int) -> int:
        """Commands by which the one followed is newer than the last one; 0 for a bent number."""
        if self._sent.get(sequence) != answered:
            return 0
        last, self._followed = self._followed, sequence
        return _onward(last, sequence)

    def _command_age(self, sequence: int, t: int) -> float:
        """How old the state is that this command answers, s; 0 for one that is not the near's."""
        reads = self._reads
        while len(reads) > 1 and (sequence - reads[0][0]) & SEQUENCE_MASK < SEQUENCE_MASK >> 1:
            if reads[0][0] == sequence:
                break
            reads.popleft()
        if reads and reads[0][0] == sequence:
            return (t - reads[0][1]) * 1e-9
        return 0.0


def _onward(before: int | None, sequence: int) -> int:
    """How many commands later this one is; below 0: it is older, whatever the counter's wrap."""
    ahead = 0 if before is None else (sequence - before) & SEQUENCE_MASK
    return ahead if ahead <= SEQUENCE_MASK >> 1 else ahead - SEQUENCE_MASK - 1


assert len(NAMES) == 29, "a row of `tick` has a value for each signal"
