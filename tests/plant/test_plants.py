"""One suite for every plant: what the bench may rely on whichever physics is inside."""

from math import inf, nan

import numpy as np
import pytest

from hil.cell.errors import PlantError
from hil.cell.plant.analytic import AnalyticPlant
from hil.cell.plant.ffc import FfcPlant
from hil.cell.plant.grip import place
from hil.cell.plant.interface import Contact, StageTarget
from hil.cell.plant.wall import WallPlant
from hil.experiments.press import PERIOD, Press, over_connector

FREE = StageTarget(0.0, 0.0, 0.05, 0.0, False)


@pytest.fixture(params=[FfcPlant, AnalyticPlant, WallPlant])
def plant_type(request):
    return request.param


@pytest.fixture
def plant(plant_type, rig):
    made = plant_type(rig, np.random.default_rng(1))
    made.reset(FREE)
    return made


def at_part(rig, closed):
    return StageTarget(*place(rig.fixture.parts[0], rig.connector), closed)


def test_at_rest_the_sensor_feels_the_tools_weight_along_its_z(plant, rig):
    wrench = plant.step(FREE, PERIOD).wrenches
    weight = [0, 0, rig.tool.mass * 9.81, 0, 0, 0]
    assert np.allclose(wrench, weight, atol=6e-3)  # the chain's own weight is 5 mN


@pytest.mark.parametrize("count", [1, 2, 8, 16])
def test_a_period_gives_one_wrench_a_millisecond(plant, count):
    assert plant.step(FREE, count * 1_000_000).wrenches.shape == (count, 6)


def test_reset_gives_the_one_wrench_at_rest(plant):
    step = plant.reset(FREE)
    assert step.wrenches.shape == (1, 6)
    assert step.stage == FREE[:4]
    assert step.velocity == (0.0, 0.0, 0.0, 0.0)


@pytest.mark.parametrize("duration", [0, -PERIOD, 1_500_000])
def test_a_period_that_is_no_number_of_milliseconds_is_refused(plant, duration):
    with pytest.raises(PlantError, match="1 ms"):
        plant.step(FREE, duration)


@pytest.mark.parametrize("value", [nan, inf])
def test_a_set_point_that_is_not_finite_is_refused(plant, value):
    with pytest.raises(PlantError, match="not finite"):
        plant.step(FREE._replace(x=value), PERIOD)


def test_how_time_is_cut_into_periods_does_not_change_the_motion(plant_type, rig):
    target = FREE._replace(x=1e-3, theta=0.01)
    once = plant_type(rig, np.random.default_rng(1))
    twice = plant_type(rig, np.random.default_rng(1))
    once.reset(FREE)
    twice.reset(FREE)
    whole = once.step(target, PERIOD)
    halves = [twice.step(target, PERIOD // 2) for _ in range(2)]
    assert np.array_equal(whole.wrenches, np.concatenate([h.wrenches for h in halves]))
    assert whole.stage == halves[-1].stage


def test_the_stage_lags_a_ramp_by_the_servos_two_over_w(plant, rig):
    """A critically damped axis trails a ramp by 2/w = 14.5 ms at 22 Hz, less half the hold."""
    speed = 0.01
    for k in range(1, 60):
        step = plant.step(FREE._replace(x=speed * k * 8e-3), PERIOD)
    lag = 59 * 8e-3 - step.stage[0] / speed
    w = 2 * np.pi * rig.robot.servo.bandwidth
    assert lag == pytest.approx(2 / w - 4e-3, abs=1.5e-3)


def test_the_stage_comes_to_rest_on_its_target_without_overshoot(plant):
    target = FREE._replace(x=1e-3)
    path = [plant.step(target, PERIOD).stage[0] for _ in range(60)]
    assert max(path) <= 1e-3 + 1e-8
    assert path[-1] == pytest.approx(1e-3, abs=1e-9)


def test_accelerating_the_tool_shows_against_the_motion(plant, rig):
    """The sensor feels -m a: pushed towards +x, the tool hangs back."""
    first = plant.step(FREE._replace(x=1e-4), 1_000_000).wrenches[0]
    assert first[0] < -0.1
    assert first[4] / first[0] == pytest.approx(rig.tool.centre_of_mass, rel=0.02)


def test_acceleration_over_a_whole_move_sums_to_zero_momentum(plant):
    target = FREE._replace(x=1e-3)
    pushes = np.concatenate([plant.step(target, PERIOD).wrenches[:, 0] for _ in range(60)])
    assert abs(pushes.sum()) < 0.1 * abs(pushes).sum()


def test_a_turned_stage_turns_the_sensors_axes(plant, rig):
    quarter = FREE._replace(theta=np.pi / 2)
    plant.reset(quarter)
    first = plant.step(quarter._replace(x=1e-4), 1_000_000).wrenches[0]
    assert abs(first[0]) < 1e-3 < 0.1 < abs(first[1])


def test_pressing_down_is_a_negative_force_along_the_sensors_z(plant_type, rig):
    trial = Press(plant_type, rig, y=1.5e-3)
    for _ in range(100):
        trial.press()
    assert trial.wrench[2] == pytest.approx(-rig.task.contact_force, abs=0.05)
    assert trial.last.part.contact is Contact.FACE


def test_jaws_pick_a_part_and_put_it_back(plant_type, rig):
    plant = plant_type(rig, np.random.default_rng(1))
    plant.reset(at_part(rig, closed=False))
    assert plant.step(at_part(rig, closed=False), PERIOD).part.name is None
    part = plant.step(at_part(rig, closed=True), PERIOD).part
    assert part.name == "FFC1"
    assert np.hypot(*part.grip[:2]) <= rig.fixture.play
    assert plant.step(at_part(rig, closed=False), PERIOD).part.name is None
    assert plant.step(at_part(rig, closed=True), PERIOD).part.name == "FFC1"


def test_jaws_that_close_on_nothing_hold_nothing(plant):
    assert plant.step(FREE._replace(jaws_closed=True), PERIOD).part.name is None


def test_the_tip_hangs_where_the_grip_says(plant_type, rig):
    plant = plant_type(over_connector(rig, x=1e-3, y=-5e-4, theta=0.02), np.random.default_rng(1))
    stage = StageTarget(0.0, 0.0, 0.3e-3, 0.0, False)
    plant.reset(stage)
    part = plant.step(stage._replace(jaws_closed=True), PERIOD).part
    assert part.tip == pytest.approx((1e-3, -5e-4, 0.3e-3), abs=1e-6)
    assert part.theta == pytest.approx(0.02, abs=1e-6)
    assert part.grip == pytest.approx((1e-3, -5e-4, 0.02), abs=1e-9)


def above_face(z):
    return StageTarget(1e-4, 1.5e-3, z, 0.01, True)


def run(plant_type, rig, seed):
    plant = plant_type(rig, np.random.default_rng(seed))
    plant.reset(at_part(rig, closed=False))
    plant.step(at_part(rig, closed=True), PERIOD)
    for _ in range(40):  # the servo carries the part over in 0.3 s
        plant.step(above_face(3e-4), PERIOD)
    steps = [plant.step(above_face(3e-4 - 2e-5 * k), PERIOD) for k in range(60)]
    return b"".join(s.wrenches.tobytes() + np.array(s.part.tip).tobytes() for s in steps)


def test_the_same_seed_gives_the_same_bytes(plant_type, rig):
    assert run(plant_type, rig, 3) == run(plant_type, rig, 3)


def test_another_seed_grips_the_part_elsewhere(plant_type, rig):
    assert run(plant_type, rig, 3) != run(plant_type, rig, 4)
