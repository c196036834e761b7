"""The least of a sliding window of past values, at constant cost a step."""

from collections import deque
from math import inf

from hil.monitors.formula import Window


class Minimum:
    """Minimum over the window's steps that have been; +inf where none has."""

    __slots__ = ("_candidates", "_delayed", "_far", "_step", "_window")

    def __init__(self, window: Window) -> None:
        self._window = window
        self._delayed: deque[float] = deque()
        self._candidates: deque[tuple[int, float]] = deque()  # rising values, oldest first
        self._step = -1

    def take(self, value: float) -> float:
        """The minimum after one more step."""
        self._step += 1
        near, far = self._window
        self._delayed.append(value)
        if len(self._delayed) > near:
            self._admit(self._step - near, self._delayed.popleft())
        if far is not None:
            while self._candidates and self._candidates[0][0] < self._step - far:
                self._candidates.popleft()
        return self._candidates[0][1] if self._candidates else inf

    def _admit(self, step: int, value: float) -> None:
        """An older value that is not smaller can never be the minimum again."""
        while self._candidates and self._candidates[-1][1] >= value:
            self._candidates.pop()
        self._candidates.append((step, value))
