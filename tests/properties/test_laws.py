"""Laws of the near side under faults, and for each a planted bug that breaks it."""

import math
from functools import partial

import numpy as np
import pytest
from hypothesis import HealthCheck, Phase, given, settings
from hypothesis import strategies as st

import drivers.nrs.session
from drivers.errors import DriverError
from drivers.nrs.assembler import Assembler
from drivers.nrs.session import Session
from drivers.protocol.nrs_can import FORCE_LSB, TORQUE_LSB, VALID, Identifiers
from drivers.protocol.nrs_sample import decode_pair, encode_pair
from drivers.protocol.nrs_status import Status, StatusBit, encode_status
from drivers.ur.program import Command, ProgramState, ServoProgram
from hil.cell.arm.controller import ArmController
from hil.cell.arm.modes import Event
from hil.cell.arm.pose import rotation_vector
from hil.cell.rig.robot import Robot
from hil.experiments.falsification.bugs import Bug
from hil.experiments.falsification.contact import robustness
from hil.experiments.falsification.study import slots
from hil.falsify.search import search
from hil_fixtures import strategies as hs
from hil_fixtures.testbed import shipped

LAW = settings(
    max_examples=15, deadline=None, derandomize=True, database=None, report_multiple_bugs=False,
    phases=[Phase.generate],  # that a planted bug is found is enough: no need to shrink it
    suppress_health_check=[HealthCheck.too_slow],
)  # fmt: skip
RIG = shipped("surface_ur5")


# A wrench is one that the node sent, whole: halves of two samples are never one.

IDS = Identifiers.of(1)
MS = 1_000_000
fates = st.lists(st.tuples(st.booleans(), st.booleans()), min_size=4, max_size=40)
"""Of each sample, whether its FORCE and its TORQUE frame arrive."""


def wrenches_of(fates):
    """What the driver makes of samples that name themselves in every axis."""
    session = Session(node=1, fd=False, period=MS, max_age=1000 * MS)
    session.start()
    status = encode_status(IDS, Status(StatusBit.TRANSMIT_ON, 25.0, 0, 0))
    session.take([(status.id, status.data, False)], 0)
    for number, arrives in enumerate(fates):
        pair = encode_pair(IDS, [number + 1] * 6, VALID, number)
        frames = [frame for frame, there in zip(pair, arrives, strict=True) if there]
        session.take([(frame.id, frame.data, False) for frame in frames], number * MS)
    try:
        return session.reading(len(fates) * MS).samples
    except DriverError:
        return ()


@LAW
@given(fates)
def wrenches_are_whole(fates):
    for fx, fy, fz, tx, ty, tz in wrenches_of(fates):
        counts = {round(f / FORCE_LSB) for f in (fx, fy, fz)}
        counts |= {round(t / TORQUE_LSB) for t in (tx, ty, tz)}
        assert len(counts) == 1


class LastOfEach(Assembler):
    """Joins the last FORCE frame with the last TORQUE frame, whatever their counters."""

    kept: dict = {}  # noqa: RUF012  one driver at a time in these tests

    def _join(self, is_force, octets, t):
        self.kept[is_force] = octets
        if len(self.kept) < 2 or is_force:
            return None
        force = self.kept[True][:6] + octets[6:]
        mask = (1 << 51) - 1
        head = int.from_bytes(self.kept[True], "little") & mask
        tail = int.from_bytes(octets, "little") & ~mask
        return decode_pair((head | tail).to_bytes(8, "little"), octets) if force else None


def test_no_wrench_is_made_of_two_samples():
    wrenches_are_whole()


def test_a_driver_that_pairs_the_last_of_each_frame_breaks_that_law(monkeypatch):
    monkeypatch.setattr(drivers.nrs.session, "Assembler", LastOfEach)
    with pytest.raises(AssertionError):
        wrenches_are_whole()


# When commands fall silent the robot stops by itself within its time, and says so.


class Robots:
    """An arm on an ideal plant that runs this text of the servo program."""

    def __init__(self, text):
        self.arm = ArmController(Robot(), np.random.default_rng(1))
        self.t = self.sequence = 0
        self.arm.box.post(Event.BRAKE_RELEASE)
        self.run(250)
        assert self.arm.upload(text)
        self.run(2)
        self.pose = self.tcp()

    def run(self, periods=1):
        for _ in range(periods):
            target = self.arm.frame(self.t)
            self.t += self.arm.box.period
            self.arm.observe(self.t, target.flange, (0.0,) * 6, (0.0,) * 6, False)
            self.flange = target.flange

    def tcp(self):
        return (*self.flange.position, *rotation_vector(self.flange.rotation))

    @property
    def cycle(self):
        return self.arm.box.registers.outputs.integers[26]

    def take(self, move, age=0, bent=0.0):
        """One period of a client whose command answers the cycle before `age` others.

        bent: what is added to its sum.
        """
        command = {"servo": Command.SERVO, "hold": Command.HOLD, "stop": Command.STOP}
        if move.word in command:
            x, y, z, *turn = self.pose
            way = move.step if move.word == "servo" else (0.0, 0.0, 0.0)
            self.pose = (x + way[0], y + way[1], z + way[2], *turn)
            self.sequence += 1
            values = {"input_int_register_24": int(command[move.word])}
            values["input_int_register_25"] = self.sequence
            values["input_int_register_26"] = self.cycle - age
            for axis, value in enumerate(self.pose):
                values[f"input_double_register_{24 + axis}"] = value
            values["input_double_register_30"] = sum(values.values()) + bent
            self.arm.accept(values, self.t)
        self.run()

    @property
    def state(self):
        return self.arm.box.registers.outputs.integers[25]


