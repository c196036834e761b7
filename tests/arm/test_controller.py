"""The control loop: program, limits, jaws, repeatability and what the box reports of them."""

import math

import numpy as np
import pytest

from drivers.protocol.rtde_states import RuntimeState, SafetyMode
from hil.cell.arm.modes import Event
from hil.cell.arm.pose import Pose
from hil.cell.errors import PlantError

SERVO = """def follow():
  while True:
    q = get_target_joint_positions()
    q[0] = q[0] + read_input_float_register(24)
    servoj(q, t=get_steptime(), lookahead_time=0.03)
  end
end
"""
ZERO6 = (0.0,) * 6


def step_of(cell, radians):
    """Ask the program for so many radians a cycle."""
    cell.arm.accept({"input_double_register_24": radians}, cell.t)


@pytest.fixture
def following(running):
    running.arm.upload(SERVO)
    running.run(2)
    assert running.box.modes.program is RuntimeState.PLAYING
    return running


def test_a_braked_arm_refuses_programs_and_says_why(cell):
    cell.arm.upload(SERVO)
    assert cell.box.modes.program is RuntimeState.STOPPED
    assert "robot POWER_OFF" in cell.log


def test_a_program_that_does_not_compile_is_logged(running):
    running.arm.upload("def broken(:\nend\n")
    assert running.box.modes.program is RuntimeState.STOPPED
    assert "program refused" in running.log


def test_a_program_error_ends_the_program(running):
    running.arm.upload("def late():\n  sync()\n  x = [1, 2]\n  y = x[7]\nend\n")
    running.run(5)
    assert running.box.modes.program is RuntimeState.STOPPED
    assert "program error" in running.log


def test_a_program_ends_by_itself(running):
    running.arm.upload('def brief():\n  textmsg("hello")\nend\n')
    running.run(3)
    assert running.box.modes.program is RuntimeState.STOPPED
    assert "hello" in running.log


def test_a_new_program_replaces_the_old_one(following):
    following.arm.upload(
        'def other():\n  textmsg("other")\n  while True:\n    sync()\n  end\nend\n'
    )
    following.run(3)
    step_of(following, 0.01)
    before = following.box.servo.q
    following.run(3)
    assert "other" in following.log
    assert following.box.servo.q == before


def test_a_secondary_program_leaves_the_primary_running(following):
    following.arm.upload("sec signal():\n  set_digital_out(3, True)\nend\n")
    following.run(2)
    assert following.box.signals.outputs >> 3 & 1
    assert following.box.modes.program is RuntimeState.PLAYING


def test_set_points_move_the_target_and_the_report_follows(following):
    step_of(following, 0.005)
    before = following.box.measured.q[0]
    following.run(10)
    assert following.box.measured.q[0] - before == pytest.approx(0.05, abs=1e-6)
    assert following.box.measured.qd[0] == pytest.approx(0.625, rel=1e-4)
    assert following.box.target.twist[5] == pytest.approx(0.625, rel=1e-6)


@pytest.mark.parametrize(
    ("step", "why"), [(0.06, "set-point jump"), (0.03, "joint speed"), (0.02, "TCP speed")]
)
def test_motion_beyond_a_limit_makes_a_protective_stop(following, step, why):
    step_of(following, step)
    following.run(1)
    box = following.box
    assert box.modes.safety is SafetyMode.PROTECTIVE_STOP
    assert f"protective stop: {why}" in following.log
    held = box.servo.q
    following.run(10)
    assert box.modes.program is RuntimeState.STOPPED
    assert box.servo.q == held


def test_a_set_point_that_is_not_finite_makes_a_protective_stop(running):
    running.arm.port.servo_q((float("nan"), *running.box.servo.q[1:]))
    target = running.run()
    assert running.box.modes.safety is SafetyMode.PROTECTIVE_STOP
    assert np.isfinite(target.q).all()


def test_the_report_follows_the_joints_through_a_stretched_arm(running):
    goal = (-1.54, -1.83, -2.28, -0.59, 1.60, 0.023)  # the elbow goes from 2.1 through 0
    running.arm.upload(f"movej({list(goal)})\n")
    for _ in range(800):
        running.run()
        assert running.box.measured.q == pytest.approx(running.box.servo.q, abs=1e-3)
    assert running.box.measured.q == pytest.approx(goal, abs=1e-6)


def test_a_tool_that_presses_too_hard_makes_a_protective_stop_from_which_the_arm_can_leave(running):
    press = (0.0, 0.0, 251.0, 0.0, 0.0, 0.0)

    def held(cycles):
        for _ in range(cycles):
            target = running.arm.frame(running.t)
            running.t += running.box.period
            running.arm.observe(running.t, target.flange, ZERO6, press, part_held=False)

    held(2)
    assert running.box.modes.safety is SafetyMode.PROTECTIVE_STOP
    assert "protective stop: TCP force 251 N, allowed is 250 N" in running.log
    held(700)  # 5 s and a little
    running.box.post(Event.UNLOCK)
    running.arm.upload(SERVO)
    held(2)
    assert running.box.modes.program is RuntimeState.PLAYING


