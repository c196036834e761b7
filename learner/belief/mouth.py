"""What a part that is caught in the slot's mouth tells, and how it gets further in.

A tip that meets the slot beside its middle dips in with one corner and stays: the walls hold it
across the slot and let it turn, so that it lies along the slot whatever the jaws do. Only steps
along the slot lead on; at full depth, a turn that lets go of the walls. The z of Eq. 1 shows it: on
the face the tip is never as deep. All numbers here were measured on the contact plant.
"""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from controller.action import Action, Observation
from learner.belief.planning import Plan
from learner.grid import Cell
from learner.tabular.dice import Words

Array = NDArray[np.float64]

PRESSED = -0.25e-3
"""z at which a part is pressed on a face at z = 0, m."""
_ELSEWHERE = 1e-3
"""Likelihood of being caught further off than a kernel reaches."""


@dataclass(frozen=True, slots=True)
class Mouth:
    """depth, home: m below the face from which the tip is in the mouth, and in the slot proper.

    across, around, along: likelihood of being caught, by steps of y, theta, x between jaws and
    slot. deeper, turned: chance that sinking on a step along x, or the sign of tau_z, shows the way
    to the slot. in_line: chance that a step along x ends it, by steps off.
    """

    depth: float = 0.2e-3
    home: float = 1.2e-3
    across: tuple[float, ...] = (1.0, 0.15)
    around: tuple[float, ...] = (1.0, 1.0, 0.6, 0.3, 0.1)
    along: tuple[float, ...] = (0.3, 0.7, 1.0, 1.0, 1.0, 1.0, 0.8, 0.5)
    deeper: float = 0.95
    turned: float = 0.97
    in_line: tuple[float, ...] = (0.7, 0.4)


class Sinking:
    """The face's height as far as it has been felt, and with it how deep a tip is.

    It begins at where the task frame has the face: a first part may be caught before it touches.
    """

    def __init__(self) -> None:
        self.face: Array = np.array([PRESSED])

    def look(self, observation: Observation) -> None:
        self.face[0] = max(self.face[0], observation.z)

    def depth(self, observation: Observation) -> float:
        """Below the highest place on which a part has been pressed, m."""
        return max(0.0, float(self.face[0]) - observation.z)


def caught(shape: tuple[int, int, int], at: Cell, mouth: Mouth) -> Array:
    """Likelihood, for a slot at each pose, that a step to `at` is caught there."""
    x, y, theta = (
        _by_distance(size, place, kernel)
        for size, place, kernel in zip(
            shape, at, (mouth.along, mouth.across, mouth.around), strict=True
        )
    )
    likelihood: Array = x[:, None, None] * y[None, :, None] * theta[None, None, :]
    return likelihood


def slid(shape: tuple[int, int, int], at: Cell, way: float, mouth: Mouth) -> Array:
    """Likelihood of a step along x that went `way` (+ or -) to `at`, sank (way > 0) or rose.

    `way` is the direction to the slot that the change of depth shows: the step's own when it sank.
    """
    missed = 1.0 - _by_distance(shape[0], at.x, mouth.in_line, 0.0)
    side = np.sign(np.arange(shape[0]) - at.x) * np.sign(way)
    shown = np.where(side > 0, mouth.deeper, np.where(side < 0, 1.0 - mouth.deeper, 0.5))
    along: Array = (missed * shown)[:, None, None]
    return along


def turned(shape: tuple[int, int, int], at: Cell, tau: float, mouth: Mouth) -> Array:
    """Likelihood of the moment's sign, which turns a held part towards the slot."""
    side = np.sign(np.arange(shape[2]) - at.theta) * np.sign(tau)
    shown = np.where(side > 0, mouth.turned, np.where(side < 0, 1.0 - mouth.turned, 0.5))
    around: Array = shown[None, None, :]
    return around


class Slide:
    """The plan in the mouth: along x alone, on the belief's share of each x."""

    def __init__(self, size: int, mouth: Mouth) -> None:
        self._plan = Plan((size, 1, 1))
        self._mouth = mouth

    def step(self, belief: Array, at: Cell, gamma: float, dice: Words) -> Action:
        """The better of the two steps along x."""
        share = belief.sum(axis=(1, 2))
        kernel = np.array([*self._mouth.in_line[:0:-1], *self._mouth.in_line])
        success = np.convolve(share, kernel, mode="same")[:, None, None]
        self._plan.forget()
        self._plan.improve(success, np.zeros_like(success), gamma, 0.0, 2 * len(share))
        return Action(self._plan.step(Cell(at.x, 0, 0), dice))


def _by_distance(
    size: int, place: int, kernel: tuple[float, ...], beyond: float = _ELSEWHERE
) -> Array:
    far = np.abs(np.arange(size) - place)
    padded = np.append(kernel, beyond)
    values: Array = padded[np.minimum(far, len(kernel))]
    return values
