"""The state of a table: which pose of the search box the end effector is in.

Of the eight quantities of Eq. 1 only x, y and theta enter: z follows from the force law, and four
forces in five bins each would make 2.3 million states of which a training visits under a thousandth
(the paper's own Fig. 12 shows Q over the pose alone).
"""

from typing import NamedTuple

from controller.action import Action, Observation


class Cell(NamedTuple):
    """Steps off the box's middle along x and y and about z."""

    x: int
    y: int
    theta: int


class Grid(NamedTuple):
    """Poses of the box: half widths in steps, sizes of the steps (m, m, rad), its middle."""

    halves: tuple[int, int, int]
    sizes: tuple[float, float, float]
    middle: tuple[float, float, float] = (0.0, 0.0, 0.0)

    @property
    def shape(self) -> tuple[int, int, int]:
        """Poses along each axis."""
        x, y, theta = self.halves
        return 2 * x + 1, 2 * y + 1, 2 * theta + 1

    @property
    def states(self) -> int:
        x, y, theta = self.shape
        return x * y * theta

    def cell(self, observation: Observation) -> Cell:
        """The nearest pose of the box: noise of the arm's own pose is far below half a step."""
        here = (observation.x, observation.y, observation.theta)
        return Cell(
            *(
                max(-half, min(half, round((value - middle) / size)))
                for value, middle, size, half in zip(
                    here, self.middle, self.sizes, self.halves, strict=True
                )
            )
        )

    def row(self, cell: Cell) -> int:
        """The table's row of a cell."""
        (hx, hy, ht), (_, ny, nt) = self.halves, self.shape
        return ((cell.x + hx) * ny + cell.y + hy) * nt + cell.theta + ht

    def at(self, row: int) -> Cell:
        """The cell of a row."""
        (hx, hy, ht), (_, ny, nt) = self.halves, self.shape
        rest, theta = divmod(row, nt)
        x, y = divmod(rest, ny)
        return Cell(x - hx, y - hy, theta - ht)

    def moved(self, cell: Cell, action: Action) -> Cell:
        """Where the step leads; one that would leave the box is not taken."""
        steps = list(cell)
        half = self.halves[action.axis]
        steps[action.axis] = max(-half, min(half, steps[action.axis] + action.sign))
        return Cell(*steps)
