"""The curved surface: statics, shape and friction against closed forms; MuJoCo against numba."""

from math import atan, cos, inf, nan, pi, sin

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from hil.cell.errors import PlantError, RigError
from hil.cell.plant import servo
from hil.cell.plant.interface import Contact, StageTarget
from hil.cell.plant.surface import SurfacePlant
from hil.cell.plant.surface_contact import Relief, Skin, contact_force, height_and_slope, spring
from hil.cell.plant.surface_mujoco import MujocoSurfacePlant
from hil.cell.rig import parse
from hil.experiments.press import PERIOD, with_values
from hil_fixtures.testbed import shipped

WEIGHT = 0.05 * 9.81
RELIEF = Relief(floor=-5e-3, amplitude=4e-3, wavelength=80e-3, length=0.1)


@pytest.fixture
def rig():
    return shipped("surface_ur5")


@pytest.fixture(params=[SurfacePlant, MujocoSurfacePlant])
def plant_type(request):
    return request.param


def at(x, z):
    return StageTarget(x, 0.0, z, 0.0, False)


def settled(plant, target, periods=80):
    plant.reset(at(target.x, 0.0))
    for _ in range(periods):
        step = plant.step(target, PERIOD)
    return step


def push(step):
    """Force of the surface on the tool along z at the end of a step, N; the tool must rest."""
    return WEIGHT - step.wrenches[-1, 2]


@pytest.mark.parametrize("stiffness", [1e3, 10e3, 100e3])
def test_on_the_flat_force_is_stiffness_times_penetration(plant_type, rig, stiffness):
    plant = plant_type(with_values(rig, "surface", stiffness=stiffness))
    step = settled(plant, at(-5e-3, -5.5e-3))
    # MuJoCo's own contact gives way by 1 um beside the spring's 0.3 mm.
    assert push(step) == pytest.approx(stiffness * (-5e-3 - step.stage[2]), rel=5e-3)
    assert push(step) > 0.2


def test_surface_and_servo_give_way_in_series(rig):
    servo_stiffness = servo.MASS * servo.frequency(rig.robot.servo) ** 2
    k = rig.surface.stiffness
    step = settled(SurfacePlant(rig), at(-5e-3, -5.5e-3))
    assert push(step) == pytest.approx(0.5e-3 / (1 / k + 1 / servo_stiffness), rel=1e-6)


def test_above_the_surface_there_is_no_force(plant_type, rig):
    step = settled(plant_type(rig), at(-5e-3, -4.9e-3))
    assert push(step) == pytest.approx(0.0, abs=1e-5)
    assert step.part.contact is Contact.FREE


def test_a_touched_surface_is_reported(plant_type, rig):
    assert settled(plant_type(rig), at(-5e-3, -5.2e-3)).part.contact is Contact.FACE


@pytest.mark.parametrize("value", [nan, inf])
def test_a_set_point_that_is_not_finite_is_refused(plant_type, rig, value):
    plant = plant_type(rig)
    plant.reset(at(0.0, 0.0))
    with pytest.raises(PlantError, match="not finite"):
        plant.step(at(value, 0.0), PERIOD)


