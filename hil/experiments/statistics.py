"""Statistics of a series of runs: intervals at 95 %, unless told otherwise.

Few runs and heavy tails are the rule here, so means come as interquartile means with bootstrap
intervals, and two methods are compared run by run (Agarwal et al. 2021, "Deep reinforcement
learning at the edge of the statistical precipice").
"""

from collections.abc import Sequence
from typing import NamedTuple, Protocol

import numpy as np
from numpy.typing import NDArray
from scipy.stats import binomtest, bootstrap, mannwhitneyu, trim_mean  # type: ignore[attr-defined]

Array = NDArray[np.float64]

CONFIDENCE = 0.95
RESAMPLES = 2000


class Statistic(Protocol):
    """A figure of values along an axis, such as `numpy.mean`."""

    def __call__(self, values: Array, /, *, axis: int) -> Array: ...


class Interval(NamedTuple):
    """Ends of a confidence interval."""

    low: float
    high: float


def wilson(successes: int, runs: int, confidence: float = CONFIDENCE) -> Interval:
    """Of a success rate, by Wilson's score; ValueError unless 0 <= successes <= runs, runs > 0."""
    found = binomtest(successes, runs).proportion_ci(confidence, method="wilson")
    return Interval(float(found.low), float(found.high))


def iqm(values: Sequence[float] | Array) -> float:
    """Interquartile mean: of the middle half, so that a single outlier cannot move it."""
    return float(interquartile(_sample(values), axis=-1))


def interquartile(values: Array, /, *, axis: int) -> Array:
    """Interquartile means along an axis: a statistic for `spread`."""
    means: Array = trim_mean(values, 0.25, axis=axis)
    return means


def spread(
    values: Sequence[float] | Array,
    generator: np.random.Generator,
    statistic: Statistic = interquartile,
    confidence: float = CONFIDENCE,
) -> Interval:
    """Percentile bootstrap interval of a statistic; both ends alike for a single value."""
    sample = _sample(values)
    if np.ptp(sample) == 0:
        return Interval(float(sample[0]), float(sample[0]))
    found = bootstrap(
        (sample,),
        statistic,
        vectorized=True,
        method="percentile",
        n_resamples=RESAMPLES,
        confidence_level=confidence,
        rng=generator,
    ).confidence_interval
    return Interval(float(found.low), float(found.high))


def probability_of_improvement(
    ours: Sequence[float] | Array, theirs: Sequence[float] | Array
) -> float:
    """P(a run of ours exceeds one of theirs), ties half: Mann and Whitney's U over all pairs."""
    x, y = _sample(ours), _sample(theirs)
    return float(mannwhitneyu(x, y, method="asymptotic").statistic) / (len(x) * len(y))


def improvement(
    ours: Sequence[float] | Array,
    theirs: Sequence[float] | Array,
    generator: np.random.Generator,
    confidence: float = CONFIDENCE,
) -> Interval:
    """Percentile bootstrap interval of `probability_of_improvement`, each side drawn anew."""
    x, y = (
        generator.choice(sample, (RESAMPLES, len(sample)))
        for sample in (_sample(ours), _sample(theirs))
    )
    drawn = mannwhitneyu(x, y, axis=-1, method="asymptotic").statistic / (x.shape[1] * y.shape[1])
    tail = (1 - confidence) / 2
    low, high = np.quantile(drawn, [tail, 1 - tail])
    return Interval(float(low), float(high))


def _sample(values: Sequence[float] | Array) -> Array:
    """Finite values, at least one; ValueError otherwise, as a gap is no zero."""
    sample = np.asarray(values, float)
    if sample.ndim != 1 or not len(sample) or not np.isfinite(sample).all():
        raise ValueError(f"statistics need finite numbers, at least one; found {values!r}")
    return sample
