"""The paper's protocol on a world: train with one part, verify with another."""

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np

from controller.outcome import Kind
from learner.episode import Episode
from learner.interface import Learner
from learner.worlds.interface import World


@dataclass(frozen=True, slots=True)
class Protocol:
    """Episodes with the first part, and with the second one, which lies otherwise in the jaws."""

    training: int = 48
    verification: int = 2

    def __post_init__(self) -> None:
        if self.training < 0 or self.verification < 0:
            raise ValueError(f"a number of episodes cannot be negative, found {self}")


@dataclass(frozen=True, slots=True)
class Result:
    """One episode: its number from 1, the part's from 1, how it ended, search steps."""

    number: int
    part: int
    kind: Kind
    steps: int


def evaluate(
    learner: Learner, world: World, protocol: Protocol, rng: np.random.Generator
) -> Iterator[Result]:
    """Every episode of the protocol on one cell, drawn from `rng`."""
    world.reset(rng)
    for number in range(1, protocol.training + protocol.verification + 1):
        if number == protocol.training + 1:
            world.regrip()
            learner.grip_changed()
        kind, steps = _episode(learner, world)
        yield Result(number, 1 if number <= protocol.training else 2, kind, steps)


def _episode(learner: Learner, world: World) -> tuple[Kind, int]:
    policy, seen = Episode(learner), world.begin()
    while True:
        met = world.step(policy.choose(seen))
        seen = met.observation
        if met.ending is not None:
            policy.end(seen, met.ending)
            return met.ending, policy.steps
