from math import exp

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from hil.cell.plant import servo
from hil.cell.plant.interface import StageTarget
from hil.cell.plant.wall import Motion, WallPlant, transition
from hil.experiments.press import PERIOD, with_values


def settle(rig, z, periods=60):
    plant = WallPlant(rig, np.random.default_rng(1))
    plant.reset(StageTarget(0.0, 0.0, 1e-3, 0.0, False))
    for _ in range(periods):
        step = plant.step(StageTarget(0.0, 0.0, z, 0.0, False), PERIOD)
    return step


@pytest.mark.parametrize("stiffness", [1e3, 10e3, 100e3])
def test_force_is_stiffness_times_penetration(rig, stiffness):
    step = settle(with_values(rig, "physics", wall_stiffness=stiffness), z=-0.5e-3)
    force = rig.tool.mass * 9.81 - step.wrenches[-1, 2]
    assert force == pytest.approx(-stiffness * step.stage[2], rel=1e-6)


def test_penetration_shares_the_press_with_the_servos_stiffness(rig):
    servo_stiffness = servo.MASS * servo.frequency(rig.robot.servo) ** 2
    wall = rig.physics.wall_stiffness
    expected = -0.5e-3 * servo_stiffness / (servo_stiffness + wall)
    assert settle(rig, z=-0.5e-3).stage[2] == pytest.approx(expected, rel=1e-6)


def test_above_the_wall_there_is_no_force(rig):
    step = settle(rig, z=0.1e-3)
    assert step.wrenches[-1, 2] == pytest.approx(rig.tool.mass * 9.81, abs=1e-6)


def test_the_wall_never_pulls(rig):
    plant = WallPlant(rig, np.random.default_rng(1))
    plant.reset(StageTarget(0.0, 0.0, 1e-3, 0.0, False))
    mass = rig.tool.mass
    for z in [-1e-3] * 20 + [1e-3] * 20:
        step = plant.step(StageTarget(0.0, 0.0, z, 0.0, False), 1_000_000)
        w = servo.frequency(rig.robot.servo)
        free = w**2 * (z - step.stage[2]) - 2 * w * step.velocity[2]
        push = (mass * (9.81 + free) - step.wrenches[-1, 2]) / (1 - mass / servo.MASS)
        assert push >= -1e-9


@given(st.floats(-1e-2, 1e-2), st.floats(-1.0, 1.0), st.floats(1e-4, 0.1))
def test_free_motion_is_the_critically_damped_closed_form(q, v, t):
    w = 138.0
    moved = transition(w**2, 2 * w, t).after(Motion(q, v), 0.0)
    assert moved.q == pytest.approx((q + (v + w * q) * t) * exp(-w * t), abs=1e-9)


@given(st.floats(0.0, 1e6), st.floats(0.0, 1e3), st.floats(-1e-2, 1e-2), st.floats(-1.0, 1.0))
def test_energy_never_grows(stiffness, damping, q, v):
    moved = transition(stiffness, damping, 1e-4).after(Motion(q, v), 0.0)
    before = stiffness * q**2 + v**2
    assert stiffness * moved.q**2 + moved.v**2 <= before * (1 + 1e-9) + 1e-15
