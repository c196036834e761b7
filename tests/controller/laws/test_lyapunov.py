"""The corrected Lyapunov function, on the ideal loop that it is a statement about."""

from math import pi

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy.integrate import solve_ivp

from controller.laws.lyapunov import IdealLoop, LoopState

SEEDS = st.integers(0, 2**32 - 1)


def drawn(seed):
    """A loop of a mass of .3 to 10 N s²/m on .3 to 100 N/mm, and where it starts."""
    rng = np.random.default_rng(seed)
    mass, damping = 10 ** rng.uniform(-0.5, 1.0), 10 ** rng.uniform(1.0, 3.0)
    stiffness, omega = 10 ** rng.uniform(2.5, 5.0), rng.uniform(3.0, 30.0)
    gain, eta = damping * stiffness / mass, rng.uniform(0.5, 1.5)
    mu = 10 ** rng.uniform(-3.0, 1.0, 3) / gain * omega**2 * (1.0, 0.1, 0.1)
    rho = 10 ** rng.uniform(-3.0, 0.0, 3) / gain * omega * (1.0, 0.1, 0.1)
    q1, q2 = 2.0 * omega**2 * 10 ** rng.uniform(-1.0, 1.0), 2.0 * 10 ** rng.uniform(-1.0, 1.0)
    loop = IdealLoop(mass, damping, stiffness, omega, eta, q1, q2, tuple(mu), tuple(rho))
    gains = rng.uniform(0.0, 1.0, 2) * (omega**2, 2.0 * eta * omega) / gain
    start = LoopState(rng.uniform(-10, 10), rng.uniform(-50, 50), rng.uniform(-0.1, 0.1), *gains)
    return loop, start


def values(loop, start, surface_speed=0.0):
    """V along two seconds of the loop."""
    flow = lambda _, y: loop.flow(LoopState(*y), surface_speed)  # noqa: E731
    path = solve_ivp(flow, (0.0, 2.0), start, "LSODA", rtol=1e-9, atol=1e-12, max_step=0.01)
    assert path.success
    return np.array([loop.value(LoopState(*y)) for y in path.y.T])


@settings(deadline=None, max_examples=25)
@given(SEEDS)
def test_v_never_grows_while_the_ideal_loop_runs(seed):
    course = values(*drawn(seed))
    assert np.diff(course).max() <= 1e-9 * course[0]


@given(SEEDS)
def test_v_is_positive_and_its_slope_never_is(seed):
    loop, start = drawn(seed)
    assert loop.value(start) > 0.0
    assert loop.slope(start) <= 0.0


@given(SEEDS)
def test_the_slope_of_eq_23_is_the_derivative_of_v_along_the_flow(seed):
    loop, start = drawn(seed)
    flow = loop.flow(start)
    total = 0.0
    for index, rate in enumerate(flow):
        # V is quadratic in each coordinate: a central difference is exact but for rounding.
        width = 1e-3 * max(abs(start[index]), 1e-6)
        above, below = list(start), list(start)
        above[index] += width
        below[index] -= width
        rise = loop.value(LoopState(*above)) - loop.value(LoopState(*below))
        total += rise / (2.0 * width) * rate
    scale = abs(loop.slope(start)) + 1e-3 * loop.value(start) * loop.omega
    assert total == pytest.approx(loop.slope(start), abs=1e-3 * scale)


@given(SEEDS)
def test_p_solves_the_lyapunov_equation_of_the_reference_model(seed):
    loop, _ = drawn(seed)
    w, eta = loop.omega, loop.eta
    p = np.array([[loop.p1, loop.p2], [loop.p2, loop.p3]])
    r = np.array([[0.0, 1.0], [-w * w, -2.0 * eta * w]])
    assert np.allclose(p @ r + r.T @ p, -np.diag([loop.q1, loop.q2]), rtol=1e-9, atol=1e-6)
    assert np.linalg.eigvalsh(p).min() > 0.0


def test_under_a_moving_surface_v_may_rise():
    risen = 0
    for seed in range(15):
        course = values(*drawn(seed), surface_speed=2e-3)
        risen += np.diff(course).max() > 1e-6 * course[0]
    assert risen > 0


def test_delta_is_in_newtons_for_p2_of_one():
    w = 2.0 * pi
    loop = IdealLoop(1.0, 200.0, 1e3, w, 1.0, 2.0 * w * w, 2.0, (1.0,) * 3, (1.0,) * 3)
    assert loop.p2 == pytest.approx(1.0)
    assert loop.delta(LoopState(3.0, 0.0, 0.0, 0.0, 0.0)) == pytest.approx(3.0)
