"""R8, R9, P1 to P4, H1 to H4: what cannot be noticed stays within the force bound."""

import re
import time
from functools import partial

from controller.guard import Guard
from controller.loop import Loop
from controller.settings import Insertion
from drivers.nrs.can_sensor import CanSensor
from drivers.ur.program import ServoProgram
from drivers.ur.sample import OUTPUTS
from hil.app import near
from hil.app.record import Lossy
from hil.recording.channel import Channel
from tests.safety.conftest import RIG, assembly, safe

NOW = time.time


def bound(patch):
    """A guard with ten times the force bound."""
    sound = Guard.__init__

    def init(self, limits, period):
        sound(self, limits.relaxed(10.0), period)

    patch.setattr(Guard, "__init__", init)


def bounded(trial):
    return trial.outcome is not None and trial.outcome.kind.value == "danger"


def test_a_pose_that_is_off_is_felt_and_the_force_stays_bounded(law):
    law.holds(
        bounded, bound, "R9", {"dx": 0.0, "dy": 0.0, "dz": 0.015}, at="phase: search", after=3
    )


def test_a_connector_that_moves_in_contact_is_felt_and_the_force_stays_bounded(law):
    law.holds(bounded, bound, "P1", {"dx": 0.01, "dy": 0.01}, at="phase: insert", after=3)


def test_a_stiffer_contact_is_felt_and_the_force_stays_bounded(law):
    law.holds(
        bounded, bound, "P2", {"stiffness": 6.0, "friction": 5.0}, at="phase: search", after=3
    )


def insisting(patch):
    """A part that is stuck is pushed however often it was."""
    patch.setattr(near, "Insertion", lambda **of: Insertion(**{**of, "jams": 10**6}))


def test_a_part_that_does_not_go_in_is_a_danger_after_so_many_times(law):
    def given_up(trial):
        return bounded(trial) and "stuck in the slot 2 times" in trial.reason

    task = RIG.task.model_copy(update={"on_jam": "draw out", "max_jams": 1})
    rig = RIG.model_copy(update={"task": task})
    law.holds(given_up, insisting, "P3", at="phase: search", after=1, rig=rig)


def test_a_slot_blocked_half_way_in_holds_the_part_up_and_does_not_push_it_out():
    """The block came up inside the part, and pushed it with 18 N."""
    blocked = assembly("P3", at="phase: insert", after=50)
    assert safe(blocked)
    assert blocked.faults[0].exposure < 1.5


def staying(patch):
    """Where the arm was stopped it stays."""
    patch.setattr(Loop, "_withdrawn", lambda *_: "")


def test_an_arm_that_meets_something_on_its_way_stops_and_draws_back(law):
    def clear(trial):
        met, force = trial.faults[0], trial.trace["force"]
        return bounded(trial) and met.stop < 0.2 and met.exposure > 1.0 and force[-1] < 0.1

    law.holds(clear, staying, "P4", at="phase: approach", after=10)


def watchdog(patch):
    """The robot's program waits for commands for ever."""
    sound = ServoProgram.text

    def text(self, rate):
        return re.sub(r"silent >= \d+", "silent >= 1000000", sound(self, rate))

    patch.setattr(ServoProgram, "text", text)


def ended(trial):
    return any("no fresh command" in text for _, text in trial.log)


def test_an_arm_whose_host_pauses_for_too_long_stops_by_itself(law):
    law.holds(ended, watchdog, "H1", {"pause": 0.3})


def test_an_arm_whose_host_was_killed_stops_by_itself(law):
    law.holds(ended, watchdog, "H3", {"how": "kill"})


def wall_clock(patch):
    """Ages are told by the wall clock."""
    sound = CanSensor.read

    def read(self, t):
        return sound(self, t + round(1e9 * (time.time() - NOW())))

    patch.setattr(CanSensor, "read", read)


def test_a_job_goes_on_whatever_the_wall_clock_does(law):
    def done(trial):
        return trial.outcome is not None and trial.outcome.kind.value == "inserted"

    law.holds(done, wall_clock, "H2")


def minding(patch):
    """A cycle that could not be recorded is the loop's to bear."""
    sound = Lossy.put

    def put(self, channel, t, payload):
        take = self._sink.put if channel is Channel.CTRL else partial(sound, self)
        take(channel, t, payload)

    patch.setattr(Lossy, "put", put)


def test_a_job_goes_on_whatever_the_disk_does(law):
    def done(trial):
        return trial.outcome is not None and trial.outcome.kind.value == "inserted"

    law.holds(done, minding, "H4", at="phase: search", after=3, cycles=40)


def test_control_does_not_ask_the_robot_for_a_force():
    """A payload that is wrong bends the robot's own force, joint currents and torques, only."""
    assert not [name for name in OUTPUTS if re.search("force|torque|current|moment", name)]
