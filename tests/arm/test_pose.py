"""Laws of rigid poses."""

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from scipy.spatial.transform import Rotation

from hil.cell.arm import pose

angles = st.floats(-math.pi, math.pi)
vectors = st.tuples(angles, angles, angles)
metres = st.floats(-2.0, 2.0)
poses = st.builds(lambda p, r: pose.of((*p, *r)), st.tuples(metres, metres, metres), vectors)


def close(a, b, tolerance=1e-9):
    return np.allclose(a.position, b.position, atol=tolerance) and np.allclose(
        a.rotation, b.rotation, atol=tolerance
    )


@given(vectors)
def test_rotation_matrix_agrees_with_scipy(vector):
    expected = Rotation.from_rotvec(vector).as_matrix()
    assert np.allclose(pose.rotation_of(*vector), expected, atol=1e-12)


@given(vectors)
def test_rotation_vector_gives_its_matrix_back(vector):
    matrix = pose.rotation_of(*vector)
    assert np.allclose(pose.rotation_of(*pose.rotation_vector(matrix)), matrix, atol=1e-9)


@given(vectors, st.floats(-1e-5, 1e-5))
def test_rotation_vector_holds_near_a_half_turn(axis, deviation):
    length = math.hypot(*axis)
    if length < 1e-3:
        axis, length = (1.0, 0.0, 0.0), 1.0
    vector = [a / length * (math.pi + deviation) for a in axis]
    matrix = pose.rotation_of(*vector)
    found = pose.rotation_vector(matrix)
    assert math.hypot(*found) <= math.pi + 1e-9
    assert np.allclose(pose.rotation_of(*found), matrix, atol=1e-8)


@given(st.floats(-math.pi, math.pi), st.floats(-1e-10, 1e-10))
def test_rounding_does_not_flip_a_hanging_tool(about_z, noise):
    hanging = pose.product(pose.rotation_of(0.0, 0.0, about_z), pose.rotation_of(math.pi, 0.0, 0.0))
    noisy = pose.product(hanging, pose.rotation_of(noise, 0.0, 0.0))
    vector = np.array(pose.rotation_vector(noisy))
    assert vector[np.argmax(np.abs(vector))] > 0


@given(poses)
def test_a_pose_and_its_inverse_cancel(a):
    assert close(pose.compose(a, pose.inverse(a)), pose.IDENTITY)


@given(poses, poses, poses)
def test_composition_is_associative(a, b, c):
    left = pose.compose(pose.compose(a, b), c)
    assert close(left, pose.compose(a, pose.compose(b, c)))


@given(poses, vectors)
def test_twist_is_the_displacement_over_time(a, velocity):
    seconds = 1e-3
    after = pose.Pose(
        tuple(p + v * seconds for p, v in zip(a.position, velocity, strict=True)),
        pose.product(pose.rotation_of(*(v * seconds for v in velocity)), a.rotation),
    )
    twist = pose.twist_between(a, after, seconds)
    assert np.allclose(twist, (*velocity, *velocity), atol=1e-6)


@pytest.mark.parametrize("angle", [6e-7, 1e-4, 1.0, 3.0])
def test_a_rotation_vector_is_exact_for_small_and_large_angles(angle):
    axis = (0.48, -0.6, 0.64)
    vector = tuple(angle * a for a in axis)
    found = pose.rotation_vector(pose.rotation_of(*vector))
    assert found == pytest.approx(vector, rel=1e-9)


def test_twist_of_a_point_turns_about_the_axis():
    assert pose.twist_at((0, 0, 0, 0, 0, 2.0), (1.0, 0, 0)) == (0, 2.0, 0, 0, 0, 2.0)


@pytest.mark.parametrize("bad", [math.nan, math.inf])
def test_six_numbers_must_be_finite(bad):
    with pytest.raises(ValueError, match="finite"):
        pose.vector6((0, 0, 0, 0, 0, bad))