def test_an_unlocked_arm_takes_a_new_program(following):
    step_of(following, 0.06)
    following.seconds(5.5)
    step_of(following, 0.0)
    following.box.post(Event.UNLOCK)
    following.arm.upload(SERVO)
    following.run(2)
    assert following.box.modes.program is RuntimeState.PLAYING


def test_silence_of_a_watched_input_stops_the_arm(running):
    running.arm.upload(
        'def watched():\n  rtde_set_watchdog("input_int_register_24", 10, "STOP")\n'
        "  while True:\n    sync()\n  end\nend\n"
    )
    running.run(3)
    for value in range(30):
        running.arm.accept({"input_int_register_24": value}, running.t)
        running.run()
    assert running.box.modes.safety is SafetyMode.NORMAL
    running.seconds(0.12)
    assert running.box.modes.safety is SafetyMode.PROTECTIVE_STOP
    assert "C207A0" in running.log


def test_outputs_follow_whether_a_program_runs(running):
    running.arm.upload(
        "def lamps():\n  set_runstate_standard_digital_output_to_value(4, 3)\n"
        "  set_runstate_standard_digital_output_to_value(5, 2)\n  sleep(0.1)\nend\n"
    )

    def lamps():
        return running.box.signals.outputs >> 4 & 3

    running.seconds(0.3)
    assert lamps() == 0b10  # stopped: 4 low, 5 high
    running.arm.upload("def next():\n  sleep(0.1)\nend\n")
    running.run(2)
    assert lamps() == 0b11
    running.seconds(0.3)
    assert lamps() == 0b10


def test_programs_draw_random_numbers_from_the_rigs_seed(make_cell):
    def drawn(seed):
        cell = make_cell(seed)
        return cell.arm.port.random(), cell.arm.port.random()

    assert drawn(4) == drawn(4) != drawn(5)


def test_flags_outlive_the_program_and_domains_show(running):
    running.arm.upload("def one():\n  set_flag(7, True)\n  set_analog_outputdomain(1, 0)\nend\n")
    running.run(3)
    running.arm.upload(
        'def two():\n  if get_flag(7) and not get_flag(8):\n    textmsg("kept")\n  end\nend\n'
    )
    running.run(3)
    assert "kept" in running.log
    assert running.box.signals.analog_types == 0b0111


def test_the_jaws_close_by_their_output_and_tell_a_part(running):
    running.box.signals.set_output(0, on=True)
    closed = [running.run().jaws_closed for _ in range(15)]
    assert closed.index(True) == 10  # 80 ms
    running.part_held = True
    running.run(5)
    assert running.box.signals.inputs & 1


def test_the_true_flange_is_off_the_reported_one_by_less_than_the_repeatability(running):
    target = running.run()
    off = np.subtract(target.flange.position, running.box.target.flange.position)
    assert 0 < np.abs(off).max() <= running.box.robot.repeatability
    assert running.box.measured.q == pytest.approx(running.box.servo.q, abs=1e-9)


def test_the_offset_stays_until_the_jaws_close(running):
    def off():
        return np.subtract(running.run().flange.position, running.box.target.flange.position)

    first = off()
    running.seconds(0.5)
    assert np.array_equal(off(), first)
    running.box.signals.set_output(0, on=True)
    running.seconds(0.2)
    second = off()
    assert not np.array_equal(second, first)
    running.box.signals.set_output(0, on=False)
    running.seconds(0.2)
    assert np.array_equal(off(), second)


def test_the_same_seed_gives_the_same_offset(make_cell):
    first, same, other = (make_cell(seed).run().flange for seed in (4, 4, 5))
    assert first == same
    assert first != other


def test_the_tcp_is_the_flange_moved_by_the_offset(running):
    running.arm.port.set_tcp((0.0, 0.0, 0.12, 0.0, 0.0, 0.0))
    flange, tcp = running.box.measured.flange, running.arm.port.actual_tcp_pose()
    axis = np.array(flange.rotation)[:, 2]
    assert np.allclose(tcp[:3], np.array(flange.position) + 0.12 * axis)
    q = running.arm.port.inverse_kin(tcp, None, None)
    assert q == pytest.approx(running.box.measured.q, abs=1e-9)


def test_an_arm_moved_out_of_its_reach_is_a_plant_error(running):
    far = Pose((3.0, 0.0, 0.0), running.box.measured.flange.rotation)
    with pytest.raises(PlantError, match="out of its reach"):
        running.arm.observe(running.t, far, ZERO6, ZERO6, part_held=False)


