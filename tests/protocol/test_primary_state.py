"""Sub-packages of the robot state."""

import struct

import pytest
from hypothesis import given
from hypothesis import strategies as st

from drivers.protocol.errors import WireError
from drivers.protocol.primary import Cutter
from drivers.protocol.primary_state import (
    LAYOUTS,
    StateType,
    decode_state,
    encode_part,
    encode_state,
)

SIZES = {
    "ROBOT_MODE": 47, "JOINTS": 251, "TOOL": 37, "MASTERBOARD": 75, "CARTESIAN": 101,
    "KINEMATICS": 225, "CONFIGURATION": 445, "FORCE_MODE": 61, "ADDITIONAL": 9,
    "TOOL_COMMUNICATION": 26, "TOOL_MODE": 8,
}  # fmt: skip
"""As a capture of a controller has them."""


def body_of(package):
    (found,) = Cutter().feed(package)
    return found.body


def test_sizes_are_those_of_a_capture():
    assert {type.name: layout.size + 5 for type, layout in LAYOUTS.items()} == SIZES


@given(pose=st.tuples(*[st.floats(-9, 9)] * 12))
def test_a_state_survives_the_wire(pose):
    mode = (0, 1, 1)
    parts = (
        encode_part(StateType.CARTESIAN, pose),
        encode_part(StateType.TOOL_MODE, mode),
    )
    found = decode_state(body_of(encode_state(parts)))
    assert found == {StateType.CARTESIAN: pose, StateType.TOOL_MODE: mode}


def test_unknown_parts_and_new_fields_are_passed_over():
    longer = struct.pack(">iBBBBB", 9, StateType.TOOL_MODE, 1, 2, 3, 99)
    unknown = struct.pack(">iBd", 13, 77, 1.0)
    assert decode_state(unknown + longer) == {StateType.TOOL_MODE: (1, 2, 3)}


@pytest.mark.parametrize(
    ("body", "complaint"),
    [
        (b"\x00\x00", "ends within a header"),
        (struct.pack(">iB", 50, 0), "0 of 50 bytes, 5 are left"),
        (struct.pack(">iB", 5, StateType.TOOL_MODE), "TOOL_MODE of 0 bytes, needs 3"),
    ],
)
def test_a_state_that_cannot_be_cut_is_refused(body, complaint):
    with pytest.raises(WireError, match=complaint):
        decode_state(body)


@given(st.binary(max_size=120))
def test_garbage_raises_wire_errors_alone(body):
    try:
        assert set(decode_state(body)) <= set(StateType)
    except WireError:
        return
