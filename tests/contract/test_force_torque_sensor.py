"""What a controller may rely on with any wrist sensor: `drivers.interfaces.ForceTorqueSensor`."""

import numpy as np
import pytest

from drivers.errors import NotReadyError, StaleSampleError
from drivers.interfaces import Freshness

PATIENCE = 200
"""Control periods that booting or a tare may take."""


def until(cell, reached):
    for _ in range(PATIENCE):
        cell.step()
        cell.sensor.poll(cell.t)
        if reached():
            return
    pytest.fail(f"nothing after {PATIENCE} periods: {cell.sensor.health}")


def readings(cell, periods):
    found = []
    for _ in range(periods):
        cell.step()
        found.append(cell.sensor.read(cell.t))
    return found


@pytest.fixture
def streaming(cell):
    """Connected and started, with the first samples taken."""
    cell.sensor.connect()
    cell.sensor.start()
    until(cell, lambda: cell.sensor.ready)
    cell.step()
    cell.sensor.read(cell.t)
    return cell


def tare(cell, samples=50):
    cell.sensor.begin_tare(samples)
    assert cell.sensor.tare_pending
    until(cell, lambda: not cell.sensor.tare_pending)
    return cell


def test_nothing_is_ready_or_read_before_the_first_sample(cell):
    cell.sensor.connect()
    assert not cell.sensor.ready
    with pytest.raises(NotReadyError):
        cell.sensor.read(cell.t)


def test_a_started_sensor_becomes_ready_and_reads(streaming):
    assert streaming.sensor.ready
    assert readings(streaming, 1)[0].freshness is Freshness.OK


def test_the_wrench_is_the_newest_sample(streaming):
    for reading in readings(streaming, 10):
        assert reading.wrench == reading.samples[-1]


def test_every_sample_of_a_clean_wire_is_given_once(streaming):
    before = streaming.sensor.health
    counters = []
    found = readings(streaming, 40)
    for reading in found:
        counters += range(reading.counter - len(reading.samples) + 1, reading.counter + 1)
    assert counters == list(range(counters[0], counters[0] + len(counters)))
    after = streaming.sensor.health
    assert after.pairs - before.pairs == len(counters)
    lost = ("gaps", "torn", "malformed")
    assert [getattr(after, name) - getattr(before, name) for name in lost] == [0, 0, 0]


def test_a_second_read_in_the_same_period_holds_the_last_sample(streaming):
    (first,) = readings(streaming, 1)
    second = streaming.sensor.read(streaming.t)
    assert (second.freshness, second.samples) == (Freshness.HELD, ())
    assert (second.wrench, second.counter) == (first.wrench, first.counter)


def test_age_is_never_negative_and_grows_while_a_sample_is_held(streaming):
    (fresh,) = readings(streaming, 1)
    streaming.silence()
    held = streaming.sensor.read(streaming.t)
    assert held.freshness is Freshness.HELD
    assert 0 <= fresh.age < held.age


def test_silence_becomes_an_error_and_never_an_old_number(streaming):
    streaming.silence()
    streaming.sensor.read(streaming.t)
    for _ in range(5):
        streaming.silence()
        with pytest.raises(StaleSampleError):
            streaming.sensor.read(streaming.t)


def test_readings_return_when_the_samples_do(streaming):
    for _ in range(3):
        streaming.silence()
    assert readings(streaming, 1)[0].freshness is Freshness.OK


def test_a_tare_brings_the_mean_to_zero_and_says_so(streaming):
    tared = readings(tare(streaming, 200), 40)[5:]
    assert all(reading.tared for reading in tared)
    samples = np.array([sample for reading in tared for sample in reading.samples])
    noise = np.repeat(streaming.noise, 3)
    # Of the zero's mean and of this one, each over at least 200 samples; and one count of zero.
    bound = 4 * noise * np.sqrt(2 / 200) + np.repeat((0.015, 0.312e-3), 3)
    assert (abs(samples.mean(axis=0)) < bound).all()


def test_before_a_tare_the_tools_weight_is_felt_and_not_marked(streaming):
    if streaming.keeps_its_zero:
        pytest.skip("a sensor that was on before may hold a zero of then")
    (reading,) = readings(streaming, 1)
    assert not reading.tared
    assert max(map(abs, reading.wrench[:3])) > 1.0


def test_a_tare_is_pending_for_as_long_as_its_samples_take(streaming):
    streaming.sensor.begin_tare(80)
    for _ in range(9):
        streaming.step()
        streaming.sensor.poll(streaming.t)
    assert streaming.sensor.tare_pending


def test_close_may_come_at_any_time_and_twice(cell):
    cell.sensor.close()
    cell.sensor.connect()
    cell.sensor.close()
    cell.sensor.close()


def test_a_sensor_that_was_closed_connects_and_starts_again(streaming):
    (before,) = readings(streaming, 1)
    streaming.sensor.close()
    streaming.step()
    streaming.sensor.connect()
    streaming.sensor.start()
    until(streaming, lambda: streaming.sensor.ready)
    (after,) = readings(streaming, 1)
    assert after.freshness is Freshness.OK
    assert after.counter > before.counter


def test_a_connected_sensor_says_that_its_receiver_lives(streaming):
    assert streaming.sensor.health.receiver_alive
