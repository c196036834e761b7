"""Packages and messages of the primary interface."""

import pytest
from hypothesis import given
from hypothesis import strategies as st

from drivers.protocol.errors import WireError
from drivers.protocol.primary import Cutter, PackageType, encode
from drivers.protocol.primary_messages import (
    ErrorCode,
    Key,
    Level,
    Popup,
    RuntimeException,
    SafetyModeChange,
    Text,
    Version,
    decode_message,
    encode_message,
)

MESSAGES = [
    Text("still running"),
    Popup("Message", "mind the gap", warning=True),
    Version((5, 11, 0, 108249), "20-06-2022, 10:00:00"),
    SafetyModeChange(3),
    ErrorCode(207, 0, Level.WARNING, "fieldbus input disconnected"),
    Key("PROGRAM_XXX_STARTED", "motion"),
    RuntimeException(2, 3, "compile_error_name_not_found:f:"),
]
TIMES = st.integers(0, 2**63 - 1)


@pytest.mark.parametrize("message", MESSAGES, ids=lambda m: type(m).__name__)
@given(t=TIMES)
def test_a_message_survives_the_wire(message, t):
    (package,) = Cutter().feed(encode_message(message, t))
    assert package.type == PackageType.ROBOT_MESSAGE
    assert decode_message(package.body) == (t, message)


def test_a_key_message_is_laid_out_as_the_manual_says():
    package = encode_message(Key("PROGRAM_XXX_STARTED", "textmsg"), 0)
    head = b"\x00\x00\x00\x32\x14" + bytes(8) + b"\xfe\x07"
    assert package == head + bytes(8) + b"\x13PROGRAM_XXX_STARTEDtextmsg"


def test_a_safety_mode_message_is_laid_out_as_the_manual_says():
    head = b"\x00\x00\x00\x20\x14" + bytes(8) + b"\xfd\x05"
    assert encode_message(SafetyModeChange(3), 0) == head + bytes(8) + b"\x03" + bytes(8)


@given(st.lists(st.integers(1, 40), max_size=20))
def test_pieces_do_not_matter(cuts):
    stream, cutter, found = b"".join(encode_message(m, 7) for m in MESSAGES), Cutter(), []
    for size in cuts:
        found += cutter.feed(stream[:size])
        stream = stream[size:]
    found += cutter.feed(stream)
    assert [decode_message(package.body)[1] for package in found] == MESSAGES


@given(st.binary(max_size=200))
def test_garbage_is_cut_or_refused(data):
    try:
        packages = Cutter().feed(data)
    except WireError:
        return
    assert sum(len(package.body) + 5 for package in packages) <= len(data)


@given(st.binary(max_size=60))
def test_a_garbled_message_is_refused_or_read(body):
    try:
        time, _ = decode_message(body)
    except WireError:
        return
    assert time == int.from_bytes(body[:8])


def test_messages_of_other_types_are_left_alone():
    assert decode_message(bytes(8) + b"\xfe\x09rest") == (0, None)


def test_a_package_has_a_largest_size():
    with pytest.raises(ValueError, match="allowed are 65536"):
        encode(PackageType.ROBOT_STATE, bytes(1 << 16))
