"""Robot, safety and program state: what follows what, and when."""

import pytest
from hypothesis import given
from hypothesis import strategies as st

from drivers.protocol.rtde_states import RobotMode, RuntimeState, SafetyMode
from hil.cell.arm.modes import (
    BOOT_TIME,
    BRAKE_TIME,
    PROGRAM,
    ROBOT,
    SAFETY,
    UNLOCK_DELAY,
    Event,
    Modes,
)


@pytest.fixture
def modes():
    return Modes()


@pytest.fixture
def running(modes):
    modes.post(Event.BRAKE_RELEASE, 0)
    modes.advance(BOOT_TIME + BRAKE_TIME)
    return modes


def test_the_box_wakes_without_power(modes):
    assert (modes.robot, modes.safety, modes.program) == (
        RobotMode.POWER_OFF,
        SafetyMode.NORMAL,
        RuntimeState.STOPPED,
    )
    assert modes.robot_bits == 0


def test_power_on_boots_to_idle_and_waits_there(modes):
    modes.post(Event.POWER_ON, 0)
    modes.advance(BOOT_TIME - 1)
    assert modes.robot is RobotMode.BOOTING
    modes.advance(BOOT_TIME)
    assert modes.robot is RobotMode.IDLE
    modes.advance(100 * BOOT_TIME)
    assert modes.robot is RobotMode.IDLE


def test_brakes_open_after_their_time(modes):
    modes.post(Event.POWER_ON, 0)
    modes.advance(BOOT_TIME)
    modes.post(Event.BRAKE_RELEASE, 2 * BOOT_TIME)
    modes.advance(2 * BOOT_TIME + BRAKE_TIME - 1)
    assert not modes.moving
    modes.advance(2 * BOOT_TIME + BRAKE_TIME)
    assert modes.moving


def test_brake_release_without_power_powers_on_first(running):
    assert running.robot is RobotMode.RUNNING


def test_a_second_brake_release_does_not_delay_the_first(modes):
    modes.post(Event.BRAKE_RELEASE, 0)
    modes.advance(BOOT_TIME)
    modes.post(Event.BRAKE_RELEASE, BOOT_TIME + BRAKE_TIME // 2)
    modes.advance(BOOT_TIME + BRAKE_TIME)
    assert modes.robot is RobotMode.RUNNING


def test_power_off_forgets_a_boot_under_way(modes):
    modes.post(Event.POWER_ON, 0)
    modes.post(Event.POWER_OFF, 1)
    modes.advance(10 * BOOT_TIME)
    assert modes.robot is RobotMode.POWER_OFF


def test_a_protective_stop_ends_the_program_and_keeps_power(running):
    running.post(Event.START, 1)
    assert running.robot_bits == 0b11
    running.post(Event.PROTECTIVE_STOP, 2)
    assert running.program is RuntimeState.STOPPED
    assert running.robot is RobotMode.RUNNING
    assert not running.moving
    assert running.safety_bits == 1 << 2 | 1 << 10


def test_a_protective_stop_unlocks_after_five_seconds(running):
    running.post(Event.PROTECTIVE_STOP, 7)
    assert not running.unlockable(7 + UNLOCK_DELAY - 1)
    assert running.unlockable(7 + UNLOCK_DELAY)
    running.post(Event.UNLOCK, 7 + UNLOCK_DELAY)
    assert running.moving


def test_a_second_protective_stop_does_not_restart_the_wait(running):
    running.post(Event.PROTECTIVE_STOP, 0)
    running.post(Event.PROTECTIVE_STOP, UNLOCK_DELAY - 1)
    assert running.unlockable(UNLOCK_DELAY)


def test_an_emergency_stop_takes_the_power_and_blocks_it(running):
    running.post(Event.EMERGENCY_STOP, 0)
    assert running.safety is SafetyMode.ROBOT_EMERGENCY_STOP
    assert not running.post(Event.POWER_ON, 1)
    running.post(Event.EMERGENCY_RESET, 2)
    assert running.post(Event.POWER_ON, 3)


def test_a_program_starts_only_with_brakes_open(modes):
    assert not modes.post(Event.START, 0)
    assert modes.program is RuntimeState.STOPPED


def test_restart_safety_ends_without_power(running):
    running.post(Event.PROTECTIVE_STOP, 0)
    running.post(Event.RESTART_SAFETY, 1)
    assert (running.robot, running.safety) == (RobotMode.POWER_OFF, SafetyMode.NORMAL)


@given(st.lists(st.tuples(st.sampled_from(Event), st.integers(0, 3_000_000_000)), max_size=40))
def test_no_order_of_events_moves_an_unsafe_or_braked_arm(events):
    modes, t = Modes(), 0
    for event, wait in events:
        t += wait
        modes.advance(t)
        modes.post(event, t)
        if modes.program is RuntimeState.PLAYING:
            assert modes.moving
        if modes.safety is not SafetyMode.NORMAL:
            assert not modes.moving


@pytest.mark.parametrize("table", [ROBOT, SAFETY, PROGRAM])
def test_tables_lead_only_to_states_of_their_own_machine(table):
    kinds = {type(state) for state, _ in table} | {type(state) for state in table.values()}
    assert len(kinds) == 1
