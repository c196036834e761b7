"""A learner's study file, and what a set of its parameters is worth on worlds without physics."""

from collections.abc import Callable, Iterable, Iterator
from concurrent.futures import ProcessPoolExecutor
from contextlib import contextmanager
from functools import partial
from multiprocessing import get_context
from typing import NamedTuple

import numpy as np
from pydantic import Field

from controller.outcome import Kind
from hil.cell.streams import stream
from hil.tuning.purpose import Purpose, Values, Worth
from hil.tuning.ranges import Choice, Looked, Part
from learner.build import maker
from learner.worlds.evaluate import Protocol, evaluate
from learner.worlds.named import model
from learner.worlds.slot import SlotWorld


class LearnerStudy(Part):
    """learner: a name, or package.module:Class. Each set is tried on every world with every seed,
    for so many episodes with each part. danger: steps that a danger counts as.
    """

    learner: str
    worlds: tuple[str, ...] = Field(default=("ffc",), min_length=1)
    seeds: tuple[int, ...] = Field(default=tuple(range(1000, 1008)), min_length=1)
    training: int = Field(default=48, ge=1)
    verification: int = Field(default=2, ge=0)
    danger: float = Field(default=200.0, ge=0)
    parameters: dict[str, Looked] = Field(min_length=1)


class Trial(NamedTuple):
    """One training: what it is with, and where."""

    study: LearnerStudy
    values: dict[str, bool | int | float | str]
    world: str
    seed: int


Mapped = Callable[[Callable[[Trial], float], Iterable[Trial]], Iterable[float]]
"""`map`, or one over several processes."""


def purpose(study: LearnerStudy, mapped: Mapped = map) -> Purpose:
    """The search; UnknownWorldError, or LearnerError when the learner refuses the first set."""
    for world in study.worlds:
        model(world)
    maker(study.learner, first(study))
    return Purpose(study.learner, study.model_dump_json(), study.parameters,
                   partial(worth, study, mapped=mapped))  # fmt: skip


def first(study: LearnerStudy) -> dict[str, bool | int | float | str]:
    """A set inside the ranges: where the search starts, or their lower ends."""
    return {name: _first(looked) for name, looked in study.parameters.items()}


def worth(study: LearnerStudy, values: Values, mapped: Mapped = map) -> Worth:
    """Mean over worlds and seeds of steps an episode, each danger counted as `study.danger`."""
    trials = [
        Trial(study, dict(values), world, seed) for world in study.worlds for seed in study.seeds
    ]
    return Worth(float(np.mean(list(mapped(cost, trials)))))


def cost(trial: Trial) -> float:
    """Of one training; the same for the same trial, in whichever process."""
    study, values, name, seed = trial
    world = SlotWorld(model(name))
    learner = maker(study.learner, values)(world.grid, world.max_steps, stream(seed, "learner"))
    protocol = Protocol(study.training, study.verification)
    paid = [
        result.steps + study.danger * (result.kind is Kind.DANGER)
        for result in evaluate(learner, world, protocol, stream(seed, "world"))
    ]
    return float(np.mean(paid))


@contextmanager
def opened(jobs: int) -> Iterator[Mapped]:
    """`map`, over so many processes."""
    if jobs == 1:
        yield map
        return
    with ProcessPoolExecutor(jobs, get_context("spawn")) as pool:
        yield pool.map


def _first(looked: Looked) -> bool | int | float | str:
    if isinstance(looked, Choice):
        return looked.choices[0] if looked.start is None else looked.start
    value = looked.low if looked.start is None else looked.start
    return int(value) if looked.whole else value
