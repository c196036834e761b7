"""The noise experiment: its estimators against an outside one, its sensor against the preset."""

from dataclasses import replace

import allantools
import numpy as np
import pytest

from hil.cell.rig import LatencyLaw, parse
from hil.experiments.allan import allan_deviation
from hil.experiments.noise import rows, run
from hil.experiments.noise_figure import figure
from hil.experiments.noise_report import measure


@pytest.fixture(scope="module")
def rig():
    return parse("name: bench")


@pytest.fixture(scope="module")
def report(rig):
    return measure(rig, seed=3, seconds=20.0)


@pytest.mark.parametrize("tau", [0.001, 0.01, 0.5])
def test_the_allan_deviation_agrees_with_allantools(tau):
    samples = np.cumsum(np.random.default_rng(1).normal(size=5000)) * 0.01
    _, (expected,), _, _ = allantools.oadev(samples, rate=1000, data_type="freq", taus=[tau])
    assert allan_deviation(samples, 1000, tau) == pytest.approx(expected, rel=1e-9)


def test_too_short_a_record_is_the_callers_error():
    with pytest.raises(ValueError, match="too few"):
        allan_deviation(np.zeros(100), 1000, 1.0)


@pytest.mark.parametrize("axis", range(6))
def test_the_sensor_is_as_noisy_as_its_preset_says(report, axis):
    noise = report.axes[axis]
    assert noise.sigma.ratio == pytest.approx(1.0, abs=0.02)
    assert noise.psd.ratio == pytest.approx(1.0, abs=0.03)
    assert noise.step.ratio == pytest.approx(1.0)
    # 20 s hold 2000 independent means of 10 ms and 200 of 0.1 s.
    assert noise.allan[0].ratio == pytest.approx(1.0, abs=0.06)
    assert noise.allan[1].ratio == pytest.approx(1.0, abs=0.2)


def test_delays_follow_the_law_of_the_rig(rig):
    law = LatencyLaw.model_validate({"law": "gamma", "mean": "1 ms", "jitter": "0.3 ms"})
    can = rig.latency.can.model_copy(update={"from_cell": law})
    rig = rig.model_copy(update={"latency": rig.latency.model_copy(update={"can": can})})
    delay = measure(rig, seed=1, seconds=1.0).delay
    assert delay.mean.ratio == pytest.approx(1.0, abs=0.01)
    assert delay.jitter.ratio == pytest.approx(1.0, abs=0.03)


def test_the_same_seed_gives_the_same_report(rig):
    one, two = (measure(rig, seed=5, seconds=1.0) for _ in range(2))
    assert np.array_equal(one.record, two.record)
    assert one.axes == two.axes


def test_the_figure_is_a_png(report, tmp_path):
    path = tmp_path / "noise.png"
    figure(report, path)
    assert path.read_bytes().startswith(b"\x89PNG")


def test_every_row_of_the_table_passes_for_the_preset(rig):
    rows = run(rig, seed=2, seconds=10.0)
    assert [row for row in rows if not row.passed] == []
    assert len(rows) == 6 * (3 + 2) + 2


def test_a_sensor_that_is_noisier_than_its_preset_fails_its_rows(report):
    loud = replace(report, axes=tuple(louder(axis, 1.1) for axis in report.axes))
    failed = {row.what for row in rows(loud) if not row.passed}
    assert {"white noise, fz", "spectrum, fz", "Allan deviation at 0.01 s, fz"} <= failed


def louder(axis, factor):
    def up(one):
        return replace(one, value=one.value * factor)

    return replace(
        axis, sigma=up(axis.sigma), psd=up(axis.psd), allan=tuple(up(one) for one in axis.allan)
    )


def test_a_quiet_sensor_at_rest_shows_no_noise_at_all():
    quiet = parse("name: bench\nsensor: {preset: nrs-6050-d80-quiet}")
    assert all(row.passed for row in run(quiet, seed=1, seconds=2.0))
