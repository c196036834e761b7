"""Faults of transducer and node, seen in the frames that leave it."""

import numpy as np
import pytest

from drivers.protocol.nrs_can import FAULT, OVERLOAD, SATURATED, VALID, Identifiers
from drivers.protocol.nrs_status import NodeState

IDS = Identifiers.of(1)


def test_a_bias_moves_one_axis(faulty, sound, wrenches):
    off = wrenches(faulty("S1", params={"force": "3 N"}).run(2)) - wrenches(sound().run(2))
    assert off[:, 2] == pytest.approx(3.0, abs=0.01)
    assert not off[:, [0, 1, 3, 4, 5]].any()


def test_a_drift_grows_with_time(faulty, sound, wrenches):
    drifting = faulty("S1", params={"force": "0 N", "drift": "10 N/s", "axis": "fx"})
    off = wrenches(drifting.run(50)) - wrenches(sound().run(50))
    assert off[-1, 0] == pytest.approx(4.0, abs=0.1)
    assert np.all(np.diff(off[:, 0]) >= 0.0)


def test_noise_has_the_deviation_that_was_asked_for(faulty, sound, wrenches):
    noisy = faulty("S2", params={"force": "2 N", "torque": "0.1 N*m"})
    off = wrenches(noisy.run(100)) - wrenches(sound().run(100))
    assert off[:, :3].std() == pytest.approx(2.0, rel=0.1)
    assert off[:, 3:].std() == pytest.approx(0.1, rel=0.1)


def test_spikes_come_at_their_rate(faulty, sound, wrenches):
    params = {"force": "0 N", "torque": "0 N*m", "spike": "50 N", "spike_rate": "100 Hz"}
    off = wrenches(faulty("S2", params=params).run(100)) - wrenches(sound().run(100))
    assert set(np.round(off[:, 0])) == {0.0, 50.0}
    assert 40 <= (off[:, 0] > 1.0).sum() <= 130


def test_a_stuck_value_repeats_while_the_counter_runs(faulty, read):
    found = read(faulty("S3").run(5))
    assert len({sample.wrench for sample in found}) == 1
    assert len({sample.counter for sample in found}) == len(found)


def test_a_clipped_value_is_flagged(faulty, read):
    found = read(faulty("S4", params={"force": "4 N"}).run(2))
    assert all(sample.flags & SATURATED for sample in found)
    assert max(abs(force) for sample in found for force in sample.wrench[:3]) <= 4.01


@pytest.mark.parametrize(
    ("params", "expected"),
    [
        ({"what": "sign"}, lambda w: -w),
        ({"what": "scale", "scale": 0.5}, lambda w: 0.5 * w),
        ({"what": "swap"}, lambda w: w[:, [1, 0, 2, 4, 3, 5]]),
    ],
)
def test_a_wrong_configuration_turns_the_axes(faulty, sound, wrenches, params, expected):
    plain = wrenches(sound().run(2))
    assert wrenches(faulty("S5", params=params).run(2)) == pytest.approx(expected(plain), abs=0.02)


@pytest.mark.parametrize(("bit", "flag"), [("overload", OVERLOAD), ("supply", FAULT)])
def test_status_bits_travel_with_every_sample(faulty, read, bit, flag):
    found = read(faulty("S6", params={"bit": bit}).run(2))
    assert all(sample.flags & flag for sample in found)
    assert all(bool(sample.flags & VALID) is (bit == "overload") for sample in found)


def test_a_node_that_restarts_says_so_and_is_silent(faulty, read):
    bench = faulty("S6", params={"bit": "watchdog"})
    found = bench.run(2)
    assert [frame.data[0] for _, frame in found if frame.id == IDS.heartbeat] == [NodeState.BOOT]
    assert read(found) == []
    assert bench.stages("S6") == ["armed", "active", "cleared"]


@pytest.mark.parametrize("kind", ["S1", "S2", "S3", "S4", "S5", "S6"])
def test_every_fault_of_the_sensor_is_felt_in_the_period_in_which_it_begins(faulty, kind):
    bench = faulty(kind)
    bench.run(1)
    assert bench.stages(kind)[:2] == ["armed", "active"]
