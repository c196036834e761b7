import pytest

from hil.bench.case import chosen
from hil.bench.run import measure
from hil_fixtures.testbed import shipped

SECONDS = 0.2
PARTS = {"physics", "sensor", "can", "arm", "rtde", "recording", "control"}


@pytest.fixture(scope="module")
def measured():
    (case,) = chosen(("free_125hz_1ms",))
    return measure(shipped("ffc_ur5"), b"name: x\n", case, SECONDS)


def test_a_measurement_lasts_as_long_as_was_asked(measured):
    assert measured.periods == SECONDS * 125


def test_a_measurement_says_how_fast(measured):
    assert measured.real_time_factor > 0


def test_every_part_of_the_loop_has_its_share(measured):
    assert set(measured.parts) == PARTS
    assert {name for name, share in measured.parts.items() if share <= 0} == set()


def test_a_case_in_lockstep_has_no_lateness(measured):
    assert measured.lateness is None
