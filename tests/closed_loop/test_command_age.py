"""The robot's own watch: it stops on commands that are new but answer an old state."""

import pytest

from drivers.errors import RobotStateError
from hil.cell.rig import LatencyLaw
from hil.cell.rig.task import Latency, Link
from hil_fixtures.testbed import open_testbed


def held_back(rig, seconds):
    """The rig, its commands so long on their way."""
    late = Link(
        to_cell=LatencyLaw.model_validate({"mean": f"{seconds} s"}),
        from_cell=rig.latency.rtde.from_cell,
    )
    latency = Latency(rtde=late, can=rig.latency.can, sensor_tcp=rig.latency.sensor_tcp)
    return rig.model_copy(update={"latency": latency})


def follow(arm, periods):
    for _ in range(periods):
        arm.read()
        arm.hold()


def follow_from_power_up(arm):
    arm.connect()
    follow(arm, 50)


def test_commands_within_half_the_age_limit_are_followed(rig):
    with open_testbed(held_back(rig, 0.3 * rig.limits.command_age)) as bed:
        bed.near.arm.connect()
        follow(bed.near.arm, 50)


def test_an_arm_whose_every_command_is_too_old_ends_its_program(rig):
    bed = open_testbed(held_back(rig, 0.6 * rig.limits.command_age))
    with bed as opened, pytest.raises(RobotStateError, match="late"):
        follow_from_power_up(opened.near.arm)
