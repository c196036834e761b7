"""Eqs. 1 and 2 as spaces: what an agent with a neural network is shown and may do."""

import gymnasium
import numpy as np
from gymnasium import spaces
from numpy.typing import NDArray

from controller.action import Action, Observation
from learner.grid import Grid

Seen = NDArray[np.float32]

POSE = 3
"""Quantities of a pose."""
BOUNDS = (1.5, 1.5, 10.0, 1.0)
"""The paper's safe boundary f_b of fx, fy, fz (N) and tau_z (N·m): forces are given over it."""
FAR = 2.0
"""Forces beyond so many times f_b are cut: the episode is over at 1."""


def observations(*, forces: bool) -> gymnasium.Space[Seen]:
    """(3,): x, y, theta over the box's half widths. With `forces` (7,): and fx, fy, fz, tau_z."""
    high = np.array([1.0] * POSE + [FAR] * 4 * forces, np.float32)
    return spaces.Box(-high, high, dtype=np.float32)


def actions() -> spaces.Discrete:
    """The six steps of Eq. 2, in the order of `Action`."""
    return spaces.Discrete(len(Action))


def encoded(grid: Grid, observation: Observation, *, forces: bool) -> Seen:
    """What the agent is shown; the pose is that of the nearest cell, as the tables see it."""
    pose = np.divide(grid.cell(observation), np.maximum(1, grid.halves))
    if not forces:
        return pose.astype(np.float32)
    felt = np.array([observation.fx, observation.fy, observation.fz, observation.tau_z])
    scaled = np.clip(felt / BOUNDS, -FAR, FAR)
    return np.concatenate([pose, scaled]).astype(np.float32)
