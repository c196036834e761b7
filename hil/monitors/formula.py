"""The tree of a formula: what is asserted, without any state.

Time is in steps (control periods) and looks back only, so the same formula runs live with bounded
memory and offline with the same result.
"""

from dataclasses import dataclass
from typing import NamedTuple, TypeAlias


class Window(NamedTuple):
    """Steps back, from `near` (0 is now) to `far`; None reaches to the first step."""

    near: int = 0
    far: int | None = None


@dataclass(frozen=True, slots=True)
class Linear:
    """A sum of signals, magnitudes and a constant: constant + Σ factor * term."""

    constant: float
    terms: tuple[tuple[float, "str | Linear"], ...]
    """A name is a signal; a Linear stands for its own magnitude."""


@dataclass(frozen=True, slots=True)
class Comparison:
    """difference >= 0, or > 0 when strict."""

    difference: Linear
    strict: bool


@dataclass(frozen=True, slots=True)
class And:
    parts: tuple["Formula", ...]


@dataclass(frozen=True, slots=True)
class Or:
    parts: tuple["Formula", ...]


@dataclass(frozen=True, slots=True)
class Historically:
    """At every step of the window; true where the window lies before the first step."""

    of: "Formula"
    window: Window


@dataclass(frozen=True, slots=True)
class Once:
    """At some step of the window; false where the window lies before the first step."""

    of: "Formula"
    window: Window


Formula: TypeAlias = Comparison | And | Or | Historically | Once
"""Negation is carried down to the comparisons while reading, see `negated`."""


def negated(formula: Formula) -> Formula:
    """What is true where `formula` is false, every signal being a number."""
    match formula:
        case Comparison(difference, strict):
            return Comparison(combined(Linear(0.0, ()), difference, -1.0), not strict)
        case And(parts):
            return Or(tuple(map(negated, parts)))
        case Or(parts):
            return And(tuple(map(negated, parts)))
        case Historically(of, window):
            return Once(negated(of), window)
        case Once(of, window):
            return Historically(negated(of), window)


def combined(left: Linear, right: Linear, factor: float) -> Linear:
    """The sum left + factor * right."""
    scaled = tuple((factor * k, term) for k, term in right.terms)
    return Linear(left.constant + factor * right.constant, left.terms + scaled)


def signals(formula: Formula) -> frozenset[str]:
    """Names of all signals in it."""
    if isinstance(formula, Comparison):
        return _named(formula.difference)
    parts = formula.parts if isinstance(formula, And | Or) else (formula.of,)
    return frozenset().union(*map(signals, parts))


def _named(linear: Linear) -> frozenset[str]:
    names: frozenset[str] = frozenset()
    for _, term in linear.terms:
        names |= frozenset((term,)) if isinstance(term, str) else _named(term)
    return names
