"""The sensor node by frames alone: boot, schedule, commands, tare, events."""

from itertools import pairwise

import numpy as np
import pytest

from drivers.protocol.nrs_can import OVERLOAD, SATURATED, TARED, VALID, Identifiers
from drivers.protocol.nrs_command import (
    Command,
    Opcode,
    Result,
    decode_reply,
    encode_command,
)
from drivers.protocol.nrs_sample import decode_fd, decode_pair
from drivers.protocol.nrs_status import (
    EmergencyCode,
    NodeState,
    StatusBit,
    decode_emergency,
    decode_heartbeat,
    decode_status,
)
from hil.cell.errors import RigError
from hil.cell.rig.sensor import Sensor
from hil.cell.sensor.node import SensorNode

IDS = Identifiers.of(1)
MS = 1_000_000
QUIET = Sensor(preset="nrs-6050-d80-quiet")


class Bench:
    """A node, its time, and everything it has sent."""

    def __init__(self, sensor=QUIET, seed=1):
        self.node = SensorNode(sensor, np.random.default_rng(seed))
        self.t = 0
        self.sent = []
        self.load = np.zeros(6)
        self.seq = 0

    def run(self, milliseconds, step=8):
        """Advance in periods; what was sent in them."""
        start = len(self.sent)
        for _ in range(milliseconds // step):
            self.t += step * MS
            self.sent += self.node.advance(self.t, np.tile(self.load, (step, 1)))
        return self.sent[start:]

    def ask(self, opcode, *arguments, seq=None):
        self.seq += 1
        command = Command(opcode, self.seq if seq is None else seq, arguments)
        self.node.receive(encode_command(IDS, command), self.t)

    def answer(self, opcode, *arguments):
        self.ask(opcode, *arguments)
        return replies(self.run(8))[-1]


def of(frames, identifier):
    return [(t, frame.data) for t, frame in frames if frame.id == identifier]


def replies(frames):
    return [decode_reply(octets) for _, octets in of(frames, IDS.reply)]


def samples(frames):
    pairs = zip(of(frames, IDS.force), of(frames, IDS.torque), strict=True)
    return [decode_pair(force, torque) for (_, force), (_, torque) in pairs]


@pytest.fixture
def bench():
    bench = Bench()
    bench.run(400)
    return bench


@pytest.fixture
def streaming(bench):
    bench.ask(Opcode.TRANSMIT, 1)
    bench.run(8)
    bench.sent.clear()
    # A torque frame that was on its way at the period's end would have no partner here.
    bench.run(8)
    bench.sent.clear()
    return bench


def numbered(frames):
    """Samples of frames that may begin or end half way through a pair."""
    force = {octets[7]: octets for _, octets in of(frames, IDS.force)}
    torque = {octets[7]: octets for _, octets in of(frames, IDS.torque)}
    return {c: decode_pair(force[c], torque[c]) for c in force if c in torque}


def test_boot_is_said_once_and_then_the_node_waits_idle():
    bench = Bench()
    frames = bench.run(600)
    beats = [(t, decode_heartbeat(octets)) for t, octets in of(frames, IDS.heartbeat)]
    assert beats[0] == (0, NodeState.BOOT)
    assert beats[1] == (300 * MS, NodeState.PRE_OPERATIONAL)
    assert {state for _, state in beats[1:]} == {NodeState.PRE_OPERATIONAL}
    assert not of(frames, IDS.force)


def test_heartbeat_and_status_come_ten_times_a_second(bench):
    bench.sent.clear()
    frames = bench.run(1000)
    assert len(of(frames, IDS.heartbeat)) == 10
    assert len(of(frames, IDS.status)) == 10


def test_commands_during_boot_are_lost():
    bench = Bench()
    bench.ask(Opcode.TRANSMIT, 1)
    assert not replies(bench.run(400))


def test_every_millisecond_a_pair_with_the_next_counter(streaming):
    frames = streaming.run(800)
    counters = [octets[7] for _, octets in of(frames, IDS.force)]
    assert len(counters) == 800
    assert all((b - a) % 256 == 1 for a, b in pairwise(counters))
    times = [t for t, _ in of(frames, IDS.force)]
    assert set(np.diff(times)) == {MS}


def test_frames_leave_in_order_and_within_the_period(streaming):
    for _ in range(20):
        frames = streaming.run(8)
        times = [t for t, _ in frames]
        assert times == sorted(times)
        assert all(streaming.t - 8 * MS < t <= streaming.t for t in times)


def test_torque_leaves_120_us_after_force(streaming):
    frames = streaming.run(80)
    force = {octets[7]: t for t, octets in of(frames, IDS.force)}
    torque = {octets[7]: t for t, octets in of(frames, IDS.torque)}
    assert {torque[c] - force[c] for c in force if c in torque} == {120_000}


def test_a_noisy_nodes_clock_runs_within_its_tolerance():
    bench = Bench(Sensor())
    bench.run(400)
    bench.ask(Opcode.TRANSMIT, 1)
    times = [t for t, _ in of(bench.run(8000), IDS.force)]
    interval = (times[-1] - times[0]) / (len(times) - 1)
    assert interval != MS
    assert interval == pytest.approx(MS, rel=50e-6)


def test_a_sample_shows_the_load_of_its_own_millisecond(streaming):
    streaming.t += 8 * MS
    ramp = np.outer(np.arange(1, 9) * 0.15, np.ones(6))
    ramp[:, 3:] = 0
    frames = streaming.node.advance(streaming.t, ramp)
    values = [round(s.wrench[0] / 0.15) for s in numbered(frames).values()]
    assert values[-7:] == [1, 2, 3, 4, 5, 6, 7]


def test_a_tare_says_which_sample_was_the_first_on_the_new_zero(streaming):
    streaming.load = np.array([3.0, -6.0, 9.0, 0.0312, 0.0, 0.0])
    streaming.run(8)
    streaming.sent.clear()
    streaming.ask(Opcode.TARE, 1, 20)
    frames = streaming.run(80)
    (reply,) = replies(frames)
    assert reply.result is Result.OK
    for counter, sample in numbered(frames).items():
        on_new_zero = (counter - reply.values[0]) % 256 < 128
        assert bool(sample.flags & TARED) == on_new_zero
        assert (sample.wrench == (0.0,) * 6) == on_new_zero
    assert sum((c - reply.values[0]) % 256 >= 128 for c in numbered(frames)) >= 20


def test_the_tare_can_be_read_and_cleared(streaming):
    streaming.load = np.array([0, 0, -9.75, 0, 0, 0])
    streaming.run(8)
    streaming.ask(Opcode.TARE, 1, 4)
    streaming.run(16)
    assert streaming.answer(Opcode.GET_TARE, 2).values == (2, -650)
    assert streaming.answer(Opcode.TARE, 0, 0).result is Result.OK
    assert streaming.answer(Opcode.GET_TARE, 2).values == (2, 0)


def test_a_repeated_command_is_answered_again_and_done_once(streaming):
    streaming.load = np.array([0, 0, 3.0, 0, 0, 0])
    streaming.ask(Opcode.TARE, 1, 4, seq=77)
    first = replies(streaming.run(16))
    streaming.load = np.zeros(6)
    streaming.ask(Opcode.TARE, 1, 4, seq=77)
    again = replies(streaming.run(16))
    assert first == again
    assert streaming.answer(Opcode.GET_TARE, 2).values == (2, 200)


def test_a_tare_without_transmission_is_the_wrong_state(bench):
    assert bench.answer(Opcode.TARE, 1, 10).result is Result.WRONG_STATE


def test_a_second_tare_while_one_runs_is_busy(streaming):
    streaming.ask(Opcode.TARE, 1, 500)
    assert streaming.answer(Opcode.TARE, 1, 10).result is Result.BUSY


@pytest.mark.parametrize(
    ("opcode", "arguments", "result", "values"),
    [
        (Opcode.SET_PERIOD, (200,), Result.OK, (200,)),
        (Opcode.SET_PERIOD, (0,), Result.OUT_OF_RANGE, ()),
        (Opcode.SET_PERIOD, (201,), Result.OUT_OF_RANGE, ()),
        (Opcode.SET_FILTER, (1000,), Result.OK, (1000,)),
        (Opcode.SET_FILTER, (5001,), Result.OUT_OF_RANGE, ()),
        (Opcode.TRANSMIT, (2,), Result.OUT_OF_RANGE, ()),
        (Opcode.GET_FULL_SCALE, (0,), Result.OK, (0, 5000)),
        (Opcode.GET_FULL_SCALE, (5,), Result.OK, (5, 100)),
        (Opcode.GET_FULL_SCALE, (6,), Result.OUT_OF_RANGE, ()),
        (Opcode.GET_SERIAL, (0,), Result.OK, (0, int.from_bytes(b"HIL-", "little"))),
        (Opcode.GET_FIRMWARE, (), Result.OK, (1, 0, 1, 1)),
        (Opcode.SAVE, (), Result.OK, ()),
        (Opcode.CLEAR_FAULT, (), Result.OK, ()),
        (Opcode.RESET, (0xBEEF,), Result.OUT_OF_RANGE, ()),
        (0x33, (), Result.UNSUPPORTED, ()),
    ],
)
def test_each_command_has_its_answer(bench, opcode, arguments, result, values):
    reply = bench.answer(opcode, *arguments)
    assert (reply.opcode, reply.result, reply.values) == (opcode, result, values)


def test_a_longer_period_thins_the_samples_and_counts_what_is_sent(streaming):
    streaming.ask(Opcode.SET_PERIOD, 10)
    streaming.run(8)
    frames = streaming.run(1000)
    counters = [octets[7] for _, octets in of(frames, IDS.force)]
    assert len(counters) == 100
    assert all((b - a) % 256 == 1 for a, b in pairwise(counters))


def test_reset_forgets_the_tare_and_keeps_what_was_saved(streaming):
    streaming.ask(Opcode.SET_FILTER, 500)
    streaming.ask(Opcode.SAVE)
    streaming.ask(Opcode.SET_PERIOD, 20)
    streaming.ask(Opcode.TARE, 1, 1)
    streaming.run(80)
    streaming.ask(Opcode.RESET, 0xB007)
    frames = streaming.run(400)
    beats = [decode_heartbeat(octets) for _, octets in of(frames, IDS.heartbeat)]
    assert beats[0] is NodeState.BOOT
    last = decode_status(of(frames, IDS.status)[-1][1])
    assert last.sample_count == 0
    assert not last.bits & (StatusBit.TARED | StatusBit.TRANSMIT_ON)
    assert last.bits & StatusBit.FILTER_ON
    streaming.ask(Opcode.TRANSMIT, 1)
    assert len(of(streaming.run(80), IDS.force)) >= 79


def test_overload_is_flagged_reported_at_once_and_cleared(streaming):
    streaming.load = np.array([0, 0, -520.0, 0, 0, 0])
    frames = streaming.run(16)
    flags = [sample.flags for sample in numbered(frames).values()]
    assert flags[-1] == VALID | OVERLOAD
    events = [decode_emergency(octets) for _, octets in of(frames, IDS.emergency)]
    assert [(event.code, event.axis) for event in events] == [(EmergencyCode.FORCE_OVERLOAD, 2)]
    assert decode_status(of(frames, IDS.status)[0][1]).bits & StatusBit.OVERLOAD_FZ
    streaming.load = np.zeros(6)
    (event,) = of(streaming.run(16), IDS.emergency)
    assert decode_emergency(event[1]).code is EmergencyCode.ERROR_RESET


def test_a_torque_overload_names_itself(streaming):
    streaming.load = np.array([0, 0, 0, 0, 11.0, 0])
    (event,) = of(streaming.run(16), IDS.emergency)
    assert decode_emergency(event[1])[:4] == (EmergencyCode.TORQUE_OVERLOAD, 1, 0, 4)


def test_a_clipped_sample_says_that_it_is_a_bound(streaming):
    streaming.load = np.array([700.0, 0, 0, 0, 0, 0])
    sample = list(numbered(streaming.run(16)).values())[-1]
    assert sample.flags & SATURATED
    assert sample.wrench[0] == pytest.approx(600.0)


def test_a_broken_gauge_stays_invalid_until_cleared(streaming):
    streaming.load = np.array([1600.0, 0, 0, 0, 0, 0])
    streaming.run(16)
    streaming.load = np.zeros(6)
    streaming.run(16)
    assert not list(numbered(streaming.run(16)).values())[-1].flags & VALID
    streaming.ask(Opcode.CLEAR_FAULT)
    streaming.run(8)
    assert list(numbered(streaming.run(16)).values())[-1].flags == VALID


def test_a_tare_beyond_the_wire_saturates_and_never_wraps(streaming):
    streaming.load = np.array([599.0, 0, 0, 0, 0, 0])
    streaming.run(8)
    streaming.ask(Opcode.TARE, 1, 4)
    streaming.run(16)
    streaming.load = np.array([-599.0, 0, 0, 0, 0, 0])
    sample = list(numbered(streaming.run(16)).values())[-1]
    assert sample.wrench[0] == pytest.approx(-983.0, abs=0.1)
    assert sample.flags & SATURATED


def test_fd_frames_carry_the_same_wrench(bench):
    fd = Bench(QUIET.model_copy(update={"frames": "fd"}))
    fd.load = np.array([1.5, -3.0, 9.0, 0.0312, -0.0624, 0.0])
    fd.run(400)
    fd.ask(Opcode.TRANSMIT, 1)
    frames = of(fd.run(16), IDS.wrench_fd)
    assert len(frames) == 16
    sample = decode_fd(IDS, frames[-1][1])
    assert sample.wrench == pytest.approx(tuple(fd.load))


@pytest.mark.parametrize("octets", [b"", b"\x07", b"\x07\x01\x01", bytes(9)])
def test_a_command_of_wrong_length_is_ignored(bench, octets):
    bench.node.receive(encode_command(IDS, Command(Opcode.SAVE, 1))._replace(data=octets), bench.t)
    assert not replies(bench.run(8))


def test_the_same_seed_gives_the_same_frames():
    def record(seed):
        bench = Bench(Sensor(), seed)
        bench.run(400)
        bench.ask(Opcode.TRANSMIT, 1)
        bench.run(400)
        return bench.sent

    assert record(1) == record(1)
    assert record(1) != record(2)


def test_a_range_that_the_wire_cannot_carry_is_refused():
    with pytest.raises(RigError, match="1000 exceeds the 983"):
        SensorNode(QUIET.model_copy(update={"range_force": 1000.0}), np.random.default_rng(0))


@pytest.mark.parametrize("rate", [0.0, 2000.0, 300.0, 4.0])
def test_a_rate_that_the_node_cannot_keep_is_refused(rate):
    with pytest.raises(RigError, match="1000 Hz / n"):
        SensorNode(QUIET.model_copy(update={"rate": rate}), np.random.default_rng(0))


def test_a_cutoff_beyond_half_the_rate_is_refused():
    with pytest.raises(RigError, match="filter_cutoff 600 Hz"):
        SensorNode(QUIET.model_copy(update={"filter_cutoff": 600.0}), np.random.default_rng(0))


def test_a_slower_rig_sends_at_its_own_rate():
    bench = Bench(QUIET.model_copy(update={"rate": 250.0}))
    bench.run(400)
    bench.ask(Opcode.TRANSMIT, 1)
    assert len(of(bench.run(400), IDS.force)) == 100
