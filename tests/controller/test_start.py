import pytest

from controller.start import PATIENCE, bring_up
from drivers.errors import NotReadyError


def test_it_waits_for_the_sensor_and_zeroes_it(make_cell):
    cell = make_cell()
    cell.sensor.boot = 300_000_000
    state = bring_up(cell.arm, cell.sensor)
    assert cell.sensor.tares == 1
    assert not cell.sensor.tare_pending
    assert state.t >= cell.sensor.boot


def test_it_leaves_a_command_in_flight(make_cell):
    cell = make_cell()
    bring_up(cell.arm, cell.sensor)
    cell.arm.read()


def test_a_sensor_that_never_comes_is_an_error_within_the_limit(make_cell):
    cell = make_cell()
    cell.sensor.boot = 10**15
    with pytest.raises(NotReadyError, match="no samples within"):
        bring_up(cell.arm, cell.sensor)
    assert cell.arm.t < (PATIENCE + 0.1) * 1e9
