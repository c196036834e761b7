"""Whether samples look like a gauge's at all; catches a stuck value behind a running counter."""

from typing import Final, NamedTuple

from drivers.errors import BlankSignalError, FlatSignalError
from drivers.interfaces import Vector6

ZERO: Final[Vector6] = (0.0,) * 6


class Plausible(NamedTuple):
    """Longest runs that are believed, in samples; 0 switches a check off.

    flat: identical samples. Noise of 0.3 counts an axis repeats all six with probability 0.3 at
    most, so 20 in a row come by chance once in months at 1 kHz; a typical 3 counts never do it.
    blank: zeros on every axis. Typical noise around a perfect zero gives one by chance every few
    minutes, five in a row never; a sensor that is quieter than half a count needs more, or 0.
    """

    flat: int = 20
    blank: int = 5


TYPICAL: Final = Plausible()
"""For a strain-gauge sensor with some counts of noise."""
OFF: Final = Plausible(0, 0)
"""For a sensor that makes no noise, as an emulated one may."""


class Plausibility:
    """Watches every sample as the wire brought it, and remembers the longest runs."""

    __slots__ = ("_flat", "_last", "_limits", "_run", "_told", "_zeros")

    def __init__(self, limits: Plausible) -> None:
        if min(limits) < 0 or 1 in limits:
            raise ValueError(f"{limits}: runs are 0 for off, or at least 2 samples")
        self._limits = limits
        self.restart()

    def restart(self) -> None:
        """Forget what was seen, as after a start."""
        self._last: Vector6 | None = None
        self._run = self._flat = self._zeros = 0
        self._told = False

    def watch(self, wrench: Vector6) -> None:
        """Take the next sample."""
        if wrench != self._last:
            if self._told:
                self._flat = self._zeros = 0
            self._last, self._run, self._told = wrench, 1, False
            return
        self._run += 1
        self._told = False
        self._flat = max(self._flat, self._run)
        if wrench == ZERO:
            self._zeros = max(self._zeros, self._run)

    def check(self) -> None:
        """Raise for a run since the last check that is too long, or that still lasts."""
        flat, zeros = self._flat, self._zeros
        if not flat:
            return
        if self._run == 1:  # over: told once
            self._flat = self._zeros = 0
        else:
            self._told = True
        limits = self._limits
        if 0 < limits.blank <= zeros:
            raise BlankSignalError(
                f"{zeros} samples in a row are zero on every axis, believed are "
                f"{limits.blank - 1}: check gauges, amplifier and cable"
            )
        if 0 < limits.flat <= flat:
            raise FlatSignalError(
                f"{flat} samples in a row are the same, believed are {limits.flat - 1}: "
                f"the value is stuck at {self._last}"
            )
