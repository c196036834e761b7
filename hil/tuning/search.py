"""The search itself: Optuna's TPE on a journal file, so that a stopped one goes on."""

from collections.abc import Callable, Sequence
from pathlib import Path

import optuna
from optuna.samplers import TPESampler
from optuna.storages import JournalStorage
from optuna.storages.journal import JournalFileBackend
from optuna.trial import FrozenTrial, Trial, TrialState

from hil.cell.rig import Rig
from hil.tuning.errors import TuningError
from hil.tuning.objective import worth
from hil.tuning.study_file import StudyFile


def search(
    study: StudyFile,
    rig: Rig,
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
        storage=storage, study_name=study.law, sampler=sampler, load_if_exists=True
    )
    _same(found, study, journal)
    if not found.trials:
        found.enqueue_trial(
            {n: r.start for n, r in study.parameters.items() if r.start is not None}
        )
    left = trials - sum(trial.state is TrialState.COMPLETE for trial in found.trials)
    if left > 0:
        found.optimize(
            lambda trial: _value(study, rig, trial),
            n_trials=left,
            callbacks=[lambda _, trial: tell(trial)],
        )
    return best(found.get_trials(states=(TrialState.COMPLETE,)))


def _same(found: optuna.Study, study: StudyFile, journal: Path) -> None:
    """Refuse to mix two studies in one journal."""
    text = study.model_dump_json()
    before = found.user_attrs.setdefault("study", text)
    if before != text:
        raise TuningError(f"{journal}: holds trials of another study file; take a new journal")
    found.set_user_attr("study", text)


def _value(study: StudyFile, rig: Rig, trial: Trial) -> float:
    values: dict[str, float | bool] = {
        name: trial.suggest_float(name, r.low, r.high, log=r.log)
        for name, r in study.parameters.items()
    }
    found = worth(study, rig, values)
    for name, violation in found.violations.items():
        trial.set_constraint(name, violation)
    return found.cost


def best(trials: Sequence[FrozenTrial]) -> FrozenTrial:
    """The cheapest that keeps all constraints; where none does, the one that breaks them least."""
    if not trials:
        raise TuningError("no trial has been completed")
    return min(trials, key=lambda trial: (_excess(trial), trial.value))


def _excess(trial: FrozenTrial) -> float:
    return sum(max(0.0, violation) for violation in trial.constraints.values())
