"""R1 to R10: a robot that stops, and what its host does then."""

from functools import partial

import pytest

from drivers.errors import LinkError
from drivers.ur.arm import UrArm
from drivers.ur.sample import Sample


def state(patch):
    """The driver does not look at the robot's modes."""
    patch.setattr(Sample, "follows", property(lambda self: True))


SLOW = partial(pytest.param, marks=pytest.mark.campaign)


def test_a_protective_stop_ends_the_job_by_name(law):
    law.stops(state, "R1", told="ProtectiveStopError")


@pytest.mark.parametrize("category", ["0", SLOW("1")])
def test_an_emergency_stop_ends_the_job_by_name(law, category):
    told = "ROBOT_EMERGENCY_STOP" if category == "0" else "ProtectiveStopError"
    law.stops(state, "R2", {"category": category}, told=told)


@pytest.mark.parametrize("what", ["stop", SLOW("pause")])
def test_a_program_that_does_not_play_ends_the_job(law, what):
    law.stops(state, "R3", {"what": what}, told="the motion program does not run")


def test_a_joint_that_comes_near_its_limit_ends_the_job_by_name(law):
    law.stops(state, "R5", told="ProtectiveStopError", at="phase: search", after=3)


@pytest.mark.parametrize("what", ["speed", SLOW("plane")])
def test_a_limit_of_the_safety_system_ends_the_job_without_a_retry(law, what):
    law.stops(state, "R6", {"what": what}, told="ProtectiveStopError")


@pytest.mark.parametrize("value", ["nan", SLOW("jump")])
def test_a_command_that_the_robot_refuses_ends_the_job(law, value):
    law.stops(state, "R7", {"value": value, "jump": 0.05}, told="commands fell silent")


def reconnecting(patch):
    """A link that breaks is made again in silence, and the job goes on."""
    sound = UrArm.read

    def read(self):
        try:
            return sound(self)
        except LinkError:
            self.connect()
            return sound(self)

    patch.setattr(UrArm, "read", read)


def test_a_robot_that_restarts_ends_the_job(law):
    law.stops(reconnecting, "R10", told="LinkError")
