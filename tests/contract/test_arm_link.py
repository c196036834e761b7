"""What an arm behind a wire owes beyond the interface: no number without a link."""

import pytest

from drivers.errors import LinkError
from hil_fixtures.testbed import open_testbed


@pytest.fixture
def arm(rigs):
    with open_testbed(rigs("cb3")) as bed:
        yield bed.near.arm


VERBS = ("read", "hold", "stop")


def test_an_arm_that_is_not_connected_says_so(arm):
    for verb in VERBS:
        with pytest.raises(LinkError, match="connect"):
            getattr(arm, verb)()


def test_an_arm_that_was_closed_says_so(arm):
    arm.connect()
    arm.close()
    for verb in VERBS:
        with pytest.raises(LinkError, match="connect"):
            getattr(arm, verb)()


def test_a_with_block_connects_and_closes(arm):
    with arm as connected:
        assert connected.read().program_running
    with pytest.raises(LinkError):
        arm.read()


def test_an_output_that_does_not_exist_is_refused(arm):
    with pytest.raises(ValueError, match=r"0\.\.7"):
        arm.set_output(8, True)


@pytest.mark.parametrize(("series", "period"), [("cb3", 8_000_000), ("e-series", 2_000_000)])
def test_the_period_is_the_controllers(rigs, series, period):
    with open_testbed(rigs(series)) as bed:
        bed.near.arm.connect()
        assert bed.near.arm.period == period
