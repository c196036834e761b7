"""The arm driver on real sockets against a robot of few words."""

import math

import pytest

from drivers.errors import (
    LinkError,
    LinkTimeoutError,
    ProtectiveStopError,
    ProtocolError,
    RecipeError,
    RobotStateError,
)
from drivers.interfaces import RobotMode, SafetyMode
from drivers.protocol.rtde import IN_USE, NOT_FOUND, PackageType, encode
from drivers.protocol.rtde_setup import ControllerVersion, TextMessage, encode_text
from drivers.ur.arm import UrArm, UrPorts
from drivers.ur.program import Command
from drivers.ur.sample import INPUTS

POSE = (0.41, -0.1, 0.2, 0.0, 3.1, 0.0)


def _package(robot, **changes):
    """What the robot would say, but for some values."""
    names = {"t": 0, "q": 1, "pose": 2, "twist": 4}
    values = list(robot.values())
    for name, value in changes.items():
        values[names[name]] = value
    return encode(PackageType.DATA, b"\x01" + robot.out_recipe.pack(values))


@pytest.fixture
def arm(served):
    arm = UrArm("127.0.0.1", served.ports)
    yield arm
    arm.close()


@pytest.fixture
def connected(arm):
    arm.connect()
    arm.read()
    return arm


def test_connect_powers_on_releases_brakes_and_starts_the_program(arm, robot):
    state = arm.connect()
    assert robot.dashboard_lines == ["power on", "brake release"]
    assert len(robot.scripts) == 1
    assert (state.robot_mode, state.safety_mode) == (RobotMode.RUNNING, SafetyMode.NORMAL)
    assert state.program_running


def test_connect_leaves_a_running_robot_its_power(arm, robot):
    robot.robot_mode = 7
    arm.connect()
    assert robot.dashboard_lines == []


def test_no_set_point_is_sent_before_the_caller_sends_one(arm, robot):
    arm.connect()
    arm.read()
    assert Command.SERVO not in {command[0] for command in robot.commands}


def test_every_command_has_a_new_sequence_number(connected, robot):
    connected.servo(POSE)
    connected.read()
    numbers = [command[1] for command in robot.commands[1:]]
    assert numbers == list(range(numbers[0], numbers[0] + len(numbers)))


def test_an_echo_left_by_an_earlier_program_is_not_taken_for_a_start(arm, robot):
    robot.starts_programs = False
    robot.runtime_state, robot.program = 1, 1
    with pytest.raises(RobotStateError, match="did not start within 5 s"):
        arm.connect()


def test_the_start_is_limited_in_controller_time(arm, robot):
    robot.starts_programs = False
    with pytest.raises(RobotStateError):
        arm.connect()
    assert 105.0 < robot.t < 106.0


def test_no_leave_is_on_its_way_when_the_program_starts(arm, robot):
    before_upload = []
    robot.script = lambda text: (before_upload.extend(robot.commands), robot.start())
    arm.connect()
    quiet = round(0.1 / robot.period)
    assert {command[0] for command in before_upload[-quiet:]} == {Command.HOLD}


def test_a_foreign_program_is_not_replaced(arm, robot):
    robot.robot_mode, robot.runtime_state = 7, 4
    with pytest.raises(RobotStateError, match="another program"):
        arm.connect()
    assert robot.scripts == []


def test_servo_moves_the_robot_and_returns_what_it_sent(connected):
    assert connected.servo(POSE) == POSE
    assert connected.read().pose == POSE


@pytest.mark.parametrize("bad", [math.nan, math.inf, -math.inf])
@pytest.mark.parametrize("axis", range(6))
def test_a_set_point_that_is_not_finite_is_never_sent(connected, robot, bad, axis):
    sent = len(robot.commands)
    with pytest.raises(ValueError, match="finite"):
        connected.servo((*POSE[:axis], bad, *POSE[axis + 1 :]))
    connected.hold()
    connected.read()
    assert len(robot.commands) == sent + 1


def test_a_command_names_the_programs_cycle_that_it_answers(connected, robot):
    cycles = []
    for _ in range(3):
        cycles.append(robot.cycle)
        connected.hold()
        connected.read()
    assert [command[10] for command in robot.commands[-3:]] == cycles


