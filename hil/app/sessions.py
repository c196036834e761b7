"""A training that survives any death: in sessions, with a checkpoint after each.

Of an emulated cell each session is a cell started anew, its noise and delays drawn from the seed
and the session's number; where the connector stands and how a part lies in the jaws is drawn from
the seed alone. So a training that was killed goes on from its last session to the same bits as one
that never was. A real cell keeps its part in the jaws: there a session is all of a part's episodes.
"""

from collections.abc import Callable, Iterator, Sequence
from contextlib import ExitStack
from dataclasses import dataclass, replace
from hashlib import sha256
from math import cos, sin
from pathlib import Path

import numpy as np
from orjson import dumps

from controller.outcome import Kind
from hil.app.cell import RunningCell
from hil.app.faulty import events
from hil.app.host_faults import HostFaults, split
from hil.app.inline import InlineCell
from hil.app.real import RealCell
from hil.app.train import EpisodeResult, NearFaults, Schedule, Watch, connected
from hil.cell.faults.log import FaultEvent
from hil.cell.faults.schedule import Numbered
from hil.cell.faults.schedule import Schedule as Faults
from hil.cell.rig import Rig, drawn
from hil.cell.rig.parts import Part
from hil.cell.streams import stream
from hil.recording.identity import versions
from learner import checkpoint
from learner.build import maker
from learner.checkpoint import Checkpoint
from learner.errors import CheckpointError
from learner.grid import Grid
from learner.interface import Learner, State

KINDS = (Kind.INSERTED, Kind.DANGER, Kind.LIMIT)


Tell = Callable[[Sequence[FaultEvent]], None]
"""Hears at the end of a session what became of its faults."""


def silent(_: Sequence[FaultEvent]) -> None:
    """Nobody hears."""


@dataclass(frozen=True, slots=True)
class Training:
    """What is trained. every: episodes of a session. text: the rig file's bytes. faults: armed in
    each session anew, for each is a cell of its own; None is a sound training.
    """

    rig: Rig
    text: bytes
    learner: str
    seed: int
    schedule: Schedule
    every: int = 8
    faults: Faults | None = None

    @property
    def grid(self) -> Grid:
        """The task's search box."""
        task = self.rig.task
        return Grid(task.search_cells, (task.step, task.step, task.step_rotation))

    @property
    def settings(self) -> dict[str, str]:
        """Everything besides learner, rig name and seed that a continuation must share."""
        parts = ",".join(f"{name}:{count}" for name, count in self.schedule.parts)
        broken = {} if self.faults is None else {"faults": dumps(self.faults.written()).decode()}
        return broken | {
            "rig": sha256(self.text).hexdigest(),
            "parts": parts,
            "every": str(self.every),
            "cells": ",".join(map(str, self.rig.task.search_cells)),
            "max_steps": str(self.rig.task.max_steps),
        }

    @property
    def sessions(self) -> list[tuple[str, int]]:
        """Part and number of episodes of each session."""
        found = []
        for name, count in self.schedule.parts:
            most = count if self.real else self.every
            found += [(name, min(most, count - done)) for done in range(0, count, most)]
        return found

    @property
    def real(self) -> bool:
        """Whether the rig names real devices."""
        return self.rig.rig == "real"

    @property
    def checkpoints(self) -> int:
        """How often the file is written."""
        return self.schedule.episodes if self.real else len(self.sessions)


def train(
    training: Training, path: Path, watch: Watch, *, resume: bool, tell: Tell = silent
) -> Iterator[EpisodeResult]:
    """Every episode that is still to be done, `path` written after each session.

    Raises CheckpointError for a file of another training, FaultError for a fault that it has no
    place for, CellError, DriverError.
    """
    learner = learner_of(training)
    results = taken_up(training, path, learner) if resume and path.exists() else []
    end = 0
    for index, (part, count) in enumerate(training.sessions):
        end += count
        left = end - len(results)
        if left <= 0:
            continue
        if left < count or (index > 0 and training.sessions[index - 1][0] != part):
            learner.grip_changed()
        for result in _session(training, learner, index, left, watch, tell):
            results.append(replace(result, number=len(results) + 1))
            if training.real:
                checkpoint.write(path, _kept(training, learner, results))
            yield results[-1]
        if not training.real:
            checkpoint.write(path, _kept(training, learner, results))


def learner_of(training: Training) -> Learner:
    """As it is before its first episode."""
    return maker(training.learner)(
        training.grid, training.rig.task.max_steps, stream(training.seed, "learner")
    )


def _session(  # noqa: PLR0917  those of `train`, and which
    training: Training, learner: Learner, index: int, count: int, watch: Watch, tell: Tell
) -> Iterator[EpisodeResult]:
    """The last `count` episodes of a session."""
    part, _ = training.sessions[index]
    with ExitStack() as stack:
        cell, near = _broken(training, learner, index, stack, tell)
        trainer = connected(training.rig, cell, stack, watch, None, near)
        yield from trainer.run(learner, Schedule(((part, count),)), training.seed)


