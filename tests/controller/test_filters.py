import pytest

from controller.filters import MovingMean
from drivers.interfaces import Freshness, WrenchReading


def reading(*fz):
    samples = tuple((0.0, 0.0, f, 0.0, 0.0, 0.0) for f in fz)
    wrench = samples[-1] if samples else (0.0, 0.0, 9.0, 0.0, 0.0, 0.0)
    freshness = Freshness.OK if samples else Freshness.HELD
    return WrenchReading(wrench, samples, len(samples), 0, freshness, True)


def test_the_mean_spans_8_ms_however_the_samples_are_cut_into_periods():
    samples = [0.5, 1.5, -2.0, 4.0, 3.0, 7.0, 1.0, 2.0, 6.0, 5.0, 0.0, 1.0]
    at_125, at_500 = MovingMean(1000.0), MovingMean(1000.0)
    once = at_125(reading(*samples))
    for start in range(0, len(samples), 2):
        often = at_500(reading(*samples[start : start + 2]))
    assert once == often
    assert once[2] == pytest.approx(sum(samples[-8:]) / 8)


def test_a_held_reading_leaves_the_mean_as_it_is():
    mean = MovingMean(1000.0)
    before = mean(reading(1.0, 2.0, 3.0))
    assert mean(reading()) == before


def test_a_non_finite_sample_is_forgotten_once_it_left_the_window():
    mean = MovingMean(1000.0)
    mean(reading(float("nan")))
    assert mean(reading(*[2.0] * 8))[2] == 2.0


def test_a_sensor_slower_than_the_window_is_refused():
    with pytest.raises(ValueError, match="holds no sample"):
        MovingMean(10.0)