def test_hold_repeats_the_last_set_point(connected, robot):
    connected.servo(POSE)
    connected.read()
    assert connected.hold() == POSE
    connected.read()
    assert robot.commands[-1][0] == Command.SERVO
    assert robot.commands[-1][2:8] == POSE


def test_hold_without_a_set_point_stands_at_the_actual_pose(connected, robot):
    assert connected.hold() == robot.pose
    connected.read()
    assert robot.commands[-1][0] == Command.HOLD


def unheard(robot):
    """From here on commands let time pass, and nothing answers them."""
    robot.deaf = True


def exchanges(arm, count, command):
    for _ in range(count):
        command()
        arm.read()


def test_an_arm_that_no_longer_answers_is_noticed_and_stopped_over_the_dashboard(connected, robot):
    exchanges(connected, 5, connected.hold)
    unheard(robot)
    exchanges(connected, 37, connected.hold)  # 0.3 s of controller time, the default
    with pytest.raises(LinkError, match=r"answered no command for 0\.3 s"):
        exchanges(connected, 1, connected.hold)
    assert robot.dashboard_lines[-1] == "stop"


def test_a_program_answers_nothing_while_it_brakes_and_again_once_the_arm_stands(connected, robot):
    robot.twist = (0.1, 0.0, 0.0, 0.0, 0.0, 0.0)
    connected.stop()
    unheard(robot)
    connected.read()
    exchanges(connected, 100, connected.hold)
    robot.twist = (0.0,) * 6
    exchanges(connected, 37, connected.hold)
    with pytest.raises(LinkError, match="answered no command"):
        exchanges(connected, 2, connected.hold)


def test_stop_forgets_the_set_point(connected, robot):
    connected.servo(POSE)
    connected.read()
    connected.stop()
    connected.read()
    assert robot.commands[-1][0] == Command.STOP
    connected.hold()
    connected.read()
    assert robot.commands[-1][0] == Command.HOLD


def test_an_output_goes_with_the_next_command_and_stays(connected, robot):
    connected.set_output(2, True)
    connected.set_output(5, False)
    for _ in range(2):
        connected.hold()
        connected.read()
        assert robot.commands[-1][8:10] == (0b100100, 0b100)


@pytest.mark.parametrize("bit", [-1, 8])
def test_an_output_that_does_not_exist_is_the_callers_error(connected, bit):
    with pytest.raises(ValueError, match=r"0\.\.7"):
        connected.set_output(bit, True)


@pytest.mark.parametrize("k", [1, 3, 12345, 987654321])
def test_controller_time_is_exact_in_nanoseconds(arm, robot, k):
    robot.t = k * 0.008 + 1000.0
    arm.connect()
    arm.read()
    robot.t = (k + 100) * 0.008 + 1000.0
    arm.hold()
    assert arm.read().t == (k + 101) * 8_000_000 + 1_000_000_000_000


def test_time_that_goes_back_is_a_link_error(connected, robot):
    robot.t -= 1.0
    connected.hold()
    with pytest.raises(LinkError, match="went back"):
        connected.read()


def test_a_time_that_is_no_number_is_a_protocol_error(connected, robot):
    robot.t = math.nan
    connected.hold()
    with pytest.raises(ProtocolError, match="nan"):
        connected.read()


def test_the_newest_of_several_packages_is_read(connected, robot):
    robot.extra = _package(robot, t=robot.t - 0.1)
    connected.hold()
    assert connected.read().t == round(robot.t * 1e9)


@pytest.mark.parametrize("back", [0.0, 0.008, 0.4])
def test_a_package_that_is_late_or_repeated_is_discarded(connected, robot, back):
    robot.extra = _package(robot, t=robot.t - back)
    connected.hold()
    state = connected.read()
    assert state.t == round(robot.t * 1e9)
    assert state.pose == robot.pose
    assert connected.discarded == 1


@pytest.mark.parametrize("back", [0.0, 0.008, 0.4])
def test_a_late_package_behind_the_newest_does_not_displace_it(connected, robot, back):
    robot.after = lambda: _package(robot, t=robot.t - back)
    for _ in range(5):
        connected.hold()
        state = connected.read()
        assert state.pose == robot.pose
    connected.hold()
    assert connected.read().t > state.t


