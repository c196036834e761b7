"""Forward and inverse kinematics against each other and against the published DH tables."""

import math

import numpy as np
import pytest

from hil.cell.arm.kinematics import MODELS, Kinematics
from hil.cell.arm.pose import Pose

HALF = math.pi / 2
HANGING = (0.3, -HALF, HALF, -HALF, -HALF)

# DH a2, a3, d1, d4, d5, d6 in m: Universal Robots, "DH parameters for calculations".
PUBLISHED = {
    "ur5": (-0.425, -0.39225, 0.089159, 0.10915, 0.09465, 0.0823),
    "ur5e": (-0.425, -0.3922, 0.1625, 0.1333, 0.0997, 0.0996),
    "ur3e": (-0.24355, -0.2132, 0.15185, 0.13105, 0.08535, 0.0921),
    "ur10": (-0.612, -0.5723, 0.1273, 0.163941, 0.1157, 0.0922),
}


def link(theta, a, d, alpha):
    ct, st, ca, sa = math.cos(theta), math.sin(theta), math.cos(alpha), math.sin(alpha)
    return np.array(
        [
            [ct, -st * ca, st * sa, a * ct],
            [st, ct * ca, -ct * sa, a * st],
            [0, sa, ca, d],
            [0, 0, 0, 1],
        ]
    )


def by_table(model, q):
    """Frames after each joint."""
    a2, a3, d1, d4, d5, d6 = PUBLISHED[model]
    rows = [(0, d1, HALF), (a2, 0, 0), (a3, 0, 0), (0, d4, HALF), (0, d5, -HALF), (0, d6, 0)]
    frames = [np.eye(4)]
    for theta, (a, d, alpha) in zip(q, rows, strict=True):
        frames.append(frames[-1] @ link(theta, a, d, alpha))
    return frames


@pytest.mark.parametrize("model", PUBLISHED)
def test_forward_kinematics_follow_the_published_table(model):
    for q in np.random.default_rng(2).uniform(-6, 6, (20, 6)):
        flange = Kinematics(model).forward(q)
        expected = by_table(model, q)[-1]
        assert np.allclose(flange.position, expected[:3, 3], atol=1e-12)
        assert np.allclose(flange.rotation, expected[:3, :3], atol=1e-12)


@pytest.mark.parametrize("model", PUBLISHED)
def test_elbow_lies_where_the_published_table_puts_it(model):
    for q in np.random.default_rng(3).uniform(-6, 6, (10, 6)):
        elbow = Kinematics(model).elbow(tuple(q))
        assert np.allclose(elbow, by_table(model, q)[2][:3, 3], atol=1e-12)


def test_elbow_velocity_is_the_derivative_of_its_position():
    arm, rng, dt = Kinematics("ur5"), np.random.default_rng(4), 1e-6
    for q, qd in rng.uniform(-3, 3, (10, 2, 6)):
        before, after = arm.elbow(tuple(q - qd * dt)), arm.elbow(tuple(q + qd * dt))
        difference = (np.array(after) - before) / (2 * dt)
        assert np.allclose(arm.elbow_velocity(tuple(q), tuple(qd)), difference, atol=1e-8)


@pytest.mark.parametrize("model", MODELS)
def test_inverse_kinematics_give_the_joints_back(model):
    arm = Kinematics(model)
    for q in np.random.default_rng(5).uniform(-6.2, 6.2, (100, 6)):
        assert np.allclose(arm.inverse(arm.forward(q), tuple(q)), q, atol=1e-8)


@pytest.mark.parametrize("q6", [0.0, 1e-12, 1e-9, -1e-7, math.pi, -math.pi])
@pytest.mark.parametrize("model", MODELS)
def test_a_tool_that_hangs_down_is_not_lost(model, q6):
    arm, q = Kinematics(model), (*HANGING, q6)
    assert np.allclose(arm.inverse(arm.forward(q), q), q, atol=1e-8)


def test_at_the_wrist_singularity_the_pose_is_met():
    arm, q = Kinematics("ur5"), (0.1, -1.5, 1.5, -1.6, 0.0, 0.2)
    flange = arm.forward(q)
    assert np.allclose(arm.forward(arm.inverse(flange, q)).position, flange.position, atol=1e-9)


def test_a_pose_out_of_reach_is_refused():
    far = Pose((3.0, 0.0, 0.0), ((1.0, 0.0, 0.0), (0.0, 1.0, 0.0), (0.0, 0.0, 1.0)))
    with pytest.raises(ValueError, match="no joint angles reach"):
        Kinematics("ur5").inverse(far, (0.0,) * 6)


def test_an_unknown_model_is_refused_by_name():
    with pytest.raises(ValueError, match="'ur6'"):
        Kinematics("ur6")
