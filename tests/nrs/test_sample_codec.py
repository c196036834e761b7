"""Laws of the sample codec, with cantools reading the same frames through the DBC."""

from contextlib import suppress
from pathlib import Path

import cantools
import pytest
from hypothesis import given
from hypothesis import strategies as st

import drivers.protocol
from drivers.errors import ProtocolError
from drivers.protocol.crc8 import crc8
from drivers.protocol.nrs_can import FORCE_LSB, TORQUE_LSB, Identifiers
from drivers.protocol.nrs_sample import decode_fd, decode_pair, encode_fd, encode_pair

IDS = Identifiers.of(1)
counts_17 = st.lists(st.integers(-(1 << 16), (1 << 16) - 1), min_size=6, max_size=6)
counts_24 = st.lists(st.integers(-(1 << 23), (1 << 23) - 1), min_size=6, max_size=6)
flags = st.integers(0, 0x1F)
bytes_8 = st.binary(min_size=8, max_size=8)
AXES = ("Fx", "Fy", "Fz", "Tx", "Ty", "Tz")


@pytest.fixture(scope="module")
def dbc():
    path = Path(drivers.protocol.__file__).with_name("nrs.dbc")
    return cantools.database.load_file(path, strict=True)


def test_a_pair_has_the_bytes_that_the_layout_says():
    force, torque = encode_pair(IDS, [1, -1, 2, 0, 0, -65536], flags=0x09, counter=0x2A)
    assert (force.id, force.data.hex()) == (0x181, "0100feff0b00482a")
    assert (torque.id, torque.data.hex()) == (0x281, "0000000000004c2a")


@given(counts_17, flags, st.integers(0, 1000))
def test_a_pair_decodes_to_what_was_encoded(counts, flag, counter):
    force, torque = encode_pair(IDS, counts, flag, counter)
    sample = decode_pair(force.data, torque.data)
    lsb = [FORCE_LSB] * 3 + [TORQUE_LSB] * 3
    assert sample.wrench == tuple(c * k for c, k in zip(counts, lsb, strict=True))
    assert (sample.flags, sample.counter) == (flag, counter % 256)


@given(counts_17, flags, st.integers(0, 255))
def test_cantools_reads_the_same_pair(dbc, counts, flag, counter):
    force, torque = encode_pair(IDS, counts, flag, counter)
    sample = decode_pair(force.data, torque.data)
    read = dbc.decode_message(force.id, force.data) | dbc.decode_message(torque.id, torque.data)
    assert [read[axis] for axis in AXES] == pytest.approx(sample.wrench, abs=1e-9)
    assert read["F_Counter"] == read["T_Counter"] == counter
    assert [read[f"T_{name}"] for name in ("Valid", "Overload", "Saturated", "Tared", "Fault")] == [
        flag >> bit & 1 for bit in range(5)
    ]


@given(counts_24, flags, st.integers(0, 65535), st.integers(0, 65535))
def test_cantools_reads_the_same_fd_frame(dbc, counts, flag, counter, microseconds):
    frame = encode_fd(IDS, counts, flag, counter, microseconds)
    sample = decode_fd(IDS, frame.data)
    read = dbc.decode_message(frame.id, frame.data)
    assert [read[f"X_{axis}"] for axis in AXES] == pytest.approx(sample.wrench, abs=1e-9)
    assert (read["X_Counter"], read["X_TimestampUs"]) == (counter, microseconds)
    assert (sample.flags, sample.counter) == (flag, counter)


@given(counts_24, st.integers(0, 8 * 24 - 1))
def test_one_bent_bit_of_an_fd_frame_is_caught(counts, bit):
    octets = bytearray(encode_fd(IDS, counts, 9, 7, 0).data)
    octets[bit // 8] ^= 1 << bit % 8
    with pytest.raises(ProtocolError):
        decode_fd(IDS, bytes(octets))


@given(counts_17, st.integers(0, 255), st.integers(1, 255))
def test_halves_of_two_samples_are_refused(counts, counter, step):
    force, _ = encode_pair(IDS, counts, 9, counter)
    _, torque = encode_pair(IDS, counts, 9, counter + step)
    with pytest.raises(ProtocolError, match="not halves of one sample"):
        decode_pair(force.data, torque.data)


@given(st.binary(max_size=30), st.binary(max_size=30))
def test_garbage_raises_protocol_error_or_nothing(first, second):
    for decode in (lambda: decode_pair(first, second), lambda: decode_fd(IDS, first)):
        with suppress(ProtocolError):
            decode()


@pytest.mark.parametrize("beyond", [1 << 16, -(1 << 16) - 1])
def test_a_count_beyond_17_bits_is_the_callers_error(beyond):
    with pytest.raises(ValueError, match="17 bits"):
        encode_pair(IDS, [0, 0, beyond, 0, 0, 0], 9, 0)


def test_crc8_gives_the_published_check_value():
    assert crc8(b"123456789") == 0x4B


@pytest.mark.parametrize("node", [0, 16])
def test_a_node_id_outside_the_range_is_refused(node):
    with pytest.raises(ValueError, match=r"1 \.\. 15"):
        Identifiers.of(node)