@pytest.mark.parametrize(
    "changes",
    [
        {"pose": (0.4, -0.1, math.nan, 0.0, 3.1, 0.0)},
        {"q": (0.0, math.inf, 0.0, 0.0, 0.0, 0.0)},
        {"twist": (math.nan,) * 6},
        {"pose": (0.4, -0.1, 1e6, 0.0, 3.1, 0.0)},
        {"pose": (0.4, -0.1, 0.9, 0.0, 3.1, 0.0)},
        {"q": (0.0, 0.0, 0.5, 0.0, 0.0, 0.0)},
        {"q": (0.0, 0.0, 50.0, 0.0, 0.0, 0.0)},
        {"t": 1e6},
    ],
)
def test_a_package_that_cannot_be_true_is_an_error_and_not_used(connected, robot, changes):
    sound = robot.pose
    robot.after = lambda: _package(robot, **({"t": robot.t + 1e-3} | changes))
    connected.hold()
    with pytest.raises(ProtocolError, match="controller"):
        connected.read()
    robot.after = lambda: b""
    connected.stop()
    assert connected.read().pose == sound
    assert robot.commands[-1][2:8] == sound


@pytest.mark.parametrize(
    ("change", "error", "words"),
    [
        ({"safety_mode": 3}, ProtectiveStopError, r"recover\(\)"),
        ({"safety_mode": 6}, RobotStateError, "SYSTEM_EMERGENCY_STOP"),
        ({"safety_mode": 11}, RobotStateError, "safety mode is 11"),
        ({"robot_mode": 3}, RobotStateError, "POWER_OFF"),
        ({"runtime_state": 1}, RobotStateError, "runtime state STOPPED"),
        ({"runtime_state": 1, "program": 3}, RobotStateError, "fell silent"),
    ],
)
def test_a_robot_that_does_not_follow_is_an_error(connected, robot, change, error, words):
    for name, value in change.items():
        setattr(robot, name, value)
    connected.hold()
    with pytest.raises(error, match=words):
        connected.read()


def test_an_error_carries_what_the_controller_said(connected, robot):
    said = TextMessage("C153A6: position deviates", "safety", 1)
    robot.extra = encode(PackageType.TEXT_MESSAGE, encode_text(said))
    robot.safety_mode = 3
    connected.hold()
    with pytest.raises(ProtectiveStopError) as caught:
        connected.read()
    assert caught.value.__notes__ == ["controller: C153A6: position deviates"]


def test_recover_waits_out_the_controllers_refusals(connected, robot):
    robot.safety_mode, robot.runtime_state, robot.refusals = 3, 1, 2
    connected.hold()
    with pytest.raises(ProtectiveStopError):
        connected.read()
    stopped = robot.t
    state = connected.recover()
    assert state.safety_mode == SafetyMode.NORMAL
    assert robot.t - stopped > 2 * 0.5
    assert len(robot.scripts) == 2
    connected.read()
    connected.servo(POSE)
    assert connected.read().pose == POSE


def test_recover_ends_a_program_that_the_stop_left_paused(connected, robot):
    robot.safety_mode, robot.runtime_state = 3, 4
    connected.hold()
    with pytest.raises(ProtectiveStopError):
        connected.read()
    assert connected.recover().program_running
    assert robot.dashboard_lines[-2:] == ["unlock protective stop", "stop"]


def test_nothing_releases_a_protective_stop_by_itself(arm, robot):
    robot.safety_mode = 3
    with pytest.raises(ProtectiveStopError):
        arm.connect()
    assert "unlock protective stop" not in robot.dashboard_lines


def test_close_ends_the_program(connected, robot):
    connected.close()
    assert (robot.runtime_state, robot.program) == (1, 0)


def test_a_closed_arm_says_so(connected):
    connected.close()
    with pytest.raises(LinkError, match="connect"):
        connected.read()


def test_connect_works_again_after_close(connected, robot):
    connected.close()
    assert connected.connect().program_running
    assert len(robot.scripts) == 2


