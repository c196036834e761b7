"""RTDE sessions joined in memory: a client's bytes in, the controller's bytes out."""

from contextlib import suppress
from itertools import repeat

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from drivers.protocol.errors import WireError
from drivers.protocol.rtde import Cutter, FieldType, PackageType, Recipe, encode
from drivers.protocol.rtde_setup import (
    decode_text,
    decode_types,
    decode_types_with_id,
    encode_names,
    encode_protocol_version,
)
from hil.cell.arm.controller import ArmController
from hil.cell.arm.ownership import FIELDBUS
from hil.cell.arm.rtde_session import RtdeSession
from hil.cell.rig.robot import Robot

MS = 1_000_000
NAMES = ("timestamp", "actual_q", "robot_mode")
OUTPUTS = Recipe(NAMES, (FieldType.DOUBLE, FieldType.VECTOR6D, FieldType.INT32))
REGISTER = Recipe(("input_int_register_0",), (FieldType.INT32,))


class Client:
    """The other end of a session, in memory."""

    def __init__(self, cell, number=1, delay=0):
        self.session = RtdeSession(cell.arm, number, repeat(delay))

    def ask(self, type, payload=b"", t=0):
        """The payload of the one reply."""
        (package,) = Cutter().feed(self.session.receive(encode(type, payload), t))
        assert package.type == type
        return package.payload

    def agree(self, version=2):
        return self.ask(PackageType.REQUEST_PROTOCOL_VERSION, encode_protocol_version(version))

    def inputs(self, *names):
        return decode_types_with_id(self.ask(PackageType.SETUP_INPUTS, encode_names(names)))

    def outputs(self, *names, frequency=125.0):
        reply = self.ask(PackageType.SETUP_OUTPUTS, encode_names(names, frequency))
        return decode_types_with_id(reply)

    def start(self):
        return self.ask(PackageType.START)

    def send(self, value, recipe=1, t=0):
        body = bytes((recipe,)) + REGISTER.pack((value,))
        return self.session.receive(encode(PackageType.DATA, body), t)

    def package(self, step):
        (package,) = Cutter().feed(self.session.publish(step))
        return package.payload


@pytest.fixture
def client(cell):
    client = Client(cell)
    client.agree()
    return client


def test_golden_set_up_bytes(cell):
    session = Client(cell).session
    assert session.receive(bytes.fromhex("0005560002"), 0).hex() == "00045601"
    version = session.receive(bytes.fromhex("000376"), 0)
    assert version.hex() == "001376000000030000000f0000000800019f63"


def test_version_three_is_refused(cell):
    assert Client(cell).agree(3) == b"\x00"


def test_outputs_get_their_types_and_recipe_one(client):
    assert client.outputs(*NAMES) == (("DOUBLE", "VECTOR6D", "INT32"), 1)


def test_a_trailing_comma_is_forgiven(client):
    request = encode_names(NAMES, 125.0) + b","
    types, _ = decode_types_with_id(client.ask(PackageType.SETUP_OUTPUTS, request))
    assert types == ("DOUBLE", "VECTOR6D", "INT32")


def test_protocol_one_has_no_frequency_and_no_recipe_id(cell):
    client = Client(cell)
    reply = client.ask(PackageType.SETUP_OUTPUTS, encode_names(NAMES))
    assert decode_types(reply) == ("DOUBLE", "VECTOR6D", "INT32")
    client.start()
    assert OUTPUTS.unpack(client.package(1))[2] == 3


def test_an_unknown_output_spoils_the_recipe(client):
    assert client.outputs("timestamp", "no_such_thing") == (("DOUBLE", "NOT_FOUND"), 0)
    assert client.start() == b"\x00"


def test_a_variable_of_a_later_version_is_not_found(make_cell):
    old = Client(make_cell(version="3.9.0.1"))
    old.agree()
    assert old.outputs("payload") == (("NOT_FOUND",), 0)
    new = Client(make_cell(version="3.11.0.1"))
    new.agree()
    assert new.outputs("payload") == (("DOUBLE",), 1)


