"""What a trigger may look at in one control period."""

from typing import NamedTuple


class Situation(NamedTuple):
    """t: bench time, ns. cycle: control periods since power-up. phase: the job's own name for it.

    contact: whether the part or tool touches. force: size of the contact force, N. safety: the
    robot's safety mode in lower case. active, cleared: ids of the faults that are, or were.
    """

    t: int
    cycle: int
    phase: str = "start"
    episode: int = 0
    contact: bool = False
    force: float = 0.0
    safety: str = "normal"
    active: frozenset[str] = frozenset()
    cleared: frozenset[str] = frozenset()