def test_how_time_is_cut_into_periods_does_not_change_the_motion(plant_type, rig):
    once, twice = plant_type(rig), plant_type(rig)
    once.reset(at(0.0, -4.99e-3))
    twice.reset(at(0.0, -4.99e-3))
    whole = once.step(at(1e-3, -5.2e-3), PERIOD)
    halves = [twice.step(at(1e-3, -5.2e-3), PERIOD // 2) for _ in range(2)]
    assert np.array_equal(whole.wrenches, np.concatenate([h.wrenches for h in halves]))


def slid(plant, depth, speed=0.02, periods=300):
    """Force along z at the end of each period of a slide at constant depth under the flat part."""
    plant.reset(at(0.0, -5e-3 - depth))
    forces = []
    for k in range(periods):
        step = plant.step(at(speed * k * 8e-3, -5e-3 - depth), PERIOD)
        forces.append(push(step))
    return np.array(forces)


def test_mujoco_and_the_closed_form_feel_the_same_slide(rig):
    """0.3 mm under the valley the crest of 1 mm is 1.3 mm deep: 3 to 12 N at 10 N/mm."""
    shallow = with_values(rig, "surface", amplitude=1e-3, friction=0.2)
    ours, theirs = (slid(kind(shallow), 0.3e-3) for kind in (SurfacePlant, MujocoSurfacePlant))
    assert np.ptp(ours) > 5.0
    assert np.abs(ours - theirs)[5:].max() < 0.03 * ours.max()


def test_friction_pulls_back_what_slides_on_the_flat(plant_type, rig):
    flat = with_values(rig, "surface", amplitude=0.0)
    plant = plant_type(flat)
    plant.reset(at(-10e-3, -5.5e-3))
    for k in range(60):
        step = plant.step(at(-10e-3 + 0.02 * k * 8e-3, -5.5e-3), PERIOD)
    fx, fz = step.wrenches[:, 0].mean(), WEIGHT - step.wrenches[:, 2].mean()
    assert fx == pytest.approx(-0.2 * fz, rel=0.05)
    assert step.wrenches[:, 4].mean() == pytest.approx(rig.tool.length * fx, rel=0.05)


def test_the_mujoco_surface_refuses_to_bottom_out(rig):
    with pytest.raises(RigError, match="bottoming_force"):
        MujocoSurfacePlant(with_values(rig, "surface", bottoming_force=3.0))


def test_a_bottoming_surface_is_stiffer_beyond_its_force():
    skin = Skin(2e3, 0.0, 0.0, bottoming_force=3.0, bottoming_stiffness=50e3)
    assert spring(skin, 1.0e-3) == pytest.approx(2.0)
    assert spring(skin, 1.5e-3 + 0.1e-3) == pytest.approx(3.0 + 5.0)


@given(st.floats(-0.02, 0.15), st.floats(1e-7, 1e-5))
def test_the_slope_is_the_heights_derivative(x, h):
    here, there = (height_and_slope(RELIEF, p)[0] for p in (x - h, x + h))
    if x + h < 0.1 - 1e-9 or x - h > 0.1 + 1e-9:
        assert height_and_slope(RELIEF, x)[1] == pytest.approx((there - here) / (2 * h), abs=2e-3)


@settings(max_examples=200)
@given(
    st.floats(-0.01, 0.12), st.floats(-8e-3, 0.0), st.floats(-0.1, 0.1), st.floats(-0.1, 0.1)
)  # fmt: skip
def test_contact_pushes_never_pulls_and_friction_takes_energy(x, z, vx, vz):
    skin = Skin(10e3, 50.0, 0.3, 0.0, 1.0)
    fx, fz = contact_force(RELIEF, skin, (x, z), (vx, vz))
    tilt = atan(height_and_slope(RELIEF, x)[1])
    normal, along = fz * cos(tilt) - fx * sin(tilt), fx * cos(tilt) + fz * sin(tilt)
    sliding = vx * cos(tilt) + vz * sin(tilt)
    assert normal >= -1e-9
    assert along * sliding <= 1e-12
    assert abs(along) <= 0.3 * normal + 1e-9


def test_the_wave_rises_by_its_amplitude_in_half_a_wavelength():
    assert height_and_slope(RELIEF, 40e-3)[0] == pytest.approx(-1e-3)
    assert max(abs(height_and_slope(RELIEF, x)[1]) for x in np.linspace(0, 0.1, 500)) == (
        pytest.approx(pi * 4e-3 / 80e-3, rel=1e-3)
    )


@pytest.mark.parametrize(
    ("line", "said"),
    [
        ("stiffness: 0 N/mm", "greater than 0"),
        ("stiffness: -1 N/mm", "greater than 0"),
        ("stiffness: nan N/m", "not finite"),
        ("amplitude: 30 mm", "steeper"),
        ("stifness: 1 N/mm", "did you mean 'stiffness'"),
    ],
)
def test_a_surface_that_cannot_be_is_refused_in_one_line(line, said):
    with pytest.raises(RigError, match=said) as caught:
        parse(f"name: x\nsurface: {{{line}}}")
    assert "\n" not in str(caught.value)
