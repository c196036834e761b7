from math import pi, remainder, tau

import numpy as np
import pytest
from hypothesis import example, given
from hypothesis import strategies as st
from scipy.spatial.transform import Rotation

from hil.cell.arm.pose import Pose
from hil.cell.geometry import TaskGeometry, turn_about_z

LENGTH = 0.12
ORIGIN = (-0.45, -0.11, 0.05)
DOWN = Rotation.from_euler("x", pi)

angles = st.floats(-pi, pi)
metres = st.floats(-0.5, 0.5)
places = st.tuples(metres, metres, metres)
stages = st.tuples(metres, metres, metres, st.floats(-3, 3))
tilts = st.tuples(st.floats(-0.3, 0.3), st.floats(-0.3, 0.3))


def geometry(rotation):
    return TaskGeometry(ORIGIN, rotation, LENGTH)


def pose(position, rotation):
    return Pose(tuple(position), tuple(map(tuple, rotation.as_matrix().tolist())))


def flange_at(position, theta, tilt):
    """A tool that points down but for its tilt, turned by theta about the base's z."""
    return pose(position, Rotation.from_euler("ZXY", (theta, pi + tilt[0], tilt[1])))


def base_to_task(rotation):
    return Rotation.from_euler("z", -rotation)


@given(angles, places, angles, tilts)
def test_the_stage_is_the_tip_in_the_task_frame(rotation, position, theta, tilt):
    flange = flange_at(position, theta, tilt)
    tip = np.array(position) + np.array(flange.rotation) @ (0, 0, LENGTH)
    expected = base_to_task(rotation).apply(tip - ORIGIN)
    assert geometry(rotation).stage(flange)[:3] == pytest.approx(expected, abs=1e-12)


@given(angles, places, angles)
def test_theta_is_the_tools_turn_against_the_connector(rotation, position, theta):
    found = geometry(rotation).stage(flange_at(position, theta, (0, 0)))[3]
    assert abs(remainder(found - (theta - rotation), tau)) < 1e-9


@given(angles, places, st.floats(-0.1, 0.1))
@example(pi, (0.0, 0.0, 0.0), 0.05)
@example(-3.1, (0.0, 0.0, 0.0), -0.1)
def test_a_tool_nearly_aligned_has_a_small_theta_however_the_connector_is_turned(
    rotation, position, off
):
    found = geometry(rotation).stage(flange_at(position, rotation + off, (0, 0)))[3]
    assert found == pytest.approx(off, abs=1e-9)


@given(angles, stages, places, angles, tilts)
def test_the_flange_for_a_stage_puts_the_tip_there(rotation, stage, position, theta, tilt):
    between, target = geometry(rotation), flange_at(position, theta, tilt)
    found = between.stage(between.flange(stage, target, between.stage(target)))
    assert found[:3] == pytest.approx(stage[:3], abs=1e-12)
    assert abs(remainder(found[3] - stage[3], tau)) < 1e-9


@given(angles, places, angles, tilts)
def test_the_targets_own_stage_gives_the_target_back(rotation, position, theta, tilt):
    between, target = geometry(rotation), flange_at(position, theta, tilt)
    stage = between.stage(target)
    found = between.flange(stage, target, stage)
    assert found.position == pytest.approx(target.position, abs=1e-12)
    assert np.allclose(found.rotation, target.rotation, atol=1e-12)


@given(angles, stages, places, angles, tilts)
def test_a_flange_keeps_its_targets_tilt(rotation, stage, position, theta, tilt):
    between, target = geometry(rotation), flange_at(position, theta, tilt)
    found = between.flange(stage, target, between.stage(target))
    assert found.rotation[2] == pytest.approx(target.rotation[2], abs=1e-12)
    assert np.allclose(np.array(found.rotation) @ np.transpose(found.rotation), np.eye(3))


@given(angles, places)
def test_a_free_vector_turns_with_the_connector(rotation, vector):
    expected = base_to_task(rotation).inv().apply(vector)
    assert geometry(rotation).to_base(vector) == pytest.approx(expected, abs=1e-12)


@given(angles, angles)
def test_turning_about_z_is_the_matrix_product(angle, other):
    matrix = Rotation.from_euler("zyx", (other, 0.3, -0.7)).as_matrix()
    expected = Rotation.from_euler("z", angle).as_matrix() @ matrix
    turned = turn_about_z(angle, tuple(map(tuple, matrix.tolist())))
    assert np.allclose(turned, expected, atol=1e-12)
