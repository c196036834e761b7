"""Is the emulated sensor as noisy as its preset says? The table of `hil experiment noise`."""

import math
from collections.abc import Iterator

from hil.cell.rig import Rig
from hil.experiments.noise_report import AXES, TAUS, AxisNoise, NoiseReport, measure
from hil.experiments.row import Row, within

TARGET = "sensor"


def run(rig: Rig, seed: int, seconds: float = 200.0) -> list[Row]:
    """Every row; seconds of bench time, 200 take about five of wall time."""
    return rows(measure(rig, seed, seconds))


def rows(report: NoiseReport) -> list[Row]:
    """Each figure beside the preset's, in N, N·m and s."""
    delay = report.delay
    return [
        *(row for name, axis in zip(AXES, report.axes, strict=True)
          for row in _axis(name, axis, report.seconds)),
        within("latency", "mean CAN delay, s", delay.mean.value, delay.mean.expected, 0.02),
        within("latency", "CAN jitter, s", delay.jitter.value, delay.jitter.expected, 0.05),
    ]  # fmt: skip


def _axis(name: str, axis: AxisNoise, seconds: float) -> Iterator[Row]:
    yield within(TARGET, f"white noise, {name}", axis.sigma.value, axis.sigma.expected, 0.02)
    yield within(TARGET, f"spectrum, {name}", axis.psd.value, axis.psd.expected, 0.04)
    if math.isfinite(axis.step.value):
        yield within(TARGET, f"resolution, {name}", axis.step.value, axis.step.expected, 1e-6)
    for tau, allan in zip(TAUS, axis.allan, strict=False):
        # So many independent means bound how well the deviation can be known.
        tolerance = 3.5 / math.sqrt(seconds / tau)
        what = f"Allan deviation at {tau:g} s, {name}"
        yield within(TARGET, what, allan.value, allan.expected, tolerance)
