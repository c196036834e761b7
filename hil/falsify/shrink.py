"""From a case that violates to the least of it that still does, and what in it does not matter."""

from collections.abc import Callable
from dataclasses import dataclass
from typing import Final

from hil.falsify.space import Axis, Case, Choice, Space, Value, replaced

PROBES: Final = (0.0, 0.35, 0.7, 1.0)
"""Where in its range a value is tried before it is called irrelevant."""


@dataclass(frozen=True, slots=True)
class Shrunk:
    """The least case. irrelevant: part index and axis whose every tried value violates too.

    runs: what it took.
    """

    case: Case
    irrelevant: frozenset[tuple[int, str]]
    runs: int


def shrink(case: Case, space: Space, violates: Callable[[Case], bool], budget: int) -> Shrunk:
    """Drop parts, then bring each value as near to its neutral one as a violation allows.

    What is tried last and still violates is what is returned, so the result always does. With the
    budget used up, what is left stays as it is; ValueError for a case that does not violate.
    """
    trial = _Trial(violates, budget)
    if not trial(case):
        raise ValueError("the case does not violate anything: nothing to shrink")
    case = _fewer(case, trial)
    before: Case | None = None
    while case != before:
        before = case
        for index, name in _places(case):
            case = _nearer(case, index, name, space, trial)
    for index, name in _places(case):  # last, since a rounder number may be a farther one
        case = _rounder(case, index, name, space, trial)
    return Shrunk(case, _irrelevant(case, space, trial), trial.runs)


def _places(case: Case) -> list[tuple[int, str]]:
    return [(index, name) for index, part in enumerate(case) for name in part.values]


class _Trial:
    """Whether a case violates, each asked once; False once the budget is used up."""

    def __init__(self, violates: Callable[[Case], bool], budget: int) -> None:
        self._violates, self._budget = violates, budget
        self._known: dict[str, bool] = {}
        self.runs = 0

    def __call__(self, case: Case) -> bool:
        key = repr([(part.kind, sorted(part.values.items())) for part in case])
        if key not in self._known:
            if self.runs >= self._budget:
                return False
            self.runs += 1
            self._known[key] = self._violates(case)
        return self._known[key]


def _fewer(case: Case, violates: _Trial) -> Case:
    index = 0
    while index < len(case) and len(case) > 1:
        without = (*case[:index], *case[index + 1 :])
        if violates(without):
            case = without
        else:
            index += 1
    return case


def _nearer(case: Case, index: int, name: str, space: Space, violates: _Trial) -> Case:
    """With one value simpler, or as near to its neutral one as a violation allows."""
    part = case[index]
    axis, value = space[part.kind][name], part.values[name]

    def at(value: Value) -> Case:
        return replaced(case, index, part.having(name, value))

    for simpler in axis.simpler(value):
        if violates(at(simpler)):
            return at(simpler)
    if isinstance(axis, Choice):
        return case
    return at(_nearest(axis, value, lambda tried: violates(at(tried))))


def _rounder(case: Case, index: int, name: str, space: Space, violates: _Trial) -> Case:
    """With one value of as few digits as a violation allows."""
    part = case[index]
    short = space[part.kind][name].rounded(part.values[name])
    tried = (replaced(case, index, part.having(name, value)) for value in short)
    return next(filter(violates, tried), case)


def _nearest(axis: Axis, value: Value, violates: Callable[[Value], bool]) -> Value:
    """The value nearest to neutral that still violates, by bisection; neutral itself does not."""
    good: Value = axis.neutral
    while (middle := axis.between(good, value)) is not None:
        if violates(middle):
            value = middle
        else:
            good = middle
    return value


def _irrelevant(case: Case, space: Space, violates: _Trial) -> frozenset[tuple[int, str]]:
    def matters_not(index: int, name: str) -> bool:
        part = case[index]
        values = space[part.kind][name].samples(PROBES)
        tried = (replaced(case, index, part.having(name, value)) for value in values)
        return all(map(violates, tried))

    return frozenset(place for place in _places(case) if matters_not(*place))