@pytest.mark.parametrize(("verdict", "words"), [(NOT_FOUND, "does not know"), (IN_USE, "owns")])
@pytest.mark.parametrize("field", ["input_int_register_25", "actual_TCP_pose"])
def test_a_refused_field_is_named(arm, robot, verdict, words, field):
    robot.verdicts = {field: verdict}
    with pytest.raises(RecipeError, match=f"{words}.*{field}"):
        arm.connect()


@pytest.mark.parametrize("refusal", ["protocol_accepted", "start_accepted"])
def test_a_refused_handshake_is_a_protocol_error(arm, robot, refusal):
    setattr(robot, refusal, False)
    with pytest.raises(ProtocolError, match="refuses"):
        arm.connect()


def test_the_rate_is_the_controllers(arm, robot):
    robot.version, robot.period = ControllerVersion(5, 11, 0, 108249), 0.002
    arm.connect()
    assert (arm.period, robot.frequency) == (2_000_000, 500.0)


def test_a_caller_built_for_another_rate_is_refused(served):
    with (
        pytest.raises(RobotStateError, match=r"125 Hz.*500 Hz"),
        UrArm("127.0.0.1", served.ports, rate=500),
    ):
        pass


def test_the_period_is_unknown_before_connect():
    with pytest.raises(LinkError, match="once connected"):
        _ = UrArm("127.0.0.1").period


def test_a_tap_hears_each_package_as_it_was_on_the_wire(served, robot):
    heard = []
    with UrArm("127.0.0.1", served.ports, tap=lambda *entry: heard.append(entry)) as arm:
        arm.read()
        heard.clear()
        arm.servo(POSE)
        t = arm.read().t
    command, package = heard[:2]
    values = robot.in_recipe.unpack(command[2][4:])
    assert (command[1], values[0], values[2:8]) == (True, Command.SERVO, POSE)
    assert package[:2] == (t, False)
    assert robot.out_recipe.unpack(package[2][4:])[2] == POSE


def test_a_refused_port_is_one_line_with_the_address(served):
    ports = served.ports
    closed = UrPorts(rtde=1, dashboard=ports.dashboard, script=ports.script)
    with pytest.raises(LinkError, match=r"RTDE at 127\.0\.0\.1:1 refused; check") as caught:
        UrArm("127.0.0.1", closed).connect()
    assert "\n" not in str(caught.value)


def test_an_arm_that_turns_clients_away_is_asked_again(arm, robot):
    robot.turns_away = 2
    arm.connect()
    assert robot.clients == 3
    assert arm.read().program_running


def test_an_arm_that_goes_on_turning_clients_away_is_given_up(served, robot):
    robot.turns_away = 10
    arm = UrArm("127.0.0.1", served.ports, tries=2)
    with pytest.raises(LinkError, match=r"cut|closed") as caught:
        arm.connect()
    assert caught.value.__notes__ == ["2 attempts"]
    assert robot.clients == 2
    assert not robot.commands


def test_a_cut_link_is_a_link_error(connected, served):
    served.cut()
    with pytest.raises(LinkError, match=r"cut|closed"):
        connected.read()


def test_a_dead_link_does_not_stop_close(connected, served):
    served.cut()
    connected.close()


def test_silence_is_a_timeout(served, robot):
    arm = UrArm("127.0.0.1", served.ports, limit=0.2)
    arm.connect()
    arm.read()
    robot.silent = True
    arm.hold()
    with pytest.raises(LinkTimeoutError, match=r"nothing for 0\.2 s"):
        arm.read()
    arm.close()


def test_a_package_of_another_size_is_a_protocol_error(connected, robot):
    robot.extra = b""
    robot.out_recipe = robot.in_recipe
    robot.values = lambda: (0,) * len(INPUTS)
    connected.hold()
    with pytest.raises(ProtocolError, match="the recipe has"):
        connected.read()


def test_bytes_that_are_no_rtde_are_a_protocol_error(connected, robot):
    robot.extra = b"\x00\x00\x00"
    connected.hold()
    with pytest.raises(ProtocolError, match="0 bytes"):
        connected.read()
