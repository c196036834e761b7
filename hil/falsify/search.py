"""Looks for the case of least robustness: Optuna's TPE, or draws to compare it with.

The estimator learns from its first runs, so these are drawn where the space says that harm is
likely, each kind of part in turn; uniform ones would tell it little in as few runs.
"""

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import Final, Literal

import numpy as np
import optuna
from optuna.samplers import BaseSampler, RandomSampler, TPESampler
from optuna.trial import Trial

from hil.cell.streams import stream
from hil.falsify.space import Axis, Case, Choice, Part, Space, Value

Sampler = Literal["tpe", "likely", "random"]
"""likely: draws like the estimator's first ones, and nothing else. random: uniform draws."""

Robustness = Callable[[Case], float]
"""Of one run; below 0 is a violation."""
Told = Callable[[int, Case, float], None]

STARTUP: Final = 8
"""Runs before the estimator has something to go by."""
AFRESH: Final = 4
"""Every so many runs is drawn like the first ones: an estimator may be stuck in a corner."""


@dataclass(frozen=True, slots=True)
class Found:
    """The worst case of a search. runs: until it was found, or all of them."""

    case: Case
    robustness: float
    runs: int

    @property
    def violated(self) -> bool:
        return self.robustness < 0.0


def search(
    slots: Sequence[Space],
    robustness: Robustness,
    *,
    budget: int,
    seed: int,
    sampler: Sampler = "tpe",
    tell: Told = lambda *_: None,
) -> Found:
    """Run up to `budget` cases of one part from each slot, and stop at the first violation."""
    optuna.logging.set_verbosity(optuna.logging.ERROR)
    study = optuna.create_study(sampler=_sampler(sampler, seed))
    worst: Found | None = None
    rng = stream(seed, "falsify.first")
    for run in range(1, budget + 1):
        if sampler == "likely" or (sampler == "tpe" and (run <= STARTUP or run % AFRESH == 0)):
            study.enqueue_trial(_first(slots, run, rng))
        trial = study.ask()
        case = tuple(_part(trial, space, index) for index, space in enumerate(slots))
        value = robustness(case)
        study.tell(trial, value)
        tell(run, case, value)
        if worst is None or value < worst.robustness:
            worst = Found(case, value, run)
        if worst.violated:
            return worst
    if worst is None:
        raise ValueError("a search needs a budget of one run at least")
    return Found(worst.case, worst.robustness, budget)


def _sampler(name: str, seed: int) -> BaseSampler:
    if name != "tpe":
        return RandomSampler(seed=seed)
    return TPESampler(seed=seed, n_startup_trials=STARTUP, multivariate=True)


def _first(slots: Sequence[Space], run: int, rng: np.random.Generator) -> dict[str, Value]:
    """Values of the first runs' axes, by the names that `_part` asks for."""
    values: dict[str, Value] = {}
    for index, space in enumerate(slots):
        kind = list(space)[run % len(space)]
        values[f"{index}.kind"] = kind
        values |= {f"{index}.{kind}.{name}": axis.first(rng) for name, axis in space[kind].items()}
    return values


def _part(trial: Trial, space: Space, index: int) -> Part:
    kinds = list(space)
    kind = kinds[0]
    if len(kinds) > 1:
        kind = trial.suggest_categorical(f"{index}.kind", kinds)
    values = {
        name: _value(trial, f"{index}.{kind}.{name}", axis) for name, axis in space[kind].items()
    }
    return Part(kind, values)


def _value(trial: Trial, name: str, axis: Axis | Choice) -> Value:
    if isinstance(axis, Choice):
        return trial.suggest_categorical(name, axis.words)
    if axis.whole:
        return trial.suggest_int(name, round(axis.low), round(axis.high))
    return trial.suggest_float(name, axis.low, axis.high, log=axis.log)
