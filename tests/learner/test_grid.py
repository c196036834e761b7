from hypothesis import given
from hypothesis import strategies as st

from controller.action import Action, Observation
from learner.grid import Cell, Grid

HALVES = st.tuples(*[st.integers(0, 12)] * 3)
SIZES = (0.3e-3, 0.3e-3, 0.0174532925199433)


@given(HALVES)
def test_rows_and_cells_are_one_to_one(halves):
    grid = Grid(halves, SIZES)
    cells = [grid.at(row) for row in range(grid.states)]
    assert len(set(cells)) == grid.states
    assert [grid.row(cell) for cell in cells] == list(range(grid.states))


@given(HALVES, st.data())
def test_a_pose_less_than_half_a_step_off_is_its_cell(halves, data):
    grid = Grid(halves, SIZES, middle=(1e-3, -2e-3, 0.1))
    cell = Cell(*(data.draw(st.integers(-half, half)) for half in halves))
    off = [data.draw(st.floats(-0.49, 0.49)) for _ in range(3)]
    x, y, theta = (
        middle + (step + e) * size
        for step, e, size, middle in zip(cell, off, SIZES, grid.middle, strict=True)
    )
    assert grid.cell(Observation(0, 0, 5, 0, x, y, 0, theta)) == cell


@given(HALVES, st.sampled_from(Action), st.data())
def test_a_step_changes_one_axis_by_one_or_is_not_taken(halves, action, data):
    grid = Grid(halves, SIZES)
    cell = Cell(*(data.draw(st.integers(-half, half)) for half in halves))
    after = grid.moved(cell, action)
    change = [b - a for a, b in zip(cell, after, strict=True)]
    at_edge = abs(cell[action.axis] + action.sign) > halves[action.axis]
    assert change == [
        action.sign if axis == action.axis and not at_edge else 0 for axis in range(3)
    ]


def test_a_pose_outside_the_box_is_the_nearest_in_it():
    grid = Grid((5, 5, 3), SIZES)
    assert grid.cell(Observation(0, 0, 5, 0, 1.0, -1.0, 0, 0.0)) == Cell(5, -5, 0)
