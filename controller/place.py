"""Where the TCP is or shall be, in the task frame."""

from typing import NamedTuple


class Place(NamedTuple):
    """TCP in the task frame: x, y, z in m, theta in rad about the frame's z.

    The origin is the middle of the slot's mouth, z points out of the connector's face, x lies
    along the slot's long side. The tool points down.
    """

    x: float
    y: float
    z: float
    theta: float

    def at(self, z: float) -> "Place":
        """The same place at another height, m."""
        return self._replace(z=z)

    def moved(
        self, dx: float = 0.0, dy: float = 0.0, dz: float = 0.0, dtheta: float = 0.0
    ) -> "Place":
        return Place(self.x + dx, self.y + dy, self.z + dz, self.theta + dtheta)
