"""Faults of the near side's own process: its loop, clock, life and disk."""

import time
from collections.abc import Callable, Collection
from contextlib import AbstractContextManager
from math import hypot
from typing import Final

from controller.course import Course
from controller.cycle import Cycle
from drivers.interfaces import SafetyMode
from drivers.ur.arm import UrArm
from hil.app.cell import RunningCell
from hil.app.record import Sink
from hil.cell.errors import CellError, FaultError
from hil.cell.faults.injector import Injector, Running
from hil.cell.faults.log import FaultEvent
from hil.cell.faults.row import Place
from hil.cell.faults.schedule import Numbered
from hil.cell.faults.situation import Situation
from hil.cell.injection.places import NEAR, OF_A_RUN, check
from hil.cell.rig import Rig
from hil.recording.channel import Channel
from hil.recording.errors import RecordingError

NS: Final = 1_000_000_000
TOUCH: Final = 1.0
"""N: a measured force above it is contact to a trigger of this side, which knows no truth."""
UNATTENDED: Final = 1_000_000_000
"""Bench time, ns, for which a cell goes on whose host was killed."""


class HostFaultError(CellError):
    """An exception in the host's own code, as a bug or a kill would raise it."""


class HostFaults(AbstractContextManager["HostFaults"]):
    """Told of each cycle before its command; carries out H1 to H3, and asks the cell to go on
    meanwhile. In lockstep a pause is bench time; by the wall clock it is a sleep.

    episode: of a training, from 1.
    """

    def __init__(self, faults: Numbered, seed: int, period: int, clock: str) -> None:
        self._injector = Injector(faults, seed, period)
        self._period, self._lockstep = period, clock == "lockstep"
        self._sound_clock = time.time
        self._now = 0
        self._cell: RunningCell | None = None
        self._told = 0
        self.episode = 1

    def __exit__(self, *_: object) -> None:
        time.time = self._sound_clock

    def of(self, kind: str) -> tuple[Running, ...]:
        """The faults of this row that are in force now."""
        return self._injector.of(kind)

    @property
    def now(self) -> int:
        """Arm time of the last cycle, ns."""
        return self._now

    @property
    def events(self) -> tuple[FaultEvent, ...]:
        """What became of them so far."""
        self._injector.settle(self._now)
        return self._injector.events

    def attend(self, cycle: Cycle, course: Course, cell: RunningCell, arm: UrArm) -> None:
        """One cycle, before its command. Raises HostFaultError for H3."""
        self._cell, self._now = cell, cycle.t
        cell.note(course.name, self.episode)
        self._injector.look(self._seen(cycle, course))
        for one in self.of("H1"):
            self.absent(round(one.fault.number("pause") * NS))
            one.done(cycle.t, "the loop pauses")
        self._keep_time(cycle.t)
        for one in self.of("H3"):
            self._end(one, arm)
        self._injector.settle(cycle.t)

    def absent(self, duration: int) -> None:
        """Do nothing for so long, ns, while the cell goes on."""
        assert self._cell is not None, "the loop has begun"
        if self._lockstep:
            self._cell.leave(duration)
        else:
            time.sleep(duration / NS)

    def news(self) -> tuple[FaultEvent, ...]:
        """What happened since the last call."""
        new = self.events[self._told :]
        self._told += len(new)
        return new

    def _end(self, one: Running, arm: UrArm) -> None:
        how = one.fault.word("how")
        one.done(self._now, how)
        self._injector.settle(self._now)
        if how == "kill":
            self.absent(UNATTENDED)
            arm.abandon()
        raise HostFaultError(f"H3 host.killed: {how}")

    def _keep_time(self, t: int) -> None:
        """Bend the process's wall clock for as long as a fault says so."""
        running = self.of("H2")
        if not running:
            time.time = self._sound_clock
        for one in running:
            if one.effect is None:
                time.time = _bent(self._sound_clock, one)
                one.felt(t, f"clock off by {time.time() - self._sound_clock():.6g} s")

    def _seen(self, cycle: Cycle, course: Course) -> Situation:
        """The situation as this side knows it: what was measured."""
        force = hypot(*cycle.wrench[:3])
        safety = SafetyMode(cycle.state.safety_mode).name.lower()
        number, touches = cycle.t // self._period, force > TOUCH
        return Situation(cycle.t, number, course.name, self.episode, touches, force, safety)


def _bent(sound: Callable[[], float], one: Running) -> Callable[[], float]:
    begin, jump = sound(), one.fault.number("jump")
    rate = 1.0 + one.fault.number("skew") * 1e-6
    return lambda: begin + jump + rate * (sound() - begin)


class FullDisk:
    """A recorder's end of the loop whose disk is full while H4 is in force: `put` raises."""

    def __init__(self, sound: Sink, faults: HostFaults) -> None:
        self._sound, self._faults = sound, faults

    def put(self, channel: Channel, t: int, payload: bytes) -> None:
        """Raises RecordingError for a full disk."""
        for one in self._faults.of("H4"):
            one.felt(t, "no space left")
            raise RecordingError("recording failed: no space left on device")
        self._sound.put(channel, t, payload)

    def settle(self, t: int) -> None:
        self._sound.settle(t)


def split(
    faults: Numbered,
    rig: Rig,
    *,
    recorded: bool,
    places: Collection[Place] = OF_A_RUN,
    episodes: int = 1,
) -> tuple[Numbered, Numbered]:
    """The cell's faults and this side's; FaultError for one that this run has no place for."""
    check(faults, rig, places, episodes)
    for index, fault in faults:
        if fault.kind == "H4" and not recorded:
            raise FaultError(f"faults[{index}]: H4 host.disk: this run writes no recording")
    near = tuple(pair for pair in faults if pair[1].row.place in NEAR)
    return tuple(pair for pair in faults if pair not in near), near
