"""A formula at work: one verdict a step, from the values of that step and bounded memory."""

from collections.abc import Callable, Iterable, Mapping
from difflib import get_close_matches
from math import inf, isnan
from typing import NamedTuple, TypeAlias

from hil.monitors.errors import MonitorError
from hil.monitors.formula import And, Comparison, Formula, Historically, Linear, Once, signals
from hil.monitors.parse import parse
from hil.monitors.window import Minimum

Values: TypeAlias = Mapping[str, float]


class Verdict(NamedTuple):
    """holds: whether the formula is true. robustness: by how much, in scales; negative: false.

    They differ in sign only at 0, where a strict comparison is false. A value that is not a number
    makes its comparison false, at -inf, negated or not: nothing is proven by a missing reading.
    """

    robustness: float
    holds: bool


_Step: TypeAlias = Callable[[Values], Verdict]


class Monitor:
    """One formula over signals with these scales: what counts as one unit of each, positive.

    Raises MonitorError for a formula that cannot be read or that names another signal.
    """

    def __init__(self, text: str, scales: Mapping[str, float]) -> None:
        self.text = text
        formula = parse(text)
        self.signals = signals(formula)
        _known(text, self.signals, scales)
        self._step = _evaluator(formula, scales)

    def step(self, values: Values) -> Verdict:
        """The verdict after one more step; KeyError when a signal of the formula is missing."""
        return self._step(values)


def offline(text: str, scales: Mapping[str, float], rows: Iterable[Values]) -> list[Verdict]:
    """The verdict at each step of a whole trace."""
    return list(map(Monitor(text, scales).step, rows))


def _known(text: str, names: Iterable[str], scales: Mapping[str, float]) -> None:
    for name in sorted(names):
        if name not in scales:
            near = get_close_matches(name, scales, 1)
            hint = f"did you mean '{near[0]}'?" if near else f"known: {', '.join(sorted(scales))}"
            raise MonitorError(f"'{text}': no signal '{name}'; {hint}")


def _evaluator(formula: Formula, scales: Mapping[str, float]) -> _Step:
    if isinstance(formula, Comparison):
        return _comparison(formula, scales)
    if isinstance(formula, Once | Historically):
        return _windowed(formula, scales)
    worst = min if isinstance(formula, And) else max
    steps = [_evaluator(part, scales) for part in formula.parts]
    # Every part sees every step: a short cut would starve the windows further inside.
    return lambda values: worst([step(values) for step in steps])


def _comparison(formula: Comparison, scales: Mapping[str, float]) -> _Step:
    difference, strict = formula.difference, formula.strict
    # The finest signal decides: a sum of unlike units has no scale of its own.
    scale = min((scales[name] for name in signals(formula)), default=1.0)

    def step(values: Values) -> Verdict:
        margin = _value(difference, values)
        if isnan(margin):
            return Verdict(-inf, False)
        return Verdict(margin / scale, margin > 0.0 if strict else margin >= 0.0)

    return step


def _windowed(formula: Once | Historically, scales: Mapping[str, float]) -> _Step:
    inner = _evaluator(formula.of, scales)
    sign = 1.0 if isinstance(formula, Historically) else -1.0
    robustness, truth = Minimum(formula.window), Minimum(formula.window)

    def step(values: Values) -> Verdict:
        verdict = inner(values)
        margin = sign * robustness.take(sign * verdict.robustness)
        return Verdict(margin, sign * truth.take(sign if verdict.holds else -sign) > 0.0)

    return step


def _value(linear: Linear, values: Values) -> float:
    total = linear.constant
    for factor, term in linear.terms:
        value = values[term] if isinstance(term, str) else abs(_value(term, values))
        total += factor * value
    return total
