"""Matrix and array expressions; the first table is the Script Manual's own examples."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from hil.cell.arm.urscript import RuntimeStatus
from hil.cell.arm.urscript.builtins.matrices import Matrices
from hil.cell.arm.urscript.operators import multiply
from hil.cell.arm.urscript.values import List, Pose

NUMBER = st.floats(-100.0, 100.0)
POSE = st.tuples(*[st.floats(-2.0, 2.0)] * 6).map(Pose)


def matrices(rows, columns):
    return st.lists(
        st.lists(NUMBER, min_size=columns, max_size=columns).map(List),
        min_size=rows,
        max_size=rows,
    ).map(List)


@pytest.mark.parametrize(
    ("expression", "result"),
    [
        (
            "[[1,2],[3,4],[5,6]] * [[10,20,30],[40,50,60]]",
            "[[90, 120, 150], [190, 260, 330], [290, 400, 510]]",
        ),
        ("[[1,2],[3,4],[5,6]] * [10,20]", "[50, 110, 170]"),
        ("[1,2,3] * [10,20,30]", "[10, 40, 90]"),
        ("[10,20,30] / [1,2,3]", "[10, 10, 10]"),
        ("[1,2,3] + [10,20,30]", "[11, 22, 33]"),
        ("[10,20,30] % [1,2,4]", "[0, 0, 2]"),
        ("5 * [[1,2],[3,4],[5,6]]", "[[5, 10], [15, 20], [25, 30]]"),
        ("10 / [10,20,40]", "[1, 0.5, 0.25]"),
        ("[1,2,3] + 10", "[11, 12, 13]"),
        ("10 - [1,2,3]", "[9, 8, 7]"),
        ("[[1,2],[3,4]] % 2", "[[1, 0], [1, 0]]"),
        ("transpose([[1,2],[3,4],[5,6]])", "[[1, 3, 5], [2, 4, 6]]"),
        ("inv([[2,0],[0,4]])", "[[0.5, 0], [0, 0.25]]"),
        ("size([1,2,3])", "3"),
        ("size([[1,2],[3,4],[5,6]])", "[3, 2]"),
        ("normalize([3, 0, 4])", "[0.6, 0, 0.8]"),
    ],
)
def test_an_expression_has_the_manuals_result(said, expression, result):
    assert said(f"textmsg({expression})") == [result]


@pytest.mark.parametrize(
    ("expression", "why"),
    [
        ("[[1,2],[3,4]] * [1,2,3]", "2 columns do not match 3 rows"),
        ("[[1,2],[3,4]] * [[1,2],[3]]", "rows of one length"),
        ("[[]] * []", "0 columns do not match 0 rows"),
        ("[[1],2] * [1]", "rows of one length"),
        ("[1,2] * [1,2,3]", "lists of 2 and 3 elements do not match"),
        ("[1,2] % 0", "division by zero"),
        ("inv([[1,2],[2,4]])", "singular"),
        ("inv([[1,2]])", "has no inverse"),
        ("transpose([[1,2],[3]])", "rows of one length"),
        ("transpose([])", "rows of one length"),
        ("normalize([0,0])", "no direction"),
    ],
)
def test_what_has_no_result_ends_the_program_and_says_why(run, expression, why):
    runtime = run(f"x = {expression}")
    assert runtime.status is RuntimeStatus.FAILED
    assert why in str(runtime.error)


@given(matrices(3, 2), matrices(2, 4))
def test_products_are_numpys(a, b):
    assert np.allclose(multiply(a, b), np.array(a) @ np.array(b))


@given(POSE, st.tuples(*[NUMBER] * 6).map(List))
def test_a_wrench_seen_from_elsewhere_and_back_is_the_same(frame, wrench):
    there = Matrices.wrench_trans(frame, wrench)
    back = Matrices.wrench_trans(Matrices.inv(frame), there)
    assert np.allclose(back, wrench, atol=1e-6)


def test_a_force_has_a_moment_about_a_point_beside_it():
    moved = Matrices.wrench_trans(Pose((0.0, 0.5, 0.0, 0.0, 0.0, 0.0)), List((0, 0, 2, 0, 0, 0)))
    assert moved == pytest.approx((0, 0, 2, -1, 0, 0))
