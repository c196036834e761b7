from itertools import pairwise

import numpy as np
import pytest

from drivers.protocol.nrs_can import Identifiers
from hil.cell.bench import G

PLANTS = ("wall", "analytic")
PERIOD = 8_000_000
MS = 1_000_000
IDS = Identifiers.of(1)


@pytest.fixture(params=PLANTS)
def plant(request):
    return request.param


def test_a_tick_is_one_control_period(make_bench, plant):
    hand = make_bench(plant=plant).run(3)
    assert hand.bench.t == 3 * hand.bench.period == 3 * PERIOD
    assert hand.bench.truth.wrenches.shape == (8, 6)
    assert [values["timestamp"] for values in hand.values] == [0.008, 0.016, 0.024]


def test_one_seed_gives_the_same_frames_and_variables(make_bench, plant):
    one, same = (make_bench(seed=3, plant=plant).gripped() for _ in range(2))
    assert one.frames == same.frames
    assert one.values == same.values


def test_another_seed_gives_other_frames(make_bench):
    assert make_bench(seed=3).streaming().frames != make_bench(seed=4).streaming().frames


def test_frames_arrive_in_order_and_in_the_period_that_takes_them(make_bench):
    hand = make_bench().streaming(0)
    hand.frames.clear()
    for _ in range(20):
        before = hand.bench.t
        hand.run(1)
        arrivals = [arrival for arrival, _ in hand.frames]
        assert all(before < arrival <= hand.bench.t for arrival in arrivals)
        assert all(a <= b for a, b in pairwise(arrivals))
        hand.frames.clear()


def test_the_links_delay_is_added_to_every_frame_and_to_nothing_else(make_bench):
    at_once = make_bench(from_cell="{mean: 0 ms}").streaming().frames
    delayed = make_bench(from_cell="{mean: 3 ms}").streaming().frames
    assert len(at_once) > len(delayed) > 100
    expected = [(arrival + 3 * MS, frame) for arrival, frame in at_once[: len(delayed)]]
    assert delayed == expected


def test_a_delay_beyond_a_period_keeps_frames_back_for_later_ones(make_bench):
    hand = make_bench(from_cell="{mean: 20 ms}").run(2)
    assert hand.frames == []
    hand.run(2)
    assert hand.frames[0][1].id == IDS.heartbeat
    assert hand.frames[0][0] >= 20 * MS


def test_a_command_reaches_the_node_after_its_delay_and_not_before(make_bench):
    hand = make_bench(from_cell="{mean: 0 ms}").run(5)
    sent = hand.bench.t
    hand.streaming()
    reply = next(arrival for arrival, frame in hand.frames if frame.id == IDS.reply)
    assert reply >= sent + 1 * MS
    assert all(arrival > sent + 1 * MS for arrival, frame in hand.frames if frame.id == IDS.force)


def test_eight_pairs_come_with_every_period(make_bench):
    hand = make_bench().streaming()
    hand.frames.clear()
    hand.run(50)
    counts = [sum(f.id == wanted for _, f in hand.frames) for wanted in (IDS.force, IDS.torque)]
    # The node's clock is its own: 400 conversions, give or take one.
    assert all(abs(count - 400) <= 1 for count in counts)


def test_a_standing_arm_feels_no_force_because_its_payload_is_known(make_bench, plant):
    hand = make_bench(plant=plant).run(10)
    assert hand.bench.truth.wrenches[-1][2] == pytest.approx(0.6 * G, abs=1e-6)
    assert hand.bench.arm.box.measured.force == pytest.approx((0,) * 6, abs=1e-6)


def test_the_arm_reports_where_the_plant_put_it(make_bench, plant):
    hand = make_bench(plant=plant, repeatability="0 m").run(10)
    bench = hand.bench
    flange = bench.arm.box.measured.flange
    assert bench._geometry.stage(flange) == pytest.approx(bench.truth.stage, abs=1e-9)


def test_closing_jaws_at_a_waiting_part_is_felt_by_the_grip_sensor_alone(make_bench, plant):
    hand = make_bench(plant=plant).gripped()
    assert hand.bench.truth.part.name == "FFC1"
    assert hand.values[-1]["actual_digital_input_bits"] & 1
    assert not hand.values[15]["actual_digital_input_bits"] & 1


def test_jaws_hold_what_they_hold_until_the_output_falls(make_bench, plant):
    hand = make_bench(plant=plant).gripped()
    hand.output(0)
    hand.run(30)
    assert hand.bench.truth.part.name is None
    assert not hand.values[-1]["actual_digital_input_bits"] & 1


def test_truth_is_finite_in_every_period(make_bench, plant):
    hand = make_bench(plant=plant).gripped()
    assert np.isfinite(hand.bench.truth.wrenches).all()
