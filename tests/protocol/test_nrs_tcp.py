"""The sensor's TCP codec: every cut of the stream gives the same messages, garbage one error."""

from math import inf, nan

import pytest
from hypothesis import given
from hypothesis import strategies as st

from drivers.protocol.errors import WireError
from drivers.protocol.nrs_tcp import (
    Cutter,
    Kind,
    Message,
    decode_wrench,
    encode,
    encode_wrench,
)

finite = st.floats(allow_nan=False, allow_infinity=False)
wrenches = st.tuples(*[finite] * 6)
messages = st.lists(
    st.one_of(
        wrenches.map(encode_wrench),
        st.tuples(st.sampled_from(Kind), st.integers(0, 255)).map(lambda pair: encode(*pair)),
        st.binary(max_size=253).map(lambda payload: bytes((len(payload) + 2, 0x42)) + payload),
    )
)


def test_commands_are_the_vendors_bytes():
    assert encode(Kind.TRANSMIT, 1) == bytes.fromhex("030701")
    assert encode(Kind.PERIOD, 5) == bytes.fromhex("030805")
    assert encode(Kind.TARE, 1) == bytes.fromhex("031501")


def test_a_recorded_message_of_a_real_sensor_is_understood():
    octets = bytes.fromhex(
        "3206" "bfaf400000000000" "0000000000000000" "bfbf400000000000"
        "bf34000000000000" "bf44000000000000" "bf5c000000000000"
    )  # fmt: skip
    ((kind, payload),) = Cutter().feed(octets)
    assert kind == Kind.DATA
    # Whole counts of 500 N and 10 N·m over 2 ** 15.
    counts = [value * 2**15 / full for value, full in zip(decode_wrench(payload), [500] * 3 + [10] * 3, strict=True)]  # fmt: skip # noqa: E501
    assert counts == pytest.approx([-4, 0, -8, -1, -2, -5.6], abs=1e-9)


@given(wrenches)
def test_a_wrench_survives_the_wire(wrench):
    ((_, payload),) = Cutter().feed(encode_wrench(wrench))
    assert decode_wrench(payload) == wrench


@given(messages, st.lists(st.integers(0, 2000), max_size=8))
def test_messages_are_the_same_wherever_the_stream_is_cut(parts, cuts):
    stream = b"".join(parts)
    whole = Cutter().feed(stream)
    assert [bytes((len(m.payload) + 2, m.kind)) + m.payload for m in whole] == parts
    cutter, found, last = Cutter(), [], 0
    for cut in sorted({min(cut, len(stream)) for cut in cuts} | {len(stream)}):
        found += cutter.feed(stream[last:cut])
        last = cut
    assert found == whole


@given(st.binary(max_size=600))
def test_garbage_is_messages_or_a_wire_error_and_never_kept_beyond_one_message(octets):
    cutter = Cutter()
    try:
        found = cutter.feed(octets)
    except WireError:
        return
    assert all(isinstance(message, Message) for message in found)
    taken = sum(len(message.payload) + 2 for message in found)
    assert len(octets) - taken < 255


@pytest.mark.parametrize("length", [0, 1])
def test_a_length_without_room_for_a_type_is_an_error(length):
    with pytest.raises(WireError, match="least is 2"):
        Cutter().feed(bytes((length, 6)))


@pytest.mark.parametrize("payload", [b"", bytes(47), bytes(49)])
def test_a_wrench_of_another_length_is_an_error(payload):
    with pytest.raises(WireError, match="instead of 48"):
        decode_wrench(payload)


@pytest.mark.parametrize("bad", [nan, inf, -inf])
def test_a_wrench_that_is_not_finite_is_an_error(bad):
    with pytest.raises(WireError, match="not finite"):
        decode_wrench(encode_wrench((0.0, bad, 0.0, 0.0, 0.0, 0.0))[2:])
