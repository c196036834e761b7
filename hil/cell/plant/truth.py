"""What the model knows about the part: its place in words, and the truth of empty jaws."""

from hil.cell.plant.grip import Grip, Stage
from hil.cell.plant.interface import Contact, PartTruth
from hil.cell.rig.parts import Connector

BOTTOM_BAND = 20e-6
"""A tip this near the slot's floor counts as on it, m."""


def empty(stage: Stage, contact: Contact = Contact.FREE) -> PartTruth:
    """Truth without a part: the tip is the TCP."""
    x, y, z, theta = stage
    return PartTruth(None, (x, y, z), theta, 0.0, (0.0, 0.0, 0.0), contact)


class Observer:
    """Reads tip poses against one connector."""

    def __init__(self, connector: Connector) -> None:
        self._half_x = connector.width / 2 + connector.chamfer
        self._half_y = connector.height / 2 + connector.chamfer
        self._floor = connector.depth - BOTTOM_BAND
        self._lead_in = connector.chamfer

    def part(
        self, grip: Grip, slip: float, tip: tuple[float, float, float], theta: float, touches: bool
    ) -> PartTruth:
        """Truth of a gripped part whose tip is at `tip` and which slid by `slip` m in the jaws."""
        depth = self.depth(tip)
        held = (grip.x + slip, grip.y, grip.theta)
        return PartTruth(grip.name, tip, theta, depth, held, self._contact(depth, touches))

    def depth(self, tip: tuple[float, float, float]) -> float:
        """How far the tip is in the slot, m; 0 beside its mouth, where below is not inside."""
        x, y, z = tip
        return max(0.0, -z) if abs(x) < self._half_x and abs(y) < self._half_y else 0.0

    def _contact(self, depth: float, touches: bool) -> Contact:
        if depth >= self._floor:
            return Contact.BOTTOM
        if depth > self._lead_in:
            return Contact.SLOT
        return Contact.FACE if touches else Contact.FREE
