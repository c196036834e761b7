"""The search itself: Optuna's TPE on a journal file, so that a stopped one goes on."""

from collections.abc import Callable, Sequence
from pathlib import Path

import optuna
from optuna.samplers import TPESampler
from optuna.storages import JournalStorage
from optuna.storages.journal import JournalFileBackend
from optuna.trial import FrozenTrial, Trial, TrialState

from hil.tuning.errors import TuningError
from hil.tuning.purpose import Purpose
from hil.tuning.ranges import Choice, Looked


def search(
    purpose: Purpose,
    journal: Path,
    *,
    trials: int,
    seed: int,
    tell: Callable[[FrozenTrial], None],
) -> FrozenTrial:
    """The best trial after `trials` of them, those in the journal included; raises TuningError."""
    optuna.logging.set_verbosity(optuna.logging.ERROR)
    sampler = TPESampler(seed=seed, multivariate=True)
    storage = JournalStorage(JournalFileBackend(str(journal)))
    found = optuna.create_study(
        storage=storage, study_name=purpose.name, sampler=sampler, load_if_exists=True
    )
    _same(found, purpose.text, journal)
    if not found.trials:
        found.enqueue_trial({n: r.start for n, r in purpose.ranges.items() if r.start is not None})
    left = trials - sum(trial.state is TrialState.COMPLETE for trial in found.trials)
    if left > 0:
        found.optimize(
            lambda trial: _value(purpose, trial),
            n_trials=left,
            callbacks=[lambda _, trial: tell(trial)],
        )
    return best(found.get_trials(states=(TrialState.COMPLETE,)))


def _same(found: optuna.Study, text: str, journal: Path) -> None:
    """Refuse to mix two studies in one journal."""
    before = found.user_attrs.setdefault("study", text)
    if before != text:
        raise TuningError(f"{journal}: holds trials of another study file; take a new journal")
    found.set_user_attr("study", text)


def _value(purpose: Purpose, trial: Trial) -> float:
    values = {name: _suggested(trial, name, looked) for name, looked in purpose.ranges.items()}
    found = purpose.worth(values)
    for name, violation in found.violations.items():
        trial.set_constraint(name, violation)
    return found.cost


def _suggested(trial: Trial, name: str, looked: Looked) -> bool | int | float | str:
    if isinstance(looked, Choice):
        chosen = trial.suggest_categorical(name, looked.choices)
        assert chosen is not None, "no choice is None"
        return chosen
    if looked.whole:
        return trial.suggest_int(name, int(looked.low), int(looked.high), log=looked.log)
    return trial.suggest_float(name, looked.low, looked.high, log=looked.log)


def best(trials: Sequence[FrozenTrial]) -> FrozenTrial:
    """The cheapest that keeps all constraints; where none does, the one that breaks them least."""
    if not trials:
        raise TuningError("no trial has been completed")
    return min(trials, key=lambda trial: (_excess(trial), trial.value))


def _excess(trial: FrozenTrial) -> float:
    return sum(max(0.0, violation) for violation in trial.constraints.values())