def stops_when_commands_fall_silent(text):
    @LAW
    @given(hs.command_streams(0.5e-3, max_size=30))
    def law(moves):
        robot = Robots(text)
        for move in moves:
            robot.take(move)
        robot.run(round(0.2 * 125) + 2 + 25)  # silence, detection, braking from 60 mm/s
        still = robot.tcp()
        robot.run(3)
        assert robot.tcp() == pytest.approx(still, abs=1e-9)
        assert robot.state in (ProgramState.SILENCE, ProgramState.ENDED)

    law()


PROGRAM = ServoProgram().text(125)


def test_an_arm_whose_commands_fall_silent_stops_and_says_so():
    stops_when_commands_fall_silent(PROGRAM)


def test_a_program_without_its_watchdog_breaks_that_law():
    sleeping = PROGRAM.replace("silent >= 25", "silent >= 1000000")
    assert sleeping != PROGRAM
    with pytest.raises(AssertionError):
        stops_when_commands_fall_silent(sleeping)


# An arm is led no faster than it may go, and by no command that comes late.

jumps = st.lists(st.tuples(*[st.floats(-6e-3, 6e-3)] * 3), min_size=3, max_size=8)


def leads_within_limits(text):
    @LAW
    @given(jumps)
    def law(jumps):
        robot = Robots(text)
        for way in jumps:
            before = robot.tcp()
            robot.take(hs.Move("servo", way))
            for _ in range(4):
                assert math.dist(robot.tcp()[:3], before[:3]) <= 1.05 * ServoProgram().step
                before = robot.tcp()
                robot.run()

    law()


def test_set_points_far_apart_lead_an_arm_no_faster_than_it_may_go():
    leads_within_limits(PROGRAM)


def test_a_program_that_goes_to_each_set_point_at_once_breaks_that_law():
    leaping = PROGRAM.replace("here = towards(target, here)", "here = target")
    assert leaping != PROGRAM
    with pytest.raises(AssertionError):
        leads_within_limits(leaping)


def moved(text, age=0, bent=0.0):
    """How far a command of this age, cycles, moves an arm that stood, m."""
    robot = Robots(text)
    robot.take(hs.Move("servo"))
    robot.run(15)
    before = robot.tcp()
    robot.take(hs.Move("servo", (1e-3, 0.0, 0.0)), age, bent)
    robot.run(3)
    return math.dist(robot.tcp()[:3], before[:3])


def test_a_command_half_as_old_as_the_silence_that_stops_an_arm_does_not_move_it():
    """One in a campaign moved the arm so late that it had not come to rest when it was too old."""
    late = round(0.2 * 125) // 2
    assert moved(PROGRAM, late - 1) > 0.5e-3
    assert moved(PROGRAM, late) == pytest.approx(0.0, abs=1e-9)
    assert moved(ServoProgram(silence=0.4).text(125), late) > 0.5e-3


def test_a_command_that_was_bent_on_its_way_does_not_move_an_arm():
    """One in a campaign led a held part away from its slot, against it with 140 N."""
    assert moved(PROGRAM, bent=2e-5) == pytest.approx(0.0, abs=1e-9)
    assert moved(PROGRAM, bent=1e-7) > 0.5e-3
    assert moved(PROGRAM.replace("< 0.00001", "< 1"), bent=2e-5) > 0.5e-3


# F1 for whatever contact and whatever the bus does.


def parts(axes):
    return st.one_of([hs.part_of(kind, axes[kind]) for kind in axes])


def true_force_stays_bounded(bug):
    @LAW
    @given(st.tuples(*map(parts, slots())))
    def law(case):
        assert robustness(RIG, case, bug, seed=1) >= 0.0

    law()


def test_the_true_force_is_over_its_bound_for_one_period_at_most_whatever_the_bus_does():
    true_force_stays_bounded(Bug.NONE)


@pytest.mark.parametrize(("bug", "seed"), [(Bug.FILLED, 1), (Bug.QUEUE, 2), (Bug.RETARE, 1)])
def test_a_planted_bug_breaks_that_law_and_a_search_finds_how(bug, seed):
    judge = partial(robustness, RIG, bug=bug, seed=seed)
    found = search(slots(), judge, budget=60, seed=seed)
    assert found.violated
    assert robustness(RIG, found.case, Bug.NONE, seed=seed) >= 0.0
