"""A sensor whose axes, signs or scale are wrong is found out by shaking the tool."""

from itertools import permutations, product

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from controller.self_test import Load, self_test
from drivers.errors import RobotStateError, SensorAxesError

LOAD = Load(0.6)
TURNS = [(axes, signs) for axes in permutations(range(3)) for signs in product((1, -1), repeat=3)]
SOUND = ((0, 1, 2), (1, 1, 1))


def shaken(make_cell, axes=tuple, rate=125, **world):
    cell = make_cell(rate, mass=LOAD.mass, **world)
    cell.sensor.axes = axes
    self_test(cell.arm, cell.sensor, LOAD)
    return cell


def mounted(axes, signs):
    """A sensor that gives out its axes in this order, with these signs."""
    return lambda wrench: (*(wrench[a] * s for a, s in zip(axes, signs, strict=True)), 0, 0, 0)


@pytest.mark.parametrize("rate", [125, 500])
def test_a_sound_sensor_passes_and_the_arm_is_back_where_it_was(make_cell, rate):
    cell = shaken(make_cell, rate=rate)
    cell.arm.read()
    assert cell.world.stage == pytest.approx([0.0, 0.0, 0.02, 0.0], abs=0.2e-3)
    assert max(abs(place.z - 0.02) for place in cell.arm.sent) < 3e-3


@pytest.mark.parametrize("turn", [turn for turn in TURNS if turn != SOUND])
def test_every_other_order_and_sign_of_the_axes_is_refused(make_cell, turn):
    with pytest.raises(SensorAxesError, match="check the sensor's axes"):
        shaken(make_cell, mounted(*turn))


@settings(max_examples=25, deadline=None)
@given(st.floats(-2.0, 2.0))
def test_a_scale_is_refused_about_where_its_tolerance_ends(make_cell, scale):
    def scaled(wrench):
        return tuple(scale * value for value in wrench)

    if abs(scale - 1.0) < 0.5 * LOAD.error:
        shaken(make_cell, scaled)
    elif abs(scale - 1.0) > 1.5 * LOAD.error:
        with pytest.raises(SensorAxesError, match=r"expected 0\.6 kg"):
            shaken(make_cell, scaled)


@settings(max_examples=25, deadline=None)
@given(st.tuples(*[st.floats(-50.0, 50.0)] * 3))
def test_weight_and_bias_do_not_matter(make_cell, bias):
    shaken(
        make_cell, lambda wrench: (*(a + b for a, b in zip(wrench, bias, strict=False)), 0, 0, 0)
    )


def test_a_tool_that_touches_something_is_not_shaken_on(make_cell):
    with pytest.raises(SensorAxesError, match="does the tool touch anything"):
        shaken(make_cell, at=(0.0, 0.0, -0.2e-3, 0.0), stiffness=50e3)


def test_an_arm_that_does_not_follow_is_told_of(make_cell):
    cell = make_cell(mass=LOAD.mass)
    cell.world._lag = lambda target: None
    with pytest.raises(RobotStateError, match="the arm moved 0 mm along x"):
        self_test(cell.arm, cell.sensor, LOAD)
