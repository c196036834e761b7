"""A learner's own randomness where torch and SB3 draw from the process's generators."""

from collections.abc import Iterator, Mapping
from contextlib import contextmanager

import numpy as np
import torch
from numpy.random.mtrand import (  # numpy.random exports them without saying so
    get_bit_generator,
    set_bit_generator,
)

from learner.errors import CheckpointError
from learner.interface import State
from learner.tabular.tables import restore


class Dice:
    """Inside `thrown`, numpy's and torch's global generators are this learner's, and its small nets
    run on one thread, where they are fastest. On leaving everything is as the process had it.
    """

    def __init__(self, seed: int) -> None:
        self._numpy = np.random.PCG64(seed)
        self._torch = torch.Generator().manual_seed(seed).get_state()

    @contextmanager
    def thrown(self) -> Iterator[None]:
        """Whatever draws in here draws this learner's numbers."""
        outside = get_bit_generator(), torch.get_rng_state(), torch.get_num_threads()
        set_bit_generator(self._numpy)
        torch.set_rng_state(self._torch)
        torch.set_num_threads(1)
        try:
            yield
        finally:
            self._torch = torch.get_rng_state()
            set_bit_generator(outside[0])
            torch.set_rng_state(outside[1])
            torch.set_num_threads(outside[2])

    def save(self) -> State:
        return {"numpy": saved(self._numpy), "torch": self._torch.numpy().copy()}

    def load(self, state: State) -> None:
        """Take up saved generators; CheckpointError for anything else."""
        take_up(self._numpy, state.get("numpy"))
        bits = self._torch.numpy().copy()
        restore("torch", bits, state.get("torch"))
        self._torch = torch.from_numpy(bits)


def saved(generator: np.random.BitGenerator) -> State:
    """Its state, as a checkpoint keeps it."""
    state: State = dict(generator.state)
    return state


def take_up(generator: np.random.BitGenerator, state: object) -> None:
    """The other way round; CheckpointError when it is none of this generator's."""
    if not isinstance(state, Mapping):
        raise CheckpointError("no generator's state in it: not a neural learner's")
    try:
        generator.state = dict(state)
    except (KeyError, TypeError, ValueError) as error:
        raise CheckpointError(f"not a generator's state: {error}") from None
