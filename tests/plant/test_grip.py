from math import cos, hypot, pi, sin

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from hil.cell.plant.grip import Grip, Jaws, Whereabouts, place, seen_from, tip_of

near = st.floats(-1e-2, 1e-2)
angle = st.floats(-3.0, 3.0)


def jaws_of(rig, seed=1):
    return Jaws(rig, np.random.default_rng(seed))


def nominal(rig, index=0):
    return place(rig.fixture.parts[index], rig.connector)


def beside(stage, dx):
    return (stage[0] + dx, *stage[1:])


@given(near, near, near, angle, near, near, near, st.floats(-0.1, 0.1))
def test_a_grip_brings_the_tip_back_to_where_it_was_taken(x, y, z, theta, dx, dy, dz, turn):
    stage, tip = (x, y, z, theta), (x + dx, y + dy, z + dz, theta + turn)
    assert tip_of(stage, seen_from(stage, "FFC1", tip)) == pytest.approx(tip, abs=1e-12)


def test_a_turned_connector_turns_the_places_of_the_parts(rig):
    connector = rig.connector.model_copy(update={"rotation": pi / 2})
    straight, turned = place(rig.fixture.parts[0], rig.connector), nominal(rig)
    turned = place(rig.fixture.parts[0], connector)
    assert turned[:2] == pytest.approx((straight[1], -straight[0]))
    assert turned[3] == pytest.approx(-pi / 2)


def test_jaws_that_close_near_a_part_hold_it(rig):
    jaws = jaws_of(rig)
    assert jaws.move(True, nominal(rig), 0.0)
    assert jaws.grip is not None
    assert jaws.grip.name == "FFC1"
    assert jaws.whereabouts["FFC1"] is Whereabouts.JAWS


def test_jaws_that_close_beyond_capture_hold_nothing(rig):
    jaws = jaws_of(rig)
    assert not jaws.move(True, beside(nominal(rig), rig.fixture.capture + 1e-6), 0.0)
    assert jaws.grip is None


def test_jaws_turned_across_a_part_hold_nothing(rig):
    jaws = jaws_of(rig)
    x, y, z, theta = nominal(rig)
    jaws.move(True, (x, y, z, theta + pi / 2), 0.0)
    assert jaws.grip is None


def test_closed_jaws_that_stay_closed_do_not_catch_a_part_later(rig):
    jaws = jaws_of(rig)
    jaws.move(True, (0.0, 0.0, 0.1, 0.0), 0.0)
    jaws.move(True, nominal(rig), 0.0)
    assert jaws.grip is None


@given(st.integers(0, 2**32 - 1))
def test_play_stays_within_its_width(rig, seed):
    jaws = jaws_of(rig, seed)
    jaws.move(True, nominal(rig), 0.0)
    half, half_turn = rig.fixture.play / 2, rig.fixture.play_rotation / 2
    assert abs(jaws.grip.x) <= half + 1e-12
    assert abs(jaws.grip.y) <= half + 1e-12
    assert abs(jaws.grip.theta) <= half_turn + 1e-12


def test_play_is_drawn_anew_at_every_grip(rig):
    jaws = jaws_of(rig)
    grips = set()
    for _ in range(5):
        jaws.move(True, nominal(rig), 0.0)
        grips.add(jaws.grip)
        jaws.move(False, nominal(rig), 0.0)
    assert len(grips) == 5


def test_the_same_seed_gives_the_same_play_and_another_seed_another(rig):
    def grip(seed) -> Grip:
        jaws = jaws_of(rig, seed)
        jaws.move(True, nominal(rig), 0.0)
        return jaws.grip

    assert grip(1) == grip(1)
    assert grip(1) != grip(2)


def test_play_follows_the_fixtures_own_axes(rig):
    quarter = rig.fixture.parts[0].model_copy(update={"rotation": pi / 2})
    turned = rig.model_copy(
        update={"fixture": rig.fixture.model_copy(update={"parts": (quarter,)})}
    )
    straight_jaws, turned_jaws = jaws_of(rig), jaws_of(turned)
    straight_jaws.move(True, nominal(rig), 0.0)
    turned_jaws.move(True, nominal(turned), 0.0)
    assert turned_jaws.grip.x == pytest.approx(straight_jaws.grip.x, abs=1e-9)
    assert turned_jaws.grip.y == pytest.approx(straight_jaws.grip.y, abs=1e-9)


@pytest.mark.parametrize(
    ("dx", "depth", "where"),
    [
        (0.0, 0.0, Whereabouts.FIXTURE),
        (0.1, 0.6e-3, Whereabouts.CONNECTOR),
        (0.1, 0.4e-3, Whereabouts.DROPPED),
    ],
)
def test_a_part_let_go_is_back_seated_or_dropped(rig, dx, depth, where):
    jaws = jaws_of(rig)
    jaws.move(True, nominal(rig), 0.0)
    jaws.move(False, beside(nominal(rig), dx), depth)
    assert jaws.grip is None
    assert jaws.whereabouts["FFC1"] is where


def test_a_seated_part_cannot_be_gripped_from_its_fixture_again(rig):
    jaws = jaws_of(rig)
    jaws.move(True, nominal(rig), 0.0)
    jaws.move(False, beside(nominal(rig), 0.1), 2e-3)
    jaws.move(True, nominal(rig), 0.0)
    assert jaws.grip is None


def test_reset_puts_every_part_back(rig):
    jaws = jaws_of(rig)
    jaws.move(True, nominal(rig), 0.0)
    jaws.move(False, beside(nominal(rig), 0.1), 0.0)
    jaws.reset()
    assert set(jaws.whereabouts.values()) == {Whereabouts.FIXTURE}


@given(angle, near, near)
def test_a_grip_does_not_depend_on_where_the_stage_is_turned(theta, dx, dy):
    straight = seen_from((0.0, 0.0, 0.0, 0.0), "FFC1", (dx, dy, 0.0, 0.0))
    c, s = cos(theta), sin(theta)
    tip = (c * dx - s * dy, s * dx + c * dy, 0.0, theta)
    turned = seen_from((0.0, 0.0, 0.0, theta), "FFC1", tip)
    assert hypot(turned.x - straight.x, turned.y - straight.y) < 1e-15 + 1e-12
