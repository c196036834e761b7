"""How a job ended."""

from dataclasses import dataclass
from enum import Enum


class Kind(Enum):
    """INSERTED, LIMIT (k_max steps), DANGER (force bound) as in Eq. 4; the rest never got there."""

    INSERTED = "inserted"
    DANGER = "danger"
    LIMIT = "limit"
    NO_GRIP = "no_grip"
    FAULT = "fault"
    DONE = "done"


@dataclass(frozen=True, slots=True)
class Ending:
    """What the job itself says when it returns."""

    kind: Kind
    reason: str


@dataclass(frozen=True, slots=True)
class Outcome:
    """kind and reason; steps: search steps taken; cycles: control periods run.

    misses: periods the arm's clock skipped. standstill: after a stop, whether the arm was seen at
    rest; None when nothing had to be stopped.
    """

    kind: Kind
    reason: str
    steps: int
    cycles: int
    misses: int
    standstill: bool | None = None
