"""Policies without learning: systematic searches that know the gripper's pose and nothing else."""

from collections.abc import Iterator
from itertools import count

import numpy as np

from controller.action import Action, Observation
from controller.settings import Search

_NEAR = 0.5
"""Steps within which a way point counts as reached."""


class Waypoints:
    """Walks from one way point (x, y, theta, in steps) to the next: theta first, then x, then y."""

    def __init__(self, points: Iterator[tuple[float, float, float]], search: Search) -> None:
        self._points = points
        self._sizes = (search.step, search.step, search.step_rotation)
        self._target = next(points)

    def choose(self, observation: Observation) -> Action | None:
        """The next step; None when there are no way points left."""
        here = (observation.x, observation.y, observation.theta)
        for _ in range(1000):
            for axis in (2, 0, 1):
                error = self._target[axis] - here[axis] / self._sizes[axis]
                if abs(error) > _NEAR:
                    return Action(2 * axis + (error < 0))
            target = next(self._points, None)
            if target is None:
                return None
            self._target = target
        return None


def pose_script(search: Search, start_y: float) -> Waypoints:
    """Sweep y across the slot, row by row in x, then with a turn; start_y in m sets the first way.

    The tip lags behind the jaws by up to 0.65 mm of y (friction against the cable's bending) and
    lies up to 0.4 mm off in them (fixture play), so a sweep overshoots by both.
    """
    return Waypoints(_sweeps(-1.0 if start_y > 0 else 1.0), search)


def spiral_script(search: Search) -> Waypoints:
    """Square spiral outward from the nominal slot at theta = 0."""
    return Waypoints(((x, y, 0.0) for x, y in _spiral()), search)


class RandomPolicy:
    """Each action with equal chance, from the generator given."""

    def __init__(self, rng: np.random.Generator) -> None:
        self._rng = rng

    def choose(self, observation: Observation) -> Action:
        return Action(int(self._rng.integers(len(Action))))


_ROWS = (0.0, 1.0, -1.0)
_TURNS = (0.0, 1.0, -1.0)
_OVERSHOOT = 4.0


def _sweeps(way: float) -> Iterator[tuple[float, float, float]]:
    """Way points of the sweeps: first to the far side, then row after row, turn after turn."""
    for _ in count():
        for theta in _TURNS:
            for x in _ROWS:
                yield (x, way * _OVERSHOOT, theta)
                way = -way


def _spiral() -> Iterator[tuple[float, float]]:
    """Corners of a square spiral with one step between its arms."""
    x = y = 0.0
    yield x, y
    for side in count(1):
        sign = 1.0 if side % 2 else -1.0
        x += sign * side
        yield x, y
        y += sign * side
        yield x, y