@pytest.mark.parametrize("frequency", [0.0, -1.0, float("nan"), float("inf")])
def test_a_senseless_frequency_is_refused(client, frequency):
    assert client.outputs(*NAMES, frequency=frequency)[1] == 0


def test_start_needs_outputs(client):
    assert client.start() == b"\x00"
    client.outputs(*NAMES)
    assert client.session.publish(1) == b""
    assert client.start() == b"\x01"
    assert client.session.publish(1)


def test_a_package_carries_the_present_state(cell, client):
    client.outputs(*NAMES)
    client.start()
    cell.run(3)
    payload = client.package(3)
    t, q, mode = OUTPUTS.unpack(payload[1:])
    assert (payload[0], t, mode) == (1, 0.024, 3)
    assert q == pytest.approx(cell.box.robot.home, abs=1e-3)


def test_pause_stops_and_start_resumes(client):
    client.outputs(*NAMES)
    client.start()
    assert client.ask(PackageType.PAUSE) == b"\x01"
    assert client.session.publish(1) == b""
    client.start()
    assert client.session.publish(2)


def test_new_outputs_wait_for_a_new_start(client):
    client.outputs(*NAMES)
    client.start()
    client.outputs("timestamp")
    assert client.session.publish(1) == b""


@pytest.mark.parametrize(
    ("frequency", "every"), [(125.0, 1), (500.0, 1), (100.0, 1), (62.5, 2), (40.0, 3), (1.0, 125)]
)
def test_rates_are_decimated_by_whole_steps(client, frequency, every):
    client.outputs(*NAMES, frequency=frequency)
    client.start()
    sent = [step for step in range(1, 376) if client.session.publish(step)]
    assert sent == list(range(every, 376, every))


def test_input_recipes_count_up_from_one(client):
    ids = [client.inputs(f"input_int_register_{n}", "input_int_register_0")[1] for n in range(5)]
    assert ids == [1, 2, 3, 4, 5]


def test_255_input_recipes_fit_and_no_more(client):
    ids = [client.inputs("input_int_register_0")[1] for _ in range(256)]
    assert ids == [*range(1, 256), 0]


def test_an_input_of_another_client_is_in_use_until_it_leaves(cell, client):
    other = Client(cell, number=2)
    other.agree()
    assert client.inputs("input_int_register_0")[1] == 1
    asked = ("input_int_register_1", "input_int_register_0")
    assert other.inputs(*asked) == (("INT32", "IN_USE"), 0)
    client.session.close()
    assert other.inputs(*asked) == (("INT32", "INT32"), 1)


def test_a_refused_recipe_takes_nothing(cell, client):
    other = Client(cell, number=2)
    client.inputs("input_int_register_0")
    other.inputs("input_int_register_1", "input_int_register_0")
    assert client.inputs("input_int_register_1")[1] == 2


def test_registers_of_a_fieldbus_are_in_use(cell, client):
    cell.box.ownership.claim(["input_double_register_0"], FIELDBUS)
    assert client.inputs("input_double_register_0") == (("IN_USE",), 0)


def test_an_unknown_input_is_not_found(client):
    assert client.inputs("timestamp") == (("NOT_FOUND",), 0)


def test_inputs_are_taken_without_start_or_outputs(cell, client):
    client.inputs("input_int_register_0")
    client.send(42)
    cell.run()
    assert cell.box.registers.inputs.integers[0] == 42
    assert client.session.commands == 1


def test_inputs_travel_for_their_delay(cell):
    client = Client(cell, delay=9 * MS)
    client.agree()
    client.inputs("input_int_register_0")
    client.send(42, t=0)
    cell.run(2)
    assert cell.box.registers.inputs.integers[0] == 0
    cell.run()
    assert cell.box.registers.inputs.integers[0] == 42


