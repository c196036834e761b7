"""The campaign: so many loops of each family, one line of a table each."""

from collections.abc import Iterator, Sequence
from typing import NamedTuple

import numpy as np

from hil.experiments.envelope.families import FAMILIES, Family
from hil.experiments.envelope.verdict import Verdict, verdict


class Spread(NamedTuple):
    """Median, 95th percentile and most of a family's loops."""

    median: float
    p95: float
    most: float


class FamilyResult(NamedTuple):
    """overshoot: %. settling: s. rms_still: N. peaks: the worst loop's, over f_d and the bound.

    over_bound: loops whose peak passed the bound. lost: loops that lost contact while still.
    """

    family: str
    loops: int
    unstable: int
    overshoot: Spread
    settling: Spread
    rms_still: Spread
    peak_over_force: float
    peak_over_bound: float
    over_bound: int
    lost: int


def select(names: Sequence[str]) -> tuple[Family, ...]:
    """Families by name, all of them for none; ValueError for a name there is not."""
    known = {family.name: family for family in FAMILIES}
    for name in names:
        if name not in known:
            raise ValueError(f"no family is called {name!r}; there are: {'; '.join(known)}")
    return tuple(known[name] for name in names) or FAMILIES


def envelope(loops: int, seed: int, families: Sequence[Family]) -> Iterator[FamilyResult]:
    """Each loop draws from its own stream of the seed, so that any one can be repeated alone."""
    for family in families:
        streams = np.random.default_rng(seed).spawn(loops)
        yield summary(family, [verdict(family, rng) for rng in streams])


def summary(family: Family, verdicts: Sequence[Verdict]) -> FamilyResult:
    over = [v.peak_over_bound for v in verdicts]
    return FamilyResult(
        family.name,
        len(verdicts),
        sum(v.unstable for v in verdicts),
        _spread([v.overshoot for v in verdicts]),
        _spread([v.settling for v in verdicts]),
        _spread([v.rms_still for v in verdicts]),
        max(v.peak_over_force for v in verdicts),
        max(over),
        sum(ratio > 1.0 for ratio in over),
        sum(v.lost > 0 for v in verdicts),
    )


def _spread(values: list[float]) -> Spread:
    median, p95 = np.percentile(values, [50.0, 95.0])
    return Spread(float(median), float(p95), max(values))
