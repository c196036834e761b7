"""Laws of the transducer: what each error term does, alone and in order."""

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from hil.cell.rig.sensor import Errors, Sensor
from hil.cell.sensor.hysteresis import Hysteresis
from hil.cell.sensor.lowpass import LowPass
from hil.cell.sensor.transducer import DAMAGED, SATURATED, Transducer

RESOLUTION = np.array([0.015] * 3 + [0.312e-3] * 3)
QUIET = Sensor(preset="nrs-6050-d80-quiet")


def only(**terms):
    """A sensor with the named error terms and no others."""
    zero = dict.fromkeys(set(Errors.model_fields) - {"warm_up_time"}, 0.0)
    return Sensor().model_copy(update={"errors": Errors().model_copy(update=zero | terms)})


def measure(sensor, wrenches, t=10**9, seed=0):
    return Transducer(sensor, np.random.default_rng(seed)).measure(t, np.asarray(wrenches, float))


@given(
    st.lists(st.floats(-490, 490), min_size=3, max_size=3),
    st.lists(st.floats(-9.9, 9.9), min_size=3, max_size=3),
)
def test_the_quiet_preset_only_quantises(force, torque):
    wrench = np.array(force + torque)
    counts = measure(QUIET, [wrench])
    assert np.all(np.abs(counts.values[0] * RESOLUTION - wrench) <= RESOLUTION / 2 + 1e-9)
    assert counts.alarms is None


def test_white_noise_has_the_preset_sigma():
    values = measure(only(noise_force=0.05, noise_torque=0.0008), np.zeros((20_000, 6))).values
    sigma = (values * RESOLUTION).std(axis=0)
    expected = np.sqrt(np.array([0.05] * 3 + [0.0008] * 3) ** 2 + RESOLUTION**2 / 12)
    assert sigma == pytest.approx(expected, rel=0.03)


def test_the_walk_spreads_as_the_square_root_of_time():
    ends = [
        measure(only(walk_force=0.1), np.zeros((1000, 6)), seed=seed).values[-1, :3] * 0.015
        for seed in range(300)
    ]
    assert np.std(ends) == pytest.approx(0.1, rel=0.1)


def test_warm_up_ends_where_it_was_drawn_to_and_is_at_63_percent_after_its_time():
    sensor = only(warm_up_force=50.0)
    early, at_tau, late = (
        measure(sensor, [[0.0] * 6], t=round(seconds * 1e9)).values[0, :3] * 0.015
        for seconds in (0.0, 900.0, 90_000.0)
    )
    assert early == pytest.approx(0.0)
    assert at_tau == pytest.approx(late * (1 - math.exp(-1)), abs=0.03)
    assert np.abs(late).max() > 1.0


def test_crosstalk_is_a_fixed_linear_map_in_fractions_of_full_scale():
    sensor = only(crosstalk=0.01)
    one = measure(sensor, [[0, 0, 100.0, 0, 0, 0]]).values[0] * RESOLUTION
    two = measure(sensor, [[0, 0, 200.0, 0, 0, 0]]).values[0] * RESOLUTION
    assert two == pytest.approx(2 * one, abs=0.03)
    assert one[2] == pytest.approx(100.0, abs=0.01)
    fractions = np.delete(one / ([500.0] * 3 + [10.0] * 3), 2) / (100 / 500)
    assert 0.001 < np.abs(fractions).max() < 0.04


def test_hysteresis_separates_the_branches_by_its_width_times_the_peak():
    way = np.concatenate([np.linspace(0, 100, 101), np.linspace(100, -100, 201),
                          np.linspace(-100, 100, 201)])  # fmt: skip
    loads = np.zeros((len(way), 6))
    loads[:, 0] = way
    readings = Hysteresis(0.01).follow(loads)[:, 0]
    down, up = readings[201], readings[402]
    assert way[201] == way[402] == 0.0
    assert down - up == pytest.approx(0.01 * 100)


def test_hysteresis_of_a_block_equals_that_of_its_rows_once_the_peak_is_known():
    rng = np.random.default_rng(1)
    loads = np.vstack([np.full((1, 6), 50.0), rng.uniform(-50, 50, (200, 6))])
    block, rows = Hysteresis(0.02), Hysteresis(0.02)
    assert np.allclose(block.follow(loads), np.vstack([rows.follow(row[None]) for row in loads]))


def test_the_low_pass_settles_on_a_step_with_its_time_constant():
    low_pass = LowPass(cutoff=50.0, rate=1000.0)
    low_pass.filter(np.zeros((1, 6)))
    step = low_pass.filter(np.ones((100, 6)))[:, 0]
    n = np.arange(1, 101)
    assert step == pytest.approx(1 - np.exp(-2 * np.pi * 50 / 1000 * n))


def test_a_low_pass_lowers_white_noise_as_a_one_pole_does():
    sensor = only(noise_force=0.5).model_copy(update={"filter_cutoff": 10.0})
    values = measure(sensor, np.zeros((50_000, 6))).values[1000:, :3] * 0.015
    a = 1 - math.exp(-2 * math.pi * 10 / 1000)
    assert values.std() == pytest.approx(0.5 * math.sqrt(a / (2 - a)), rel=0.05)


@pytest.mark.parametrize(
    ("force", "alarm"), [(499.9, 0), (500.1, 4), (599.9, 4), (601.0, 4 | SATURATED),
                         (1501.0, 4 | SATURATED | DAMAGED)],
)  # fmt: skip
def test_range_ceiling_and_damage_raise_their_alarms(force, alarm):
    counts = measure(QUIET, [[0, 0, -force, 0, 0, 0]])
    assert (counts.alarms is None and alarm == 0) or counts.alarms.tolist() == [alarm]
    assert counts.values[0, 2] * 0.015 == pytest.approx(-min(force, 600.0), abs=0.0076)


def test_the_same_seed_gives_the_same_counts():
    wrenches = np.random.default_rng(5).normal(0, 5, (64, 6))
    one, two, other = (measure(Sensor(), wrenches, seed=seed).values for seed in (1, 1, 2))
    assert np.array_equal(one, two)
    assert not np.array_equal(one, other)


def test_a_shifted_bias_moves_every_later_sample():
    transducer = Transducer(QUIET, np.random.default_rng(0))
    transducer.shift_bias(np.array([1.5, 0, 0, 0, 0, 0]))
    assert transducer.measure(0, np.zeros((2, 6))).values[:, 0].tolist() == [100, 100]
