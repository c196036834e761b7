"""The set-up dialogue against replies given by hand, in memory."""

import pytest

from drivers.errors import ProtocolError, RecipeError
from drivers.protocol import rtde_setup as setup
from drivers.protocol.errors import WireError
from drivers.protocol.rtde import IN_USE, NOT_FOUND, Cutter, Package, PackageType
from drivers.ur.rtde_client import handshake, rate_of

OUTPUTS = ("timestamp", "actual_TCP_pose")
INPUTS = ("input_int_register_24", "input_double_register_24")

V, v, O, I, S = (  # noqa: E741  (the guide's letters)
    PackageType.REQUEST_PROTOCOL_VERSION,
    PackageType.GET_CONTROLLER_VERSION,
    PackageType.SETUP_OUTPUTS,
    PackageType.SETUP_INPUTS,
    PackageType.START,
)

VERSION = setup.ControllerVersion(3, 15, 8, 106339)
REPLIES = {
    V: setup.encode_accepted(True),
    v: setup.encode_controller_version(VERSION),
    O: setup.encode_types(["DOUBLE", "VECTOR6D"], 1),
    I: setup.encode_types(["INT32", "DOUBLE"], 7),
    S: setup.encode_accepted(True),
}
TEXT = Package(
    PackageType.TEXT_MESSAGE, setup.encode_text(setup.TextMessage("hello", "controller", 3))
)


def played(replies, between=()):
    """The requests of a dialogue and what it came to."""
    dialogue = handshake(OUTPUTS, INPUTS)
    requests = Cutter().feed(next(dialogue))
    try:
        while True:
            for package in between:
                assert dialogue.send(package) == b""
            kind = requests[-1].type
            requests += Cutter().feed(dialogue.send(Package(kind, replies[kind])))
    except StopIteration as end:
        return requests, end.value


def test_requests_come_in_the_guides_order():
    assert [request.type for request in played(REPLIES)[0]] == [V, v, O, I, S]


def test_the_agreement_holds_recipes_ids_and_rate():
    agreement = played(REPLIES)[1]
    assert (agreement.version, agreement.rate) == (VERSION, 125)
    assert (agreement.output_id, agreement.input_id) == (1, 7)
    assert (agreement.outputs.names, agreement.outputs.size) == (OUTPUTS, 56)
    assert (agreement.inputs.names, agreement.inputs.size) == (INPUTS, 12)


@pytest.mark.parametrize(("major", "rate"), [(3, 125), (5, 500), (10, 500)])
def test_outputs_are_asked_for_at_the_series_rate(major, rate):
    version = setup.ControllerVersion(major, 0, 0, 0)
    replies = REPLIES | {v: setup.encode_controller_version(version)}
    requests, agreement = played(replies)
    assert setup.decode_names_with_frequency(requests[2].payload) == (OUTPUTS, rate)
    assert agreement.rate == rate_of(version) == rate


def test_data_and_text_between_replies_are_passed_over():
    between = [TEXT, Package(PackageType.DATA, b"\x01old")]
    requests, agreement = played(REPLIES, between)
    assert requests == played(REPLIES)[0]
    assert agreement.version == VERSION


@pytest.mark.parametrize("kind", REPLIES)
def test_a_reply_of_another_type_is_a_protocol_error(kind):
    dialogue = handshake(OUTPUTS, INPUTS)
    request = Cutter().feed(next(dialogue))[0]
    while request.type != kind:
        request = Cutter().feed(dialogue.send(Package(request.type, REPLIES[request.type])))[0]
    with pytest.raises(ProtocolError, match=f"type {ord('P')} to {kind.name}"):
        dialogue.send(Package(PackageType.PAUSE, b"\x01"))


@pytest.mark.parametrize(
    ("replies", "error", "words"),
    [
        ({V: b"\x00"}, ProtocolError, "protocol 2"),
        ({V: b""}, WireError, "0 bytes"),
        ({v: b"\x03"}, WireError, "1 bytes"),
        ({S: b"\x00"}, ProtocolError, "refuses to start"),
        ({O: setup.encode_types(["DOUBLE", NOT_FOUND], 0)}, RecipeError, "actual_TCP_pose"),
        ({I: setup.encode_types([IN_USE, "DOUBLE"], 0)}, RecipeError, "input_int_register_24"),
        ({I: setup.encode_types([IN_USE, IN_USE], 0)}, RecipeError, "register_24, input_double"),
        ({O: setup.encode_types(["DOUBLE", "VECTOR6D"], 0)}, RecipeError, "refuses the recipe"),
        ({O: setup.encode_types(["DOUBLE"], 1)}, ProtocolError, "1 types"),
        ({O: setup.encode_types(["DOUBLE", "QUATERNION"], 1)}, ProtocolError, "QUATERNION"),
        ({I: b""}, WireError, "without a recipe id"),
    ],
)
def test_what_the_controller_refuses_is_said(replies, error, words):
    with pytest.raises(error, match=words):
        played(REPLIES | replies)
