"""Eqs. 1 and 2 of the paper: what a search step sees and what it may do."""

from enum import Enum, IntEnum
from typing import NamedTuple, Protocol, TypeAlias

from controller.cycle import Cycle


class Action(IntEnum):
    """Eq. 2: one step of the set-point along x or y, or about z."""

    PLUS_X = 0
    MINUS_X = 1
    PLUS_Y = 2
    MINUS_Y = 3
    PLUS_THETA = 4
    MINUS_THETA = 5

    @property
    def axis(self) -> int:
        """0: x, 1: y, 2: theta."""
        return self >> 1

    @property
    def sign(self) -> int:
        return -1 if self & 1 else 1


class Observation(NamedTuple):
    """Eq. 1: 8 ms mean forces (N), tau_z (N·m) and the actual TCP (m, rad), in the task frame."""

    fx: float
    fy: float
    fz: float
    tau_z: float
    x: float
    y: float
    z: float
    theta: float


class Pending(Enum):
    """No answer yet."""

    PENDING = "pending"


Answer: TypeAlias = Action | Pending | None
"""None gives the episode up. Pending: still thinking; the target is held, and a period later the
policy is asked again, with what is seen then.
"""


class Policy(Protocol):
    """Whatever picks the next search step. It must not block: control does not wait for it."""

    def choose(self, observation: Observation) -> Answer: ...


def observation(cycle: Cycle) -> Observation:
    fx, fy, fz, _, _, tau_z = cycle.wrench
    return Observation(fx, fy, fz, tau_z, *cycle.stage)
