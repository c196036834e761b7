"""A row a learner: rates, steps and how fast it learnt, each with its 95 % interval over seeds."""

from collections.abc import Sequence
from dataclasses import dataclass
from math import nan

import numpy as np

from controller.outcome import Kind
from hil.app.train import EpisodeResult
from hil.cell.streams import stream
from hil.experiments.ffc.runs import Training
from hil.experiments.statistics import Statistic, interquartile, spread

QUICK = 20
"""Steps within which the paper's learner ends "after 15 episodes"."""
IN_A_ROW = 5


@dataclass(frozen=True, slots=True)
class Estimate:
    """A figure with the ends of its interval; NaN when no run had one."""

    value: float
    low: float
    high: float


@dataclass(frozen=True, slots=True)
class Row:
    """One learner over its seeds. success, danger, step_limit: shares of all episodes.

    training_steps: search steps of the first part's episodes. episodes_to_20_steps: episode from
    which five in a row took no more; the number of episodes plus one where none did. ffc2_first:
    steps of the first episode with the second part. broken: runs that never came back.
    """

    learner: str
    seeds: int
    broken: int
    success: Estimate
    danger: Estimate
    step_limit: Estimate
    training_steps: Estimate
    episodes_to_20_steps: Estimate
    late_steps: Estimate
    ffc2_first_steps_mean: Estimate
    ffc2_first_steps_iqm: Estimate


def rows(trainings: Sequence[Training]) -> list[Row]:
    """In the order in which the learners first appear."""
    names = list(dict.fromkeys(training.learner for training in trainings))
    return [_row(name, [one for one in trainings if one.learner == name]) for name in names]


def _row(name: str, trainings: list[Training]) -> Row:
    whole = [training.episodes for training in trainings if not training.broken]
    return Row(
        learner=name,
        seeds=len(whole),
        broken=len(trainings) - len(whole),
        success=_estimate([share(e, Kind.INSERTED) for e in whole], np.mean),
        danger=_estimate([share(e, Kind.DANGER) for e in whole], np.mean),
        step_limit=_estimate([share(e, Kind.LIMIT) for e in whole], np.mean),
        training_steps=_estimate([float(sum(steps(first(e)))) for e in whole], np.mean),
        episodes_to_20_steps=_estimate([float(quick_from(first(e))) for e in whole], np.mean),
        late_steps=_estimate([_late(first(e)) for e in whole], np.mean),
        ffc2_first_steps_mean=_estimate(_second(whole), np.mean),
        ffc2_first_steps_iqm=_estimate(_second(whole), interquartile),
    )


def share(episodes: Sequence[EpisodeResult], kind: Kind) -> float:
    """Share of the episodes that ended so."""
    return sum(episode.kind is kind for episode in episodes) / len(episodes)


def first(episodes: Sequence[EpisodeResult]) -> list[EpisodeResult]:
    """Those with the part that was trained with."""
    return [episode for episode in episodes if episode.part == episodes[0].part]


def steps(episodes: Sequence[EpisodeResult]) -> list[float]:
    return [float(episode.steps) for episode in episodes]


def quick_from(episodes: Sequence[EpisodeResult]) -> int:
    """Episode from which five in a row were inserted within 20 steps; one past the end if never."""
    good = [e.kind is Kind.INSERTED and e.steps <= QUICK for e in episodes]
    for begin in range(len(good) - IN_A_ROW + 1):
        if all(good[begin : begin + IN_A_ROW]):
            return begin + 1
    return len(good) + 1


def _late(episodes: Sequence[EpisodeResult]) -> float:
    """Mean steps from the 31st episode on; NaN for a shorter training."""
    late = steps(episodes)[30:]
    return float(np.mean(late)) if late else nan


def _second(whole: Sequence[Sequence[EpisodeResult]]) -> list[float]:
    """Steps of each run's first episode with another part than the first."""
    found = []
    for episodes in whole:
        others = [e for e in episodes if e.part != episodes[0].part]
        found += steps(others[:1])
    return found


def _estimate(values: Sequence[float], statistic: Statistic) -> Estimate:
    finite = np.array([value for value in values if not np.isnan(value)])
    if not len(finite):
        return Estimate(nan, nan, nan)
    ends = spread(finite, stream(0, "bootstrap"), statistic)
    return Estimate(float(statistic(finite, axis=0)), ends.low, ends.high)
