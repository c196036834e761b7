"""Nets and their optimisers as arrays in a checkpoint, and back."""

from collections.abc import Mapping

import numpy as np
import torch

from learner.errors import CheckpointError
from learner.interface import State
from learner.tabular.tables import restore


def of_net(net: torch.nn.Module) -> State:
    """Its weights by name."""
    return {name: value.numpy().copy() for name, value in net.state_dict().items()}


def into_net(net: torch.nn.Module, state: object) -> None:
    """Fill it; CheckpointError when a weight is missing or of another shape."""
    for name, value in net.state_dict().items():
        restore(name, value.numpy(), part(state).get(name))


def of_optimiser(optimiser: torch.optim.Optimizer) -> State:
    """Its moments, "0.exp_avg" and so on; empty before its first step."""
    moments = optimiser.state_dict()["state"]
    return {
        f"{index}.{name}": value.numpy().copy()
        for index, each in moments.items()
        for name, value in each.items()
    }


def into_optimiser(optimiser: torch.optim.Optimizer, state: object) -> None:
    """Take up saved moments; CheckpointError for anything else."""
    moments: dict[int, dict[str, torch.Tensor]] = {}
    for key, value in part(state).items():
        index, _, name = key.partition(".")
        if not isinstance(value, np.ndarray) or not index.isdecimal():
            raise CheckpointError(f"'{key}' is no moment of an optimiser")
        moments.setdefault(int(index), {})[name] = torch.from_numpy(value.copy())
    optimiser.load_state_dict({**optimiser.state_dict(), "state": moments})


def part(state: object) -> State:
    """A part of a saved state; CheckpointError when it is none."""
    if not isinstance(state, Mapping):
        raise CheckpointError("no weights in it: not a neural learner's")
    return state
