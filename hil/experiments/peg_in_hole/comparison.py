"""Each learner against one of them, run by run: how often it is better."""

from collections.abc import Sequence
from dataclasses import dataclass
from html import escape

from controller.outcome import Kind
from hil.cell.streams import stream
from hil.experiments.ffc.rows import Estimate, first, share, steps
from hil.experiments.ffc.runs import Training
from hil.experiments.ffc.table import shown
from hil.experiments.statistics import improvement, probability_of_improvement


@dataclass(frozen=True, slots=True)
class Comparison:
    """Probability that a run of `learner` is better than one of `reference`, ties half."""

    learner: str
    reference: str
    success: Estimate
    danger: Estimate
    training_steps: Estimate


def comparisons(trainings: Sequence[Training], reference: str) -> list[Comparison]:
    """Every other learner against `reference`; empty when that has no run to compare with."""
    names = list(dict.fromkeys(training.learner for training in trainings))
    ours = {name: _whole(trainings, name) for name in names}
    theirs = ours.get(reference, [])
    return [
        Comparison(
            name,
            reference,
            _better([share(t.episodes, Kind.INSERTED) for t in runs],
                    [share(t.episodes, Kind.INSERTED) for t in theirs]),
            _better([-share(t.episodes, Kind.DANGER) for t in runs],
                    [-share(t.episodes, Kind.DANGER) for t in theirs]),
            _better([-_training_steps(t) for t in runs], [-_training_steps(t) for t in theirs]),
        )
        for name, runs in ours.items()
        if runs and theirs and name != reference
    ]  # fmt: skip


def as_html(found: Sequence[Comparison]) -> str:
    """A heading and a table; nothing where nothing was compared."""
    if not found:
        return ""
    lines = "\n".join(
        f"<tr><td>{escape(one.learner)}</td><td>{shown(one.success)}</td>"
        f"<td>{shown(one.danger)}</td><td>{shown(one.training_steps)}</td></tr>"
        for one in found
    )
    title = f"Probability that a run is better than one of {escape(found[0].reference)}"
    head = "<td>learner</td><td>more success</td><td>fewer dangers</td><td>fewer steps</td>"
    return f"<h2>{title}</h2>\n<table><tr>{head}</tr>\n{lines}</table>"


def _whole(trainings: Sequence[Training], name: str) -> list[Training]:
    return [one for one in trainings if one.learner == name and not one.broken]


def _training_steps(training: Training) -> float:
    return sum(steps(first(training.episodes)))


def _better(ours: list[float], theirs: list[float]) -> Estimate:
    ends = improvement(ours, theirs, stream(0, "bootstrap"))
    return Estimate(probability_of_improvement(ours, theirs), ends.low, ends.high)
