"""Our driver and its URScript against the emulated control box, in lockstep over real sockets."""

from itertools import pairwise

import pytest

from drivers.errors import ProtectiveStopError, RecipeError, RobotStateError
from drivers.interfaces import SafetyMode
from drivers.ur.connection import RtdeConnection


@pytest.fixture
def arm(emulated):
    with emulated.driver() as arm:
        yield arm


def moved(pose, dx):
    return (pose[0] + dx, *pose[1:])


def walk(arm, periods, step):
    """Set-points along x, `step` metres a period; the states read, one command left on the wire."""
    start = arm.read().pose
    states = []
    for k in range(periods):
        arm.servo(moved(start, step * (k + 1)))
        states.append(arm.read())
    arm.hold()
    return states


def hold(arm, periods):
    """The last state of so many periods of holding."""
    for _ in range(periods):
        state = arm.read()
        arm.hold()
    return state


def read_on(arm, packages):
    """Read without a command, at most so many packages."""
    for _ in range(packages):
        arm.read()


def test_connect_brings_a_cold_arm_to_where_it_follows(arm, emulated):
    assert arm.period == emulated.period
    state = arm.read()
    assert state.program_running
    assert state.safety_mode is SafetyMode.NORMAL


def test_the_arm_follows_set_points(arm):
    start = arm.read().pose
    arm.hold()
    walk(arm, 50, 1e-4)
    assert hold(arm, 10).pose == pytest.approx(moved(start, 50e-4), abs=1e-9)


def test_every_command_is_one_period(arm, emulated):
    times = [state.t for state in walk(arm, 20, 1e-5)]
    assert [b - a for a, b in pairwise(times)] == [emulated.period] * 19


def test_stop_brakes_and_the_program_goes_on(arm):
    walk(arm, 30, 1e-4)
    arm.read()
    arm.stop()
    before = hold(arm, 200).pose
    after = walk(arm, 20, 1e-4)[-1]
    assert after.pose[0] > before[0] + 10e-4


def test_a_leap_is_a_protective_stop_that_only_recover_releases(arm, emulated):
    start = arm.read().pose
    arm.servo(moved(start, 0.3))
    with pytest.raises(ProtectiveStopError):
        hold(arm, 5)
    stopped = emulated.t
    state = arm.recover()
    assert emulated.t - stopped > 5_000_000_000  # the controller's own waiting time
    assert state.safety_mode is SafetyMode.NORMAL
    assert state.pose == pytest.approx(start, abs=1e-3)
    assert len(walk(arm, 10, 1e-4)) == 10


def test_the_program_stops_the_arm_when_commands_fall_silent(arm, emulated):
    walk(arm, 10, 1e-4)
    port = emulated.server.ports["rtde"]
    other = RtdeConnection("127.0.0.1", port, ("timestamp",), ("input_int_register_0",), 20.0)
    other.open()
    periods = int(0.3e9) // emulated.period
    for k in range(periods):  # somebody else keeps the cell going
        other.put(other.pack((k,)))
        other.read_newest()
    other.close()
    with pytest.raises(RobotStateError, match="fell silent"):
        read_on(arm, periods)
    assert any("no fresh command for 200 ms" in text for _, text in emulated.controller.log)


def test_a_second_driver_is_told_what_is_in_use(arm, emulated):
    with (
        pytest.raises(RecipeError, match=r"owns input_int_register_24, input_int_register_25"),
        emulated.driver(),
    ):
        pass
    arm.read()


def test_connect_works_again_after_close(arm):
    walk(arm, 5, 1e-4)
    arm.close()
    arm.connect()
    assert len(walk(arm, 5, 1e-4)) == 5


def test_an_output_is_seen_in_the_next_packages(arm):
    arm.read()
    arm.set_output(3, True)
    arm.hold()
    arm.read()
    arm.hold()
    assert arm.read().outputs & 0b1000


def test_two_runs_are_the_same_to_the_bit(emulated_arm):
    def run():
        cell = emulated_arm()
        with cell.running(cell.lockstep):
            with cell.driver() as arm:
                states = walk(arm, 100, 7e-5)
            return states, cell.sent

    assert run() == run()
