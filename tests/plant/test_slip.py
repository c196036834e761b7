import pytest
from hypothesis import given
from hypothesis import strategies as st

from hil.cell.plant.slip import STUCK, PadState, load, slipped
from hil.cell.rig.parts import Pad

pad = Pad()
small = st.floats(-5e-3, 5e-3)
roots = st.builds(PadState, small, small, st.floats(-1.0, 1.0))


@given(roots)
def test_after_slip_the_pad_carries_at_most_its_friction(root):
    assert load(pad, root, slipped(pad, root, STUCK)) <= 1.0 + 1e-9


@given(roots)
def test_slip_leaves_the_pad_on_the_limit_or_alone(root):
    before = load(pad, root, STUCK)
    rest = slipped(pad, root, STUCK)
    if before <= 1.0:
        assert rest == pytest.approx(STUCK, abs=1e-15)
    else:
        assert load(pad, root, rest) == pytest.approx(1.0)


@given(roots)
def test_slip_dissipates_and_never_returns_energy(root):
    rest = slipped(pad, root, STUCK)
    for at, now in zip(root, rest, strict=True):
        assert abs(at - now) <= abs(at) + 1e-15


def test_force_beyond_the_limit_slides_by_the_excess():
    root = PadState(2 * pad.slip_force / pad.stiffness_x, 0.0, 0.0)
    assert slipped(pad, root, STUCK).x == pytest.approx(root.x / 2)
