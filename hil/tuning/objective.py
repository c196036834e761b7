"""What a set of parameters is worth: figures over the grid, made without a wire."""

from math import log

from controller.laws.build import settings_of
from hil.cell.rig import Rig
from hil.experiments.force_tracking.direct import direct
from hil.experiments.force_tracking.figures import Figures
from hil.experiments.force_tracking.variant import Variant
from hil.tuning.errors import TuningError
from hil.tuning.purpose import Purpose, Values, Worth
from hil.tuning.study_file import StudyFile, nested

UNSTABLE = 10.0
"""Cost of an unstable run: worse than any figure a stable one has."""


def purpose(study: StudyFile, rig: Rig) -> Purpose:
    """The search for this law's parameters on a rig."""

    def of(values: Values) -> Worth:
        return worth(study, rig, {name: _number(value) for name, value in values.items()})

    return Purpose(study.law, study.model_dump_json(), study.parameters, of)


def _number(value: bool | float | str) -> float | bool:
    assert not isinstance(value, str), "a law's parameters are looked for in ranges of numbers"
    return value


def worth(study: StudyFile, rig: Rig, values: dict[str, float | bool]) -> Worth:
    """Run the grid with these parameters; TuningError when the law does not take them."""
    runs = [direct(rig, seed, variant) for variant in variants(study, values)
            for seed in study.seeds]  # fmt: skip
    cost = sum(_cost(study, figures) for figures in runs) / len(runs)
    violations = {str(n): _violation(runs, n, most) for n, most in study.constraints.items()}
    return Worth(cost, violations)


def variants(study: StudyFile, values: dict[str, float | bool]) -> list[Variant]:
    """The grid's series with these parameters."""
    parameters = nested({**study.fixed, **values})
    try:
        settings_of(study.law, parameters)  # type: ignore[arg-type]  # judged right here
    except (ValueError, TypeError) as error:
        raise TuningError(f"law {study.law}: {error}") from None
    return [
        Variant(
            law=study.law,
            parameters=parameters,  # type: ignore[arg-type]
            stiffness=stiffness * 1e3,
            latency=latency * 1e-3,
            force=study.force,
            approach=study.approach * 1e-3,
            push=study.push * 1e-3,
        )
        for stiffness in study.stiffnesses
        for latency in study.latencies
    ]


def _cost(study: StudyFile, figures: Figures) -> float:
    if figures.unstable:
        return UNSTABLE
    cost = 0.0
    for name, weight in study.objective.items():
        value = getattr(figures, name)
        if value is None:
            return UNSTABLE
        cost += weight * log(max(value, study.floor.get(name, 1e-6)))
    return cost


def _violation(runs: list[Figures], name: str, most: float) -> float:
    if name == "unstable":
        return sum(figures.unstable for figures in runs) - most
    values = [getattr(figures, name) for figures in runs]
    return max((value - most for value in values if value is not None), default=1.0)
