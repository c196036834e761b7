import pytest
from hypothesis import given
from hypothesis import strategies as st

from hil.cell.plant.mating import STIFFNESS, TerminalFriction
from hil.cell.rig.parts import Connector

connector = Connector()
heights = st.lists(st.floats(-2.5e-3, 1e-3), min_size=1, max_size=50)


@given(heights)
def test_friction_never_exceeds_its_limit(path):
    terminals = TerminalFriction(connector)
    for z in path:
        assert abs(terminals.force(z)) <= terminals.limit(-z) + 1e-12


@given(heights, st.floats(-0.8e-3, 1e-3))
def test_above_the_terminals_there_is_no_force(path, above):
    terminals = TerminalFriction(connector)
    for z in path:
        terminals.force(z)
    assert terminals.force(above) == 0.0


@given(heights)
def test_the_path_in_and_out_loses_energy(path):
    terminals = TerminalFriction(connector)
    work, before = 0.0, 1e-3
    for goal in [*path, 1e-3]:
        for k in range(1, 51):
            z = before + (goal - before) * k / 50
            work += terminals.force(z) * (goal - before) / 50
        before = goal
    assert work <= 1e-9


def test_steady_insertion_meets_the_full_mating_force():
    terminals = TerminalFriction(connector)
    forces = [terminals.force(-k * 1e-5) for k in range(250)]
    assert forces[-1] == pytest.approx(connector.mating_force)


def test_reversal_turns_the_force_within_the_bristles_length():
    terminals = TerminalFriction(connector)
    for k in range(201):
        terminals.force(-k * 1e-5)
    back = 2 * connector.mating_force / STIFFNESS
    assert terminals.force(-2e-3 + back) == pytest.approx(-connector.mating_force)


@given(st.floats(0, 2.5e-3), st.floats(0, 2.5e-3))
def test_the_limit_grows_with_depth(shallow, deep):
    terminals = TerminalFriction(connector)
    low, high = sorted((shallow, deep))
    assert terminals.limit(low) <= terminals.limit(high)
