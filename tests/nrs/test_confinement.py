"""Error frames of the CAN controller: what they say, and how long a fault lasts."""

import pytest
from hypothesis import given
from hypothesis import strategies as st

from drivers.nrs.confinement import GOOD_FRAMES, Confinement
from drivers.protocol.can_error import BusState, ErrorFrame, decode_error

FAULTS = (BusState.PASSIVE, BusState.OFF)


# As the kernel of Linux 6.1 sends them through its slcan driver.
@pytest.mark.parametrize(
    ("kind", "status", "state"),
    [
        (0x204, 0x08, BusState.WARNING),
        (0x204, 0x20, BusState.PASSIVE),
        (0x204, 0x14, BusState.PASSIVE),
        (0x204, 0x40, BusState.ACTIVE),
        (0x040, 0x00, BusState.OFF),
        (0x100, 0x00, BusState.ACTIVE),
        (0x088, 0x00, None),
    ],
)
def test_error_frames_tell_the_controllers_state(kind, status, state):
    assert decode_error(kind, bytes([0, status, 0, 0, 0, 0, 0, 0])).state is state


def test_a_missing_acknowledge_names_what_to_check():
    assert "check termination" in decode_error(0x0A8, bytes(8)).text


def test_a_full_buffer_is_told_without_a_state():
    assert decode_error(0x004, bytes([0, 0x01])) == (
        None,
        "CAN controller lost frames: its buffer was full",
    )


@given(st.integers(0, 0x1FFFFFFF), st.binary(max_size=8))
def test_any_error_frame_can_be_read(kind, data):
    assert decode_error(kind, data).text


frames = st.one_of(
    st.builds(ErrorFrame, st.sampled_from([None, *BusState]), st.just("")), st.integers(0, 100)
)


def told(history):
    confinement = Confinement()
    for event in history:
        if isinstance(event, int):
            confinement.credit(event)
        else:
            confinement.hear(event)
    return confinement


@given(st.lists(frames))
def test_after_any_fault_it_takes_so_many_good_frames(history):
    last = max(
        (at for at, one in enumerate(history) if isinstance(one, ErrorFrame) and one[0] in FAULTS),
        default=None,
    )
    if last is None:
        assert told(history).fault == ""
    elif sum(one for one in history[last:] if isinstance(one, int)) < GOOD_FRAMES:
        assert told(history).fault


@given(st.lists(frames))
def test_a_controller_that_is_active_again_is_trusted_after_enough_frames(history):
    confinement = told([*history, ErrorFrame(BusState.ACTIVE, ""), GOOD_FRAMES])
    assert confinement.fault == ""
    assert confinement.state is BusState.ACTIVE


def test_an_error_passive_controller_hears_frames_and_stays_untrusted():
    assert told([ErrorFrame(BusState.PASSIVE, ""), 10 * GOOD_FRAMES]).fault == (
        "CAN controller is error-passive"
    )


def test_a_controller_that_hears_is_no_longer_off_the_bus():
    confinement = told([ErrorFrame(BusState.OFF, ""), 10])
    assert confinement.fault == f"CAN bus has carried 10 of {GOOD_FRAMES} frames since bus-off"
    assert confinement.state is BusState.ACTIVE


def test_a_warning_is_no_fault():
    confinement = told([ErrorFrame(BusState.WARNING, "")])
    assert (confinement.fault, confinement.state) == ("", BusState.WARNING)


def test_opening_anew_ends_error_passive_but_not_the_debt():
    confinement = told([ErrorFrame(BusState.PASSIVE, ""), 5])
    confinement.restart()
    assert confinement.fault
    confinement.credit(GOOD_FRAMES)
    assert confinement.fault == ""
