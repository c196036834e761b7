"""Delays of valve and grip sensor."""

from hypothesis import given
from hypothesis import strategies as st

from hil.cell.arm.jaws import DelayedSwitch, Jaws
from hil.cell.rig.robot import Jaws as JawsSection

MS = 1_000_000


def jaws():
    return Jaws(JawsSection(output=2, close_delay="80 ms", open_delay="60 ms", sense_delay="20 ms"))


def test_jaws_close_after_the_valve_delay():
    pair = jaws()
    pair.drive(0b100, 0)
    pair.drive(0b100, 80 * MS - 1)
    assert not pair.closed
    assert pair.drive(0b100, 80 * MS)
    assert pair.closed


def test_closing_is_told_once():
    pair = jaws()
    told = [pair.drive(0b100, t * MS) for t in range(0, 200, 8)]
    assert sum(told) == 1


def test_jaws_open_after_their_own_delay():
    pair = jaws()
    for t in (0, 80):
        pair.drive(0b100, t * MS)
    pair.drive(0, 100 * MS)
    pair.drive(0, 159 * MS)
    assert pair.closed
    pair.drive(0, 160 * MS)
    assert not pair.closed


def test_another_output_does_not_move_the_jaws():
    pair = jaws()
    for t in (0, 500):
        pair.drive(0b1011, t * MS)
    assert not pair.closed


def test_a_command_taken_back_in_time_has_no_effect():
    pair = jaws()
    pair.drive(0b100, 0)
    pair.drive(0, 79 * MS)
    pair.drive(0b100, 80 * MS)
    assert not pair.closed


def test_the_sensor_tells_a_part_after_its_delay():
    pair = jaws()
    assert [pair.sense(True, t * MS) for t in (0, 19, 20)] == [False, False, True]


@given(st.lists(st.booleans(), min_size=1, max_size=60), st.integers(1, 9), st.integers(1, 9))
def test_a_switch_changes_only_after_its_input_stood_for_the_delay(inputs, rise, fall):
    switch = DelayedSwitch(rise * 1e-3, fall * 1e-3)
    states = [switch.update(on, n * MS) for n, on in enumerate(inputs)]
    for n in range(1, len(states)):
        if states[n] != states[n - 1]:
            delay = rise if states[n] else fall
            assert all(on == states[n] for on in inputs[n - delay : n + 1])
