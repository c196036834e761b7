"""Set-up payloads against bytes captured from ur_rtde's handshake, and back and forth."""

from contextlib import suppress

import pytest
from hypothesis import given
from hypothesis import strategies as st

from drivers.protocol import rtde_setup as setup
from drivers.protocol.errors import WireError
from drivers.protocol.rtde import PackageType, encode

names = st.lists(
    st.text("abcdefghijklmnopqrstuvwxyz_0123456789", min_size=1), min_size=1, max_size=20
).map(tuple)
short = st.text(max_size=60)

GOLDEN = [
    ("0005560002", encode(PackageType.REQUEST_PROTOCOL_VERSION, setup.encode_protocol_version(2))),
    ("00045601", encode(PackageType.REQUEST_PROTOCOL_VERSION, setup.encode_accepted(True))),
    ("000376", encode(PackageType.GET_CONTROLLER_VERSION)),
    (
        "001376000000030000000f0000000800019f63",
        encode(
            PackageType.GET_CONTROLLER_VERSION,
            setup.encode_controller_version(setup.ControllerVersion(3, 15, 8, 106339)),
        ),
    ),
    ("000353", encode(PackageType.START)),
    ("00045301", encode(PackageType.START, setup.encode_accepted(True))),
]


@pytest.mark.parametrize(("captured", "ours"), GOLDEN)
def test_our_bytes_are_those_of_a_captured_exchange(captured, ours):
    assert ours.hex() == captured


def test_the_rates_that_clients_ask_for_are_captured_ones():
    assert setup.encode_names(["timestamp"], 125.0)[:8].hex() == "405f400000000000"
    assert setup.encode_names(["timestamp"], 500.0)[:8].hex() == "407f400000000000"


@given(names, st.floats(1.0, 500.0))
def test_recipe_requests_come_back(fields, frequency):
    assert setup.decode_names(setup.encode_names(fields)) == fields
    payload = setup.encode_names(fields, frequency)
    assert setup.decode_names_with_frequency(payload) == (fields, frequency)


def test_one_trailing_comma_is_forgiven():
    assert setup.decode_names(b"timestamp,actual_q,") == ("timestamp", "actual_q")


@given(names, st.integers(0, 255))
def test_recipe_replies_come_back(types, recipe_id):
    assert setup.decode_types(setup.encode_types(types)) == types
    assert setup.decode_types_with_id(setup.encode_types(types, recipe_id)) == (types, recipe_id)


@given(short, short, st.sampled_from(setup.TextLevel))
def test_text_messages_come_back(message, source, level):
    text = setup.TextMessage(message, source, level)
    assert setup.decode_text(setup.encode_text(text)) == text
    assert setup.decode_text_v1(setup.encode_text_v1(level, message)) == (message, "", level)


def test_a_long_text_is_cut_to_what_its_length_byte_can_say():
    text = setup.decode_text(setup.encode_text(setup.TextMessage("a" * 300, "", 3)))
    assert text.message == "a" * 255


DECODERS = [
    setup.decode_protocol_version,
    setup.decode_controller_version,
    setup.decode_accepted,
    setup.decode_names,
    setup.decode_names_with_frequency,
    setup.decode_types,
    setup.decode_types_with_id,
    setup.decode_text,
    setup.decode_text_v1,
]


@pytest.mark.parametrize("decode", DECODERS)
@given(payload=st.binary(max_size=80))
def test_garbage_raises_wire_error_or_nothing(decode, payload):
    with suppress(WireError):
        decode(payload)


@pytest.mark.parametrize(
    ("decode", "payload"),
    [
        (setup.decode_protocol_version, b"\x02"),
        (setup.decode_controller_version, bytes(15)),
        (setup.decode_accepted, b""),
        (setup.decode_accepted, b"\x01\x01"),
        (setup.decode_names, b"timest\xe4mp"),
        (setup.decode_names_with_frequency, bytes(7)),
        (setup.decode_types_with_id, b""),
        (setup.decode_text, b"\x05abc"),
        (setup.decode_text, b"\x00\x00"),
        (setup.decode_text_v1, b""),
    ],
)
def test_a_payload_that_breaks_its_layout_is_refused(decode, payload):
    with pytest.raises(WireError):
        decode(payload)