def test_an_arm_a_little_out_of_its_reach_stays_as_near_as_it_can(running):
    stretched = running.box.kinematics.forward((0.0, -1.2, 0.02, -1.5, -1.5, 0.3))
    running.arm.observe(running.t, stretched, ZERO6, ZERO6, part_held=False)
    x, y, z = stretched.position
    beyond = Pose((1.01 * x, 1.01 * y, 1.01 * z), stretched.rotation)
    running.arm.observe(running.t, beyond, ZERO6, ZERO6, part_held=False)
    reached = running.box.kinematics.forward(running.box.measured.q)
    assert math.dist(reached.position, beyond.position) < 0.02


def test_the_log_tells_when(running):
    running.box.say("now")
    assert running.arm.log[-1] == (running.t, "now")


def test_a_secondary_program_cannot_move_the_arm(following):
    before = following.box.servo.q
    following.arm.upload("sec push():\n  movej([0, 0, 0, 0, 0, 0])\nend\n")
    following.run(3)
    assert "line 2, column 3: a secondary program cannot move the robot" in following.log
    assert following.box.servo.q == before
    assert following.box.modes.program is RuntimeState.PLAYING


def test_software_refuses_the_builtins_that_came_later(running):
    running.arm.upload("def late():\n  optimovej([0, 0, 0, 0, 0, 0])\nend\n")
    assert "line 2, column 3: name not found: optimovej" in running.log


def test_two_threads_that_move_the_arm_end_the_program(running):
    running.arm.upload(
        "def both():\n  thread t():\n    movej([0, 0, 0, 0, 0, 0])\n  end\n  run t()\n"
        "  movej([0, -1, 0, 0, 0, 0])\nend\n"
    )
    running.run(3)
    assert "another thread is already controlling the robot" in running.log


def test_a_loop_without_robot_time_ends_the_program_with_its_place(running):
    running.arm.upload("def spin():\n  while True:\n    x = 1\n  end\nend\n")
    running.run(2)
    assert "program error: line 2, column 3: infinite loop" in running.log


def test_the_speed_slider_slows_paths_and_shows(running):
    goal = (*running.box.servo.q[:5], running.box.servo.q[5] + 0.5)

    def cycles(fraction):
        running.arm.accept({"speed_slider_mask": 1, "speed_slider_fraction": fraction}, running.t)
        home = running.box.servo.q
        running.arm.upload(f"def go():\n  movej({list(goal)})\n  movej({list(home)})\nend\n")
        count = 0
        while running.box.modes.program is RuntimeState.PLAYING:
            running.run()
            count += 1
        return count

    whole = cycles(1.0)
    assert cycles(0.5) == pytest.approx(2 * whole, abs=6)
    assert running.box.signals.speed_fraction == 0.5


def test_stopl_of_a_target_that_stands_ends_at_once_though_the_arm_still_moves(running):
    flange, twist = running.box.measured.flange, (0.05, 0.0, 0.0, 0.0, 0.0, 0.0)
    running.arm.upload('def stop():\n  stopl(10)\n  textmsg("stands")\nend\n')
    for _ in range(3):
        running.run()
        running.arm.observe(running.t, flange, twist, ZERO6, part_held=False)
    assert "stands" in running.log


@pytest.mark.parametrize("fraction", [1.0, 0.4])
@pytest.mark.parametrize(
    ("start", "move"),
    [
        ("[-1.5, -1.6, 1.6, -0.7, 0.7, 0.2]", "movej([1.5, -1.6, 1.6, -0.7, 0.7, 0.2], t=0.1)"),
        ("[-1.5, -1.6, 1.6, -0.7, 0.7, 0.2]", "movel(aside, t=0.05)"),
        ("[0.2, -1.4, 1.6, -1.7, -0.02, 0.3]", "movel(aside, a=4, v=0.9)"),
        ("[0.2, -0.1, 0.2, -0.1, -1.3, 0.3]", "movej([2.0, -0.1, 0.2, -0.1, -1.3, 0.3], v=3, a=9)"),
    ],
    ids=["too short a time", "too short a time on a line", "a turning wrist", "a far-out tool"],
)
def test_a_move_slows_down_rather_than_stop(running, start, move, fraction):
    running.arm.accept({"speed_slider_mask": 1, "speed_slider_fraction": fraction}, running.t)
    running.arm.upload(
        f"def go():\n  movej({start})\n  aside = get_target_tcp_pose()\n"
        f'  aside[1] = aside[1] + 0.1\n  {move}\n  textmsg("there")\nend\n'
    )
    running.seconds(15.0)
    assert "there" in running.log
    assert running.box.modes.safety is SafetyMode.NORMAL