def test_a_package_cannot_overtake_the_one_before(cell):
    client = Client(cell)
    client.session = RtdeSession(cell.arm, 1, iter((5 * MS, 0)))
    client.agree()
    client.inputs("input_int_register_0")
    client.send(1)
    client.send(2)
    cell.run(2)
    assert cell.box.registers.inputs.integers[0] == 2


def test_values_stay_when_their_client_leaves(cell, client):
    client.inputs("input_int_register_0")
    client.send(42)
    client.session.close()
    cell.run()
    assert cell.box.registers.inputs.integers[0] == 42


@pytest.mark.parametrize(
    "body", [b"", b"\x01", b"\x01" + bytes(3), b"\x01" + bytes(5), b"\x02" + bytes(4)]
)
def test_a_bad_data_package_is_discarded_whole_and_logged(cell, client, body):
    client.inputs("input_int_register_0")
    client.send(7)
    assert client.session.receive(encode(PackageType.DATA, body), 0) == b""
    cell.run()
    assert cell.box.registers.inputs.integers[0] == 7
    assert client.session.commands == 1
    assert "data package" in cell.log


def test_a_started_client_is_told_of_a_discarded_package(client):
    client.outputs(*NAMES)
    client.start()
    reply = client.send(1, recipe=9)
    (package,) = Cutter().feed(reply)
    assert package.type == PackageType.TEXT_MESSAGE
    assert "unknown input recipe 09" in decode_text(package.payload).message


def conversation():
    setup = encode(PackageType.REQUEST_PROTOCOL_VERSION, encode_protocol_version(2))
    setup += encode(PackageType.SETUP_OUTPUTS, encode_names(NAMES, 125.0))
    setup += encode(PackageType.SETUP_INPUTS, encode_names(("input_int_register_0",)))
    return setup + encode(PackageType.START) + encode(PackageType.DATA, b"\x01\0\0\0\x05")


def test_bytes_one_at_a_time_mean_the_same(make_cell):
    whole, piecewise = Client(make_cell()).session, Client(make_cell()).session
    expected = whole.receive(conversation(), 0)
    found = b"".join(piecewise.receive(bytes((byte,)), 0) for byte in conversation())
    assert found == expected
    assert piecewise.commands == whole.commands == 1


def test_trailing_bytes_wait_for_their_package(make_cell):
    session = Client(make_cell()).session
    head = encode(PackageType.GET_CONTROLLER_VERSION)
    assert session.receive(conversation() + head[:2], 0)
    assert session.receive(head[2:], 0)[2] == PackageType.GET_CONTROLLER_VERSION


@given(data=st.binary(max_size=300))
@settings(max_examples=200, deadline=None)
def test_garbage_raises_nothing_but_wire_errors(shared_arm, data):
    session = RtdeSession(shared_arm, 1, repeat(0))
    with suppress(WireError):
        session.receive(conversation() + data, 0)
    session.close()


@given(kind=st.sampled_from(PackageType), payload=st.binary(max_size=80))
@settings(max_examples=200, deadline=None)
def test_well_framed_garbage_raises_nothing_but_wire_errors(shared_arm, kind, payload):
    session = RtdeSession(shared_arm, 1, repeat(0))
    with suppress(WireError):
        session.receive(conversation() + encode(kind, payload), 0)
    session.publish(1)
    session.close()


def test_a_request_for_more_types_than_a_package_holds_ends_the_session(client):
    names = encode_names(["a"] * 1000, 125.0)
    with pytest.raises(WireError, match="allowed are"):
        client.session.receive(encode(PackageType.SETUP_OUTPUTS, names), 0)


@pytest.fixture(scope="module")
def shared_arm():
    """One arm for many examples: what garbage leaves in its registers does not matter."""
    return ArmController(Robot(), np.random.default_rng(1))
