from math import inf

import mujoco
import numpy as np
import pytest

from hil.cell.plant import beam, mjcf
from hil.experiments.press import with_values


def tip_deflection(rig, force):
    """Static y deflection of the free tip under a side force, the stage held by its servo."""
    model = mjcf.build(rig, history=2)
    state = mujoco.MjData(model)
    state.qpos[2] = state.ctrl[2] = 10e-3
    tip = model.body("tip").id
    length = rig.cable.free_length / rig.cable.segments
    state.xfrc_applied[tip, 1] = force
    state.xfrc_applied[tip, 3] = force * length  # the force acts at the edge, not at the origin
    mujoco.mj_step(model, state, nstep=1000)
    edge = state.xpos[tip] - length * state.xmat[tip].reshape(3, 3)[:, 2]
    return float(edge[1] - state.qpos[1])


@pytest.mark.parametrize("length", [5e-3, 6e-3, 8e-3])
def test_the_chain_bends_as_a_cantilever_on_its_pad(rig, length):
    bent = with_values(rig, "cable", free_length=length)
    expected = 1 / rig.pad.stiffness_y + 1 / beam.tip_stiffness(bent.cable)
    assert tip_deflection(bent, 0.1) / 0.1 == pytest.approx(expected, rel=0.05)


def test_more_segments_come_closer_to_the_beam(rig):
    def error(segments):
        cable = with_values(rig, "cable", segments=segments)
        expected = 1 / rig.pad.stiffness_y + 1 / beam.tip_stiffness(cable.cable)
        return abs(tip_deflection(cable, 0.1) / 0.1 / expected - 1)

    errors = [inf, *(error(n) for n in (1, 2, 4))]
    assert errors == sorted(errors, reverse=True)


def test_the_chains_hinges_in_series_are_the_beams_end_slope(rig):
    compliance = sum(1 / beam.bending_hinge(rig.cable, i) for i in range(rig.cable.segments))
    halved = rig.cable.free_length / beam.bending_rigidity(rig.cable)
    missing = 0.5 / beam.bending_hinge(rig.cable, 1)
    assert compliance == pytest.approx(halved - missing)


def test_the_chain_twists_as_a_strip_with_restrained_warping(rig):
    model = mjcf.build(rig, history=2)
    state = mujoco.MjData(model)
    state.qpos[2] = state.ctrl[2] = 10e-3
    tip = model.body("tip").id
    state.xfrc_applied[tip, 5] = 1e-3
    mujoco.mj_step(model, state, nstep=1000)
    turn = np.arctan2(state.xmat[tip][3], state.xmat[tip][0]) - state.qpos[3]
    assert 1e-3 / turn == pytest.approx(beam.twist_stiffness(rig.cable), rel=0.01)
