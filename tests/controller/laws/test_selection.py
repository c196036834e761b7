"""Six axes, each chosen, and the axes that hold no force."""

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from controller.laws.bounds import Bounds
from controller.laws.build import build
from controller.laws.interface import AxisReading, Reference
from controller.laws.selection import Mirrored, SelectionLaw
from controller.laws.unforced import FreeAxis, Pace, PositionAxis

PERIOD = 8_000_000
NOTHING = (Reference(),) * 6


def position():
    return PositionAxis(Pace(), PERIOD)


def free():
    return FreeAxis(250.0, Pace(), PERIOD)


def force():
    return build("constant", None, Bounds(), PERIOD)


def selection(*axes):
    law = SelectionLaw(axes)
    law.reset((0.0,) * 6)
    return law


def test_each_axis_does_what_it_was_chosen_for():
    law = selection(free(), position(), force(), position(), position(), free())
    pressing = Reference(5.0)
    references = (Reference(), Reference(position=1e-3), pressing, *NOTHING[:3])
    steps = law.step(0, [(1.0, 1.0, 0.0, 1.0, 1.0, -0.5)], None, references)
    assert steps[0] > 0.0  # gives way to the push
    assert steps[1] > 0.0  # goes to its position
    assert steps[2] < 0.0  # seeks the contact
    assert steps[3:5] == (0.0, 0.0)  # holds, whatever the moment
    assert steps[5] < 0.0
    assert law.velocity == pytest.approx([step / 8e-3 for step in steps])


def test_without_samples_force_and_free_axes_stand_still_and_position_axes_go_on():
    law = selection(free(), position(), force(), position(), position(), free())
    references = (Reference(), Reference(position=1e-3), Reference(5.0), *NOTHING[:3])
    steps = law.step(0, [], (0.0,) * 6, references)
    assert [step != 0.0 for step in steps] == [False, True, False, False, False, False]


def test_a_mirrored_axis_moves_as_the_plain_one_turned_round():
    plain, mirrored = force(), Mirrored(force())
    plain.reset(0.1)
    mirrored.reset(-0.1)
    for count in range(100):
        push = 0.2 * count % 9.0
        there = plain.step(AxisReading(count * PERIOD, (push,), 0.1), Reference(5.0, speed=1e-3))
        here = mirrored.step(
            AxisReading(count * PERIOD, (-push,), -0.1), Reference(5.0, speed=-1e-3)
        )
        assert here == -there
    assert mirrored.velocity == -plain.velocity


@settings(deadline=None)
@given(st.floats(-0.05, 0.05), st.sampled_from([8_000_000, 2_000_000]))
def test_a_position_axis_arrives_without_overshoot(target, period):
    axis = PositionAxis(Pace(speed=0.05), period)
    axis.reset(0.0)
    x = 0.0
    for count in range(2000):
        x += axis.step(AxisReading(count * period, ()), Reference(position=target))
        assert abs(x) <= abs(target) + 1e-9
    assert x == pytest.approx(target, abs=1e-6)


@pytest.mark.parametrize("target", [float("nan"), float("inf")])
def test_a_position_axis_stands_still_for_a_target_that_is_none(target):
    axis = position()
    axis.reset(0.0)
    assert axis.step(AxisReading(0, ()), Reference(position=target)) == 0.0


def test_a_selection_of_five_axes_is_refused():
    with pytest.raises(ValueError, match="six axes are to be selected, found 5"):
        SelectionLaw([position()] * 5)


@pytest.mark.parametrize("wrong", [{"speed": 0.0}, {"acceleration": float("inf")}])
def test_a_pace_without_bound_is_refused(wrong):
    with pytest.raises(ValueError, match="positive and finite"):
        Pace(**wrong)


def test_a_free_axis_without_damping_is_refused():
    with pytest.raises(ValueError, match="damping of a free axis is positive"):
        FreeAxis(0.0, Pace(), PERIOD)
