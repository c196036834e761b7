"""What the bench asks of a plant, whichever physics is inside.

Task frame: origin in the middle of the slot's mouth on the connector's face, z out of the face,
x along the slot's long side. The stage is the TCP (nominal FFC tip) in that frame: (x, y, z, theta)
in metres and radians about z. Wrenches act on the tool, in the sensor's frame, whose z points out
of the tool: at theta = 0 its axes are the task frame's turned by pi about x. They include tool
weight and inertia, as a wrist sensor feels them.
"""

from dataclasses import dataclass
from enum import Enum
from typing import NamedTuple, Protocol

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]


class StageTarget(NamedTuple):
    """Set-point of one control period; jaws_closed is the jaws' true position, delay included."""

    x: float
    y: float
    z: float
    theta: float
    jaws_closed: bool


class Contact(Enum):
    """Where the part's tip is, as the model sees it."""

    FREE = "free"
    FACE = "face"
    SLOT = "slot"
    BOTTOM = "bottom"


@dataclass(frozen=True, slots=True)
class PartTruth:
    """The gripped part as nobody in the cell can measure it.

    tip: tip middle in task frame, m. theta: tip rotation about z, rad. depth: below the face, m.
    grip: part in jaws (x, y, theta), m, m, rad, slip included. name: None when the jaws are empty.
    """

    name: str | None
    tip: tuple[float, float, float]
    theta: float
    depth: float
    grip: tuple[float, float, float]
    contact: Contact


@dataclass(frozen=True, slots=True)
class PlantStep:
    """One control period of physics.

    wrenches: true wrench at 1 ms, 2 ms, ... of the period, in the sensor's frame.  # (n, 6)
    stage, velocity: TCP at the period's end in task frame, m, rad and per second.  # (4,)
    posture: positions of all of the model's joints, for pictures; () from a plant without a body.
    """

    wrenches: Array
    stage: tuple[float, float, float, float]
    velocity: tuple[float, float, float, float]
    part: PartTruth
    posture: tuple[float, ...] = ()


class Plant(Protocol):
    """Physics of stage, jaws, part and connector; same inputs give the same bits."""

    def reset(self, stage: StageTarget) -> PlantStep:
        """Start at rest at `stage` with open jaws and every part in its fixture."""
        ...

    def step(self, target: StageTarget, duration: int) -> PlantStep:
        """Advance by `duration` ns (a multiple of 1 ms); raises PlantError when physics breaks."""
        ...
