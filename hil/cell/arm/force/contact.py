"""When the tool came into contact: the last cycles' joint angles and forces, and a threshold.

Script Manual, tool_contact: the answer counts the control cycles back to just before the contact
began, so that a program can return to where the arm was then.
"""

from collections import deque
from math import hypot
from typing import Final

from hil.cell.arm.force.estimate import ForceEstimate
from hil.cell.arm.pose import Vector3, Vector6

CYCLES: Final = 1000
"""How far back a program can look; assumed."""

THRESHOLDS: Final = (15.0, 5.0)
"""N against the direction that make a contact, on CB3 and the e-Series; assumed, ten times the
estimate's noise."""

_ONSET: Final = 0.2
"""Part of the threshold under which the tool was free."""


class ContactHistory:
    """Joint angles, rad, and true force on the TCP, N, base axes, of the last cycles."""

    __slots__ = ("_estimate", "_past", "threshold")

    def __init__(self, estimate: ForceEstimate, threshold: float) -> None:
        self._estimate = estimate
        self._past: deque[tuple[Vector6, Vector6]] = deque(maxlen=CYCLES)
        self.threshold = threshold

    def note(self, q: Vector6, force: Vector6) -> None:
        """Remember one cycle."""
        self._past.append((q, force))

    def joints(self, cycles_ago: int) -> Vector6:
        """Joint angles that long ago, rad; ValueError beyond what is remembered."""
        if not 0 <= cycles_ago < len(self._past):
            raise ValueError(f"{cycles_ago} cycles back, remembered are {len(self._past)}")
        return self._past[-1 - cycles_ago][0]

    def cycles_since(self, direction: Vector3) -> int:
        """Cycles back to just before a contact that resists motion along `direction` (base axes).

        0 without a contact; a direction of length 0 means any.
        """
        if _resistance(self._estimate.wrench, direction) < self.threshold:
            return 0
        # The estimate's offset is constant over a contact, its noise, with which it met the
        # threshold, is not: one draw too high and no past cycle would count as free.
        offset = self._offset(self._estimate.mean)
        for ago, (_, force) in enumerate(reversed(self._past)):
            felt = (force[0] + offset[0], force[1] + offset[1], force[2] + offset[2])
            if ago and _resistance(felt, direction) < _ONSET * self.threshold:
                return ago
        return max(1, len(self._past) - 1)

    def _offset(self, wrench: Vector6) -> Vector3:
        _, now = self._past[-1]
        return (wrench[0] - now[0], wrench[1] - now[1], wrench[2] - now[2])


def _resistance(wrench: Vector6 | Vector3, direction: Vector3) -> float:
    """Force against `direction`, N; its magnitude if there is no direction."""
    (x, y, z), (dx, dy, dz) = wrench[:3], direction
    length = hypot(dx, dy, dz)
    if length < 1e-9:
        return hypot(x, y, z)
    return -(x * dx + y * dy + z * dz) / length
