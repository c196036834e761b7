"""What a search is for: which parameters, where they are looked for, what a set is worth."""

from collections.abc import Callable, Mapping
from typing import NamedTuple, TypeAlias

from hil.tuning.ranges import Looked

Values: TypeAlias = Mapping[str, bool | int | float | str]


class Worth(NamedTuple):
    """cost: to be minimised. violations: how far each constraint is passed, <= 0 if kept."""

    cost: float
    violations: Mapping[str, float] = {}


class Purpose(NamedTuple):
    """name: of the study in the journal. text: the study file, by which a journal is known.

    ranges: by parameter. worth: raises TuningError or LearnerError for a set that it refuses.
    """

    name: str
    text: str
    ranges: Mapping[str, Looked]
    worth: Callable[[Values], Worth]
