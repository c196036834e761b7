"""Faults of the CAN bus, seen where the host would hear the frames."""

from itertools import pairwise

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from drivers.protocol.can_error import BusState, decode_error
from drivers.protocol.frame import CanFrame
from drivers.protocol.nrs_can import Identifiers, ProtocolError
from drivers.protocol.nrs_sample import decode_fd, decode_pair
from hil.cell.errors import FaultError
from hil.cell.injection import frames
from hil.cell.injection.bus import InjectedGateway
from hil.cell.rig.sensor import CanBus
from hil.cell.sensor.gateway import open_gateway

IDS = Identifiers.of(1)
MS = 1_000_000


def samples(found):
    return [(t, frame) for t, frame in found if frames.is_sample(frame, IDS)]


def halves(found, identifier):
    return [frame for _, frame in found if frame.id == identifier]


def test_frames_are_lost_and_come_back(faulty):
    bench = faulty("C1", cycles=4)
    assert bench.run(4) == []
    assert len(samples(bench.run(4))) >= 60
    assert bench.stages("C1") == ["armed", "active", "cleared"]


@pytest.mark.parametrize("burst", [1, 5])
def test_a_share_of_the_frames_is_lost_in_bursts(burst):
    batch = [(t, CanFrame(t, b"")) for t in range(20_000)]
    kept = frames.lost(batch, 0.2, burst, np.random.default_rng(1))
    assert len(kept) / len(batch) == pytest.approx(0.8, abs=0.02)
    gaps = np.diff([t for t, _ in kept]) - 1
    assert gaps[gaps > 0].mean() == pytest.approx(burst, rel=0.35)


def test_late_frames_are_held_and_then_come_at_once(faulty):
    bench = faulty("C2", cycles=5, params={"mean": "24 ms"})
    bench.run(1)
    assert bench.run(2) == []
    counters = [frame.data[7] for frame in halves(bench.run(7), IDS.force)]
    assert counters == sorted(counters), "a bus never lets one frame overtake another"
    assert bench.stages("C2")[:2] == ["armed", "active"]


def test_duplicates_come_twice(faulty, sound):
    found, plain = faulty("C3").run(3), sound().run(3)
    assert [frame for _, frame in found] == [frame for _, frame in plain for _ in range(2)]


def test_reordered_frames_are_the_same_frames(faulty, sound):
    found, plain = faulty("C3", params={"how": "reorder"}).run(3), sound().run(3)
    assert [f for _, f in found] != [f for _, f in plain]
    assert sorted(f for _, f in found) == sorted(f for _, f in plain)


def test_a_bent_payload_differs_in_so_many_bits(faulty, sound):
    found, plain = faulty("C4", params={"bits": 3}).run(1), sound().run(1)
    for (_, bent), (_, frame) in zip(samples(found), samples(plain), strict=True):
        wrong = int.from_bytes(bent.data, "big") ^ int.from_bytes(frame.data, "big")
        assert 1 <= wrong.bit_count() <= 3


def test_zeros_keep_flags_and_counter(faulty, pairs):
    found = faulty("C4", params={"how": "zeros"}).run(2)
    wrenches = [decode_pair(*pair).wrench for pair in pairs(found)]
    assert len(wrenches) > 10
    assert set(wrenches) == {(0.0,) * 6}


@pytest.mark.parametrize("frames_kind", ["classic", "fd"])
def test_a_counter_stands_still_under_a_valid_checksum(faulty, frames_kind):
    found = faulty("C4", frames=frames_kind, params={"how": "counter"}).run(3)
    sampled = [frame for _, frame in samples(found)]
    assert len({frames.counter_of(frame) for frame in sampled}) == 1
    if frames_kind == "fd":
        assert {decode_fd(IDS, frame.data).counter & 0xFF for frame in sampled}


def test_wrong_lengths_and_unknown_identifiers(faulty):
    found = faulty("C5", params={"what": "both"}).run(1)
    assert {len(frame.data) for _, frame in samples(found)} == {0, 6, 7}
    assert frames.UNKNOWN in [frame for _, frame in found]


@pytest.mark.parametrize(
    ("kind", "params", "state"),
    [
        ("C6", {"state": "passive"}, BusState.PASSIVE),
        ("C6", {"state": "warning"}, BusState.WARNING),
        ("C7", {"down": "16 ms"}, BusState.OFF),
    ],
)
def test_error_frames_reach_the_host_through_the_gateway(faulty, kind, params, state):
    bench = faulty(kind, params=params)
    bench.run(1)
    sound = open_gateway(CanBus(interface="virtual", channel="errors"), across_processes=False)
    listener = open_gateway(CanBus(interface="virtual", channel="errors"), across_processes=False)
    gateway = InjectedGateway(sound, bench.wire)
    gateway.send([])
    message = listener._bus.recv(0)
    gateway.close()
    listener.close()
    assert message is not None
    assert message.is_error_frame
    assert decode_error(message.arbitration_id, bytes(message.data)).state is state
    assert bench.stages(kind)[:2] == ["armed", "active"]


def test_a_node_that_is_off_the_bus_is_silent_until_it_is_back(faulty):
    bench = faulty("C7", params={"down": "16 ms"})
    assert bench.run(2) == []
    assert samples(bench.run(3))
    assert bench.stages("C7") == ["armed", "active", "cleared"]


def test_a_full_bus_lets_nothing_of_the_node_through_until_it_is_over(faulty):
    bench = faulty("C8", cycles=4)
    found = bench.run(3)
    assert not samples(found)
    assert {frame for _, frame in found} == {frames.BABBLE}
    assert samples(bench.run(20))


@given(st.floats(0.1, 0.9), st.lists(st.integers(0, 50 * MS), min_size=1, max_size=60))
def test_frames_get_through_a_loaded_bus_in_order_late_and_one_at_a_time(load, moments):
    batch = [(t, CanFrame(1, b"")) for t in sorted(moments)]
    through, free = frames.crowded(batch, load, 0, 1 << 62)
    starts = [t for t, _ in through]
    assert all(start >= sent for start, (sent, _) in zip(starts, batch, strict=True))
    assert all(b - a >= frames.FRAME for a, b in pairwise(starts))
    assert free == starts[-1] + frames.FRAME


def test_half_a_wrench_never_has_its_torque(faulty):
    found = faulty("C9").run(3)
    assert halves(found, IDS.force)
    assert not halves(found, IDS.torque)


def test_a_wrench_in_one_frame_has_no_halves(faulty):
    with pytest.raises(FaultError, match=r"faults\[0\]: C9 can.half: frames are fd"):
        faulty("C9", frames="fd")


@given(st.binary(min_size=8, max_size=8), st.integers(1, 64), st.integers(0, 1000))
def test_a_bent_frame_keeps_its_identifier_and_length(data, bits, seed):
    rng = np.random.default_rng(seed)
    bent = frames.bent(CanFrame(IDS.force, data), "bits", bits, 0, rng)
    assert (bent.id, len(bent.data)) == (IDS.force, 8)


def test_halves_of_a_bent_pair_are_refused_or_differ(faulty):
    found = faulty("C4", params={"bits": 8}).run(1)
    for force, torque in zip(halves(found, IDS.force), halves(found, IDS.torque), strict=True):
        with pytest.raises(ProtocolError):
            decode_pair(force.data, torque.data[:7])
