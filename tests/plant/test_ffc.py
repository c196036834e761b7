import numpy as np
import pytest

from hil.cell.errors import PlantError, RigError
from hil.cell.plant import beam
from hil.cell.plant.analytic import AnalyticPlant
from hil.cell.plant.ffc import FfcPlant
from hil.cell.plant.interface import Contact, StageTarget
from hil.experiments.press import PERIOD, Press, with_values

FREE = StageTarget(0.0, 0.0, 0.05, 0.0, False)


def pressed(rig, x=0.0, y=0.0, theta=0.0, periods=250, plant=FfcPlant):
    trial = Press(plant, rig, x, y, theta)
    for _ in range(periods):
        trial.press()
    return trial


@pytest.mark.parametrize("plant", [FfcPlant, AnalyticPlant])
@pytest.mark.parametrize(
    ("x", "y", "theta"),
    [(0.0, 0.0, 0.0), (0.2e-3, 0.0, 0.0), (0.0, 0.15e-3, 0.0), (0.1e-3, -0.1e-3, 0.01)],
)
def test_a_cable_within_the_lead_in_goes_to_the_goal(rig, plant, x, y, theta):
    part = pressed(rig, x, y, theta, periods=300, plant=plant).last.part
    assert part.depth >= rig.task.goal_depth
    assert abs(part.tip[1]) < 0.1e-3


@pytest.mark.parametrize("plant", [FfcPlant, AnalyticPlant])
@pytest.mark.parametrize(("x", "y", "theta"), [(0.4e-3, 0, 0), (0, 0.35e-3, 0), (0, 0, 0.06)])
def test_a_cable_beyond_the_lead_in_stays_out(rig, plant, x, y, theta):
    part = pressed(rig, x, y, theta, plant=plant).last.part
    assert part.depth < rig.connector.mating_start


def test_the_floor_stops_the_cable(rig):
    trial = Press(FfcPlant, with_values(rig, "connector", mating_force=0.0))
    for _ in range(300):
        trial.press()
    assert trial.last.part.contact is Contact.BOTTOM
    assert trial.last.part.depth == pytest.approx(rig.connector.depth, abs=1e-6)
    assert trial.force == pytest.approx(5.0, abs=0.05)


def test_the_terminals_resist_with_their_mating_force(rig):
    trial = Press(FfcPlant, with_values(rig, "connector", friction=0.0))
    forces = []
    while trial.last.part.depth < 2.2e-3:
        trial.move(dz=-2e-5)
        if trial.last.part.depth > 1.5e-3:
            forces.append(trial.force)
    assert np.mean(forces) == pytest.approx(rig.connector.mating_force, rel=0.03)


def test_a_weaker_press_than_the_terminals_does_not_mate(rig):
    weak = with_values(rig, "task", contact_force=3.0)
    assert pressed(weak).last.part.depth < rig.task.goal_depth


@pytest.mark.parametrize("mu", [0.1, 0.2, 0.3])
def test_dragging_across_the_face_meets_coulomb_friction(rig, mu):
    trial = pressed(with_values(rig, "connector", friction=mu), y=-6e-3, periods=100)
    cone = []
    for _ in range(260):
        trial.press(dy=1e-5)
        cone.append(abs(trial.wrench[1]) / trial.force)
    assert max(cone) <= mu * 1.001
    assert max(cone) == pytest.approx(mu, rel=0.02)
    assert np.mean(cone[-60:]) > 0.85 * mu  # stick-slip lets go in between


def test_force_is_continuous_while_pressing_is_steady(rig):
    trial = pressed(rig, y=1.5e-3, periods=100)
    before = trial.last.wrenches[-1, 2]
    for _ in range(20):
        trial.press()
        samples = np.concatenate([[before], trial.last.wrenches[:, 2]])
        assert np.abs(np.diff(samples)).max() < 0.02
        before = samples[-1]


def test_contact_at_rest_is_free_of_noise(rig):
    trial = pressed(rig, y=1.5e-3, periods=200)
    trial.move()
    for _ in range(20):
        trial.move()
    assert trial.last.wrenches[:, 2].std() < 1e-6


def test_pressing_is_the_springs_in_series(rig):
    """Pad, servo and nothing else give way under an axial press."""
    trial = pressed(rig, y=1.5e-3, periods=150)
    z = trial.last.stage[2]
    assert trial.force / -z == pytest.approx(rig.pad.stiffness_z, rel=0.02)


