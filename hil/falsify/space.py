"""What a search may vary: parts that break something, each with values on axes."""

from collections.abc import Mapping
from dataclasses import dataclass, replace
from math import isclose
from typing import Final, NamedTuple, TypeAlias

import numpy as np

Value: TypeAlias = float | int | str

AROUND: Final = 4.0
"""A search begins within this factor of where an axis says that harm is likely."""


@dataclass(frozen=True, slots=True)
class Axis:
    """A number from low to high; neutral: the value that says least. whole: integers only.

    log: drawn by its logarithm, where the range covers decades. likely: a positive value near which
    a search for harm begins; None is anywhere.
    """

    low: float
    high: float
    neutral: float
    whole: bool = False
    log: bool = False
    likely: float | None = None

    def first(self, rng: np.random.Generator) -> Value:
        """A value to begin a search with."""
        if self.likely is None:
            return self._of(float(rng.uniform(self.low, self.high)))
        low, high = max(self.low, self.likely / AROUND), min(self.high, self.likely * AROUND)
        return self._of(float(np.exp(rng.uniform(np.log(low), np.log(high)))))

    def reaching(self, value: Value) -> "Axis":
        """The same, wide enough for a value."""
        return replace(self, low=min(self.low, float(value)), high=max(self.high, float(value)))

    def simpler(self, value: Value) -> list[Value]:
        """Values to try in its stead, the simplest first."""
        return [] if isclose(float(value), self.neutral) else [self._of(self.neutral)]

    def samples(self, fractions: tuple[float, ...]) -> list[Value]:
        """Values at these fractions of the range."""
        return [self._of(self.low + share * (self.high - self.low)) for share in fractions]

    def between(self, near: Value, far: Value) -> Value | None:
        """Half way from near to far; None where nothing lies between that makes a difference."""
        middle = self._of((float(near) + float(far)) / 2)
        close = isclose(
            float(near), float(far), rel_tol=0.02, abs_tol=0.01 * (self.high - self.low)
        )
        return None if close or middle in (near, far) else middle

    def rounded(self, value: Value) -> list[Value]:
        """The value with fewer digits, fewest first."""
        if self.whole:
            return []
        rounded = (float(f"{float(value):.{digits}g}") for digits in (1, 2, 3))
        return [x for x in rounded if self.low <= x <= self.high]

    def _of(self, value: float) -> Value:
        return round(value) if self.whole else value


@dataclass(frozen=True, slots=True)
class Choice:
    """One word of several, the one that says least first."""

    words: tuple[str, ...]

    def first(self, rng: np.random.Generator) -> Value:
        return self.words[rng.integers(len(self.words))]

    def reaching(self, value: Value) -> "Choice":
        return self if value in self.words else Choice((*self.words, str(value)))

    def simpler(self, value: Value) -> list[Value]:
        return list(self.words[: self.words.index(str(value))])

    def samples(self, fractions: tuple[float, ...]) -> list[Value]:
        return list(self.words)

    def between(self, near: Value, far: Value) -> Value | None:
        return None

    def rounded(self, value: Value) -> list[Value]:
        return []


Axes: TypeAlias = Mapping[str, Axis | Choice]
Space: TypeAlias = Mapping[str, Axes]
"""Axes of each kind of part."""


class Part(NamedTuple):
    """One thing that is broken or varied, and how."""

    kind: str
    values: Mapping[str, Value]

    def having(self, name: str, value: Value) -> "Part":
        return Part(self.kind, {**self.values, name: value})


Case: TypeAlias = tuple[Part, ...]
"""What is tried in one run."""


def replaced(case: Case, index: int, part: Part) -> Case:
    return (*case[:index], part, *case[index + 1 :])
