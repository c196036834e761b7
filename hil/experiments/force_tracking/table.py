"""From runs to the experiment's table: one row a series, with spread and confidence."""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from hil.experiments import statistics
from hil.experiments.force_tracking.run import Row
from hil.experiments.force_tracking.variant import Variant


@dataclass(frozen=True, slots=True)
class Spread:
    """Mean and standard deviation over the stable runs, and the 95 % bootstrap interval of the
    mean.
    """

    mean: float
    sd: float
    low: float
    high: float


@dataclass(frozen=True, slots=True)
class Series:
    """One row. k_e: N/mm. failed: runs that a device or the cell ended. overshoot_p95: % of f_d.

    settling_s, rms_static, rms_tracking: means over the stable runs, s and N; None where there is
    none. peak: the largest of all runs, N, unstable ones too.
    """

    law: str
    k_e: float
    latency_ms: float
    rate_hz: int
    runs: int
    unstable: int
    failed: int
    overshoot_p95: float | None
    settling_s: float | None
    rms_static: float | None
    rms_tracking: float | None
    peak: float | None
    spread: dict[str, Spread | None]
    endings: tuple[str, ...]


FIGURES = ("overshoot", "settling", "rms_static", "rms_tracking", "peak")


def series(variant: Variant, rate: int, runs: Sequence[Row]) -> Series:
    """The table's row for one series of runs."""
    made = [row for row in runs if not row.get("failed")]
    stable = [row for row in made if not row["unstable"]]
    spread = {name: spread_of(_values(stable, name)) for name in FIGURES}
    overshoots, peaks = _values(stable, "overshoot"), _values(runs, "peak")
    return Series(
        law=variant.law,
        k_e=variant.stiffness / 1e3,
        latency_ms=variant.latency * 1e3,
        rate_hz=rate,
        runs=len(runs),
        unstable=len(made) - len(stable),
        failed=len(runs) - len(made),
        overshoot_p95=100 * float(np.quantile(overshoots, 0.95)) if overshoots else None,
        settling_s=_mean(spread["settling"]),
        rms_static=_mean(spread["rms_static"]),
        rms_tracking=_mean(spread["rms_tracking"]),
        peak=max(peaks, default=None),
        spread=spread,
        endings=tuple(sorted({str(row["ending"]) for row in runs if row not in stable})),
    )


def spread_of(values: Sequence[float]) -> Spread | None:
    """None without values; one value has no interval but itself."""
    if not values:
        return None
    sample = np.array(values)
    mean, sd = float(sample.mean()), float(sample.std(ddof=1)) if len(sample) > 1 else 0.0
    if sd == 0.0:
        return Spread(mean, sd, mean, mean)
    low, high = statistics.spread(values, np.random.default_rng(0), np.mean)
    return Spread(mean, sd, low, high)


def _mean(spread: Spread | None) -> float | None:
    return None if spread is None else spread.mean


def _values(runs: Sequence[Row], name: str) -> list[float]:
    values = (row.get(name) for row in runs)
    return [value for value in values if isinstance(value, float)]


def ratio(rows: Sequence[Series], worse: str, better: str, name: str) -> float | None:
    """Geometric mean over the grid of one law's figure over another's, where both are stable."""
    of = {(row.law, row.k_e, row.latency_ms, row.rate_hz): row for row in rows}
    logs = []
    for key, row in of.items():
        other = of.get((better, *key[1:]))
        if row.law != worse or other is None or row.unstable or other.unstable:
            continue
        above, below = getattr(row, name), getattr(other, name)
        if above and below:
            logs.append(np.log(above / below))
    return float(np.exp(np.mean(logs))) if logs else None


def as_text(rows: Sequence[Series]) -> str:
    """The table for people."""
    head = (
        "law        k_e N/mm  latency ms  rate Hz  unstable  overshoot p95 %  settling s"
        "  static N  tracking N   peak N\n"
    )
    return head + "".join(
        f"{row.law[-9:]:9} {row.k_e:9g} {row.latency_ms:11g} {row.rate_hz:8d}"
        f" {row.unstable:5d}/{row.runs:<3d} {_cell(row.overshoot_p95, 1):>16}"
        f" {_cell(row.settling_s, 2):>11} {_cell(row.rms_static, 3):>9}"
        f" {_cell(row.rms_tracking, 3):>11} {_cell(row.peak, 1):>8}\n"
        for row in rows
    )


def _cell(value: float | None, digits: int) -> str:
    return "-" if value is None else f"{value:.{digits}f}"