def _broken(
    training: Training, learner: Learner, index: int, stack: ExitStack, tell: Tell
) -> tuple[RunningCell, NearFaults | None]:
    """The session's cell and what is broken on this side; `tell` hears of it when all is over."""
    rig, its_own = training.rig, seed_of(training.seed, index)
    if training.real and training.faults is None:
        return stack.enter_context(RealCell(rig, "wall")), None
    met = as_met(rig, training.seed)
    if training.faults is None:
        return stack.enter_context(InlineCell(met, its_own, "lockstep", record=False)), None
    from hil.app.agent_faults import pieces  # noqa: PLC0415  compiles a learner's rules

    first = 1 + sum(count for _, count in training.sessions[:index])
    far, near = faults_of(training, learner)
    host = stack.enter_context(HostFaults(near, its_own, rig.robot.period, "lockstep"))
    opened = InlineCell(met, its_own, "lockstep", record=False, faults=far)
    stack.callback(lambda: tell(sorted(events(opened.served) + host.events, key=_moment)))
    return stack.enter_context(opened), NearFaults(host, pieces(learner, host), first)


def faults_of(training: Training, learner: Learner) -> tuple[Numbered, Numbered]:
    """The cell's faults of a training and this side's; FaultError for one without a place."""
    from hil.app.agent_faults import places  # noqa: PLC0415  compiles a learner's rules

    assert training.faults is not None, "a sound training has none"
    faults, episodes = training.faults.numbered(training.seed), training.schedule.episodes
    where = places(learner)
    return split(faults, training.rig, recorded=False, places=where, episodes=episodes)


def seed_of(seed: int, index: int) -> int:
    """A session's own."""
    return int(stream(seed, f"session.{index}").integers(1 << 31))


def _moment(event: FaultEvent) -> int:
    return event.t


def as_met(rig: Rig, seed: int) -> Rig:
    """The rig with everything drawn that a training meets from its first episode to its last."""
    rig = drawn(rig, stream(seed, "randomisation"))
    still = rig.randomisation.model_copy(update={"enabled": False})
    play, turn = rig.fixture.play, rig.fixture.play_rotation
    parts = tuple(
        _lying(part, play, turn, stream(seed, f"grip.{part.name}")) for part in rig.fixture.parts
    )
    fixture = rig.fixture.model_copy(update={"parts": parts, "play": 0.0, "play_rotation": 0.0})
    return rig.model_copy(update={"randomisation": still, "fixture": fixture})


def _lying(part: Part, play: float, turn: float, rng: np.random.Generator) -> Part:
    """The part where its fixture's play left it."""
    u, v, w = rng.uniform(-0.5, 0.5, 3).tolist()
    c, s = cos(part.rotation) * play, sin(part.rotation) * play
    x, y, z = part.position
    place = {"position": (x + c * u - s * v, y + s * u + c * v, z)}
    return part.model_copy(update={**place, "rotation": part.rotation + turn * w})


def _kept(training: Training, learner: Learner, results: Sequence[EpisodeResult]) -> Checkpoint:
    episodes: State = {
        "kind": np.array([KINDS.index(result.kind) for result in results]),
        "steps": np.array([result.steps for result in results]),
        "seconds": np.array([result.seconds for result in results]),
    }
    return Checkpoint(
        learner=training.learner,
        settings=training.settings,
        rig=training.rig.name,
        seed=training.seed,
        episodes=len(results),
        versions=versions(),
        state={"learner": learner.save(), "episodes": episodes},
    )


def taken_up(training: Training, path: Path, learner: Learner) -> list[EpisodeResult]:
    """Load the learner from `path`; the episodes behind it. CheckpointError for another's file."""
    found = checkpoint.read(path)
    mine = {"learner": training.learner, "seed": training.seed, **training.settings}
    theirs = {"learner": found.learner, "seed": found.seed, **found.settings}
    for name in mine | theirs:
        if theirs.get(name) != mine.get(name):
            raise CheckpointError(
                f"{path}: of another training: its {name} is {theirs.get(name)}, "
                f"this one's {mine.get(name)}"
            )
    learner.load(part_of(found.state, "learner", path))
    return episodes_of(found, path)


def episodes_of(found: Checkpoint, path: Path) -> list[EpisodeResult]:
    """The episodes that a checkpoint was written after."""
    kept = part_of(found.state, "episodes", path)
    names = [
        name
        for entry in found.settings["parts"].split(",")
        for name, _, count in [entry.rpartition(":")]
        for _ in range(int(count))
    ]
    rows = zip(
        *(np.asarray(kept[name]).tolist() for name in ("kind", "steps", "seconds")), strict=True
    )
    return [
        EpisodeResult(number, names[number - 1], KINDS[kind], "", steps, seconds)
        for number, (kind, steps, seconds) in enumerate(rows, 1)
    ]


def part_of(state: State, name: str, path: Path) -> State:
    """A part of a training's state; CheckpointError when it has none."""
    found = state.get(name)
    if not isinstance(found, dict):
        raise CheckpointError(f"{path}: no '{name}' in it: not a training's checkpoint")
    return found
