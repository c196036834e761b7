"""An episode as pixels: the box from above (x to the right, y up), its turns in a column beside.

Visited poses are blue, the darker the more often; the jaws are a dark square; the pose from which
the part would go in, where the world tells it, is an orange frame. The rim says how it ended.
"""

from typing import Final

import numpy as np
from numpy.typing import NDArray

from controller.outcome import Kind
from learner.grid import Cell, Grid

Pixels = NDArray[np.uint8]
Colour = tuple[int, int, int]

SIDE: Final = 24
"""Pixels of a pose."""
RIM: Final = 6
_PAPER: Final = (255, 255, 255)
_LINE: Final = (222, 226, 232)
_JAWS: Final = (28, 32, 38)
_SLOT: Final = (224, 122, 31)
_VISITED: Final = np.array([31, 119, 180], float)
_RIMS: Final = {
    None: (236, 238, 241),
    Kind.INSERTED: (46, 139, 87),
    Kind.DANGER: (200, 40, 40),
    Kind.LIMIT: (120, 120, 120),
}


class Picture:
    """What an episode leaves behind; `drawn` at any time."""

    def __init__(self, grid: Grid) -> None:
        self._grid = grid
        self.begin(Cell(0, 0, 0))

    def begin(self, cell: Cell) -> None:
        """A new episode, with the jaws there."""
        nx, ny, nt = self._grid.shape
        self._above, self._turns = np.zeros((nx, ny)), np.zeros((1, nt))
        self.step(cell, None)

    def step(self, cell: Cell, ending: Kind | None) -> None:
        """The jaws are there now, and the episode ended so or goes on."""
        self._cell, self._ending = cell, ending
        x, y, theta = np.add(cell, self._grid.halves)
        self._above[x, y] += 1
        self._turns[0, theta] += 1

    def drawn(self, error: tuple[float, float, float] | None) -> Pixels:
        """(h, w, 3); error: from the slot to the tip, None where nobody knows."""
        hx, hy, ht = self._grid.halves
        x, y, theta = self._cell
        above, turns = _squares(self._above), _squares(self._turns)
        _jaws(above, x + hx, y + hy)
        _jaws(turns, 0, theta + ht)
        if error is not None:
            _slot(above, x - error[0] + hx, y - error[1] + hy)
            _slot(turns, 0.0, theta - error[2] + ht)
        return _sheet(above, turns, _RIMS[self._ending])


def _squares(visits: NDArray[np.float64]) -> Pixels:
    """A square a pose, blue by how often it was visited; axes are still (x, y)."""
    share = (1.0 - np.exp(-0.5 * visits))[:, :, None]
    colours = (1.0 - share) * np.array(_PAPER, float) + share * _VISITED
    pixels = np.repeat(np.repeat(colours, SIDE, axis=0), SIDE, axis=1).astype(np.uint8)
    pixels[::SIDE], pixels[:, ::SIDE] = _LINE, _LINE
    return pixels


def _jaws(pixels: Pixels, x: int, y: int) -> None:
    edge = SIDE // 4
    pixels[x * SIDE + edge : (x + 1) * SIDE - edge, y * SIDE + edge : (y + 1) * SIDE - edge] = _JAWS


def _slot(pixels: Pixels, x: float, y: float) -> None:
    """A frame of two pixels; what lies outside the box is cut."""
    left, low = round(x * SIDE), round(y * SIDE)
    frame = np.zeros(pixels.shape[:2], bool)
    frame[_cut(left + 1, left + SIDE), _cut(low + 1, low + SIDE)] = True
    frame[_cut(left + 4, left + SIDE - 3), _cut(low + 4, low + SIDE - 3)] = False
    pixels[frame] = _SLOT


def _cut(low: int, high: int) -> slice:
    return slice(max(0, low), max(0, high))


def _sheet(above: Pixels, turns: Pixels, rim: Colour) -> Pixels:
    """Both panels on one sheet, y up."""
    panels = [np.flip(panel.transpose(1, 0, 2), axis=0) for panel in (above, turns)]
    height = max(panel.shape[0] for panel in panels) + 2 * RIM
    width = sum(panel.shape[1] for panel in panels) + 3 * RIM
    sheet = np.empty((height, width, 3), np.uint8)
    sheet[:] = rim
    left = RIM
    for panel in panels:
        top = (height - panel.shape[0]) // 2
        sheet[top : top + panel.shape[0], left : left + panel.shape[1]] = panel
        left += panel.shape[1] + RIM
    return sheet