def test_a_long_cable_buckles_near_eulers_load(rig):
    """A free length of 20 mm, 1 degree of tilt from y misalignment being its imperfection."""
    long = with_values(rig, "cable", free_length=20e-3)
    trial = Press(FfcPlant, long, y=1.5e-3)
    for _ in range(50):
        trial.move(dy=1e-5, dz=-1e-5)
    forces = [-trial.move(dz=-1e-5)[2] for _ in range(150)]
    plateau = np.mean(forces[-30:])
    assert plateau == pytest.approx(beam.euler_load(long.cable), rel=0.15)


def test_a_short_cable_does_not_buckle_under_ten_newton(rig):
    strong = with_values(rig, "task", contact_force=10.0)
    trial = pressed(strong, y=1.5e-3, periods=200)
    assert trial.force == pytest.approx(10.0, abs=0.1)
    assert abs(trial.last.part.tip[1] - 1.5e-3) < 1e-5


def test_a_cable_pressed_beyond_the_jaws_friction_slips(rig):
    weak = with_values(rig, "pad", slip_force=3.0)
    trial = Press(FfcPlant, weak, y=1.5e-3)
    forces = [-trial.move(dz=-1e-5)[2] for _ in range(80)]
    assert max(forces) <= 3.0 * 1.05
    assert forces[-1] == pytest.approx(3.0, rel=0.05)


def test_slip_sideways_stays_in_the_grip(rig):
    weak = with_values(with_values(rig, "pad", slip_force=2.0), "connector", mating_force=0.0)
    trial = pressed(with_values(weak, "task", contact_force=1.5), periods=200)
    before = trial.last.part.grip[0]
    for _ in range(60):
        trial.move(dx=2e-5)
    assert trial.last.part.grip[0] < before - 1e-4


def test_a_cable_left_deep_in_the_slot_no_longer_pulls(rig):
    plant_rig = rig
    trial = pressed(plant_rig, periods=300)
    assert trial.last.part.depth > rig.task.goal_depth
    trial.open()
    assert trial.last.part.name is None
    trial.move()
    assert trial.last.part.contact is Contact.FREE


def test_a_target_out_of_this_world_is_a_plant_error(rig, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)  # MuJoCo logs its warning in the working directory
    plant = FfcPlant(rig, np.random.default_rng(1))
    plant.reset(FREE)
    with pytest.raises(PlantError, match="left its domain"):
        plant.step(FREE._replace(x=1e300), PERIOD)


def test_a_period_longer_than_the_sensors_memory_is_refused(rig):
    plant = FfcPlant(rig, np.random.default_rng(1))
    plant.reset(FREE)
    with pytest.raises(PlantError, match="16 ms"):
        plant.step(FREE, 17_000_000)


@pytest.mark.parametrize("step", [0.3e-3, 2e-3, 0.0])
def test_a_physics_step_that_does_not_divide_a_millisecond_is_refused(rig, step):
    with pytest.raises(RigError, match=r"physics\.step"):
        FfcPlant(with_values(rig, "physics", step=step), np.random.default_rng(1))


def test_a_tool_heavier_than_the_arm_is_refused(rig):
    with pytest.raises(RigError, match=r"tool\.mass"):
        FfcPlant(with_values(rig, "tool", mass=5.5), np.random.default_rng(1))


def test_sensor_history_equals_stepping_one_millisecond_at_a_time(rig):
    whole, single = pressed(rig, y=0.3e-3, periods=30), pressed(rig, y=0.3e-3, periods=30)
    target = StageTarget(0.0, 0.3e-3, -1e-4, 0.01, True)
    once = whole.plant.step(target, PERIOD).wrenches
    each = [single.plant.step(target, 1_000_000).wrenches for _ in range(8)]
    assert np.array_equal(once, np.concatenate(each))


def test_before_it_slips_the_forces_do_not_depend_on_the_physics_step(rig):
    """After slip they do: where stick-slip comes to rest is the step's (docs/plant.md)."""

    def side_force(step):
        trial = pressed(with_values(rig, "physics", step=step), y=1.5e-3, periods=100)
        for _ in range(30):
            trial.press(dy=1e-5)
        for _ in range(20):
            trial.press()
        return trial.wrench[1]

    forces = [side_force(step) for step in (0.25e-3, 0.5e-3, 1e-3)]
    assert abs(forces[0]) > 0.2
    assert forces == pytest.approx([forces[0]] * 3, abs=2e-3)
