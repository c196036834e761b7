"""The robot's position over the force window, freed of its standing offset."""

PLAUSIBLE = 5.0
"""Multiples of the gate that a standing offset may have."""


class MeasuredPosition:
    """Averages two readings, as the force is a mean over the period between them.

    gate: m; a position further than this from the command is ignored. rest: periods at the start
    in which the axis stands still and learns how far the robot stays off its command.
    """

    __slots__ = ("_before", "_count", "_gate", "_offset", "_rest", "_whole")

    def __init__(self, gate: float, rest: int) -> None:
        self._gate = gate
        self._whole = rest
        self.reset()

    def reset(self) -> None:
        self._rest = self._whole
        self._offset = 0.0
        self._count = 0
        self._before: float | None = None

    @property
    def resting(self) -> bool:
        return self._rest > 0

    def rest(self, position: float | None, command: float) -> None:
        """One period at rest, m."""
        self._rest -= 1
        if position is not None and abs(position - command) <= PLAUSIBLE * self._gate:
            self._count += 1
            self._offset += (position - command - self._offset) / self._count

    def over_window(self, position: float | None, command: float) -> float | None:
        """Mean position of the last period, m; None without two plausible readings."""
        before, self._before = self._before, position
        if position is None or before is None:
            return None
        mean = 0.5 * (position + before) - self._offset
        return mean if abs(mean - command) <= self._gate else None
