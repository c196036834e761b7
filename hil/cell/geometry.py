"""Between the arm's flange in its base frame and the plant's stage in the task frame.

The plant's stage has x, y, z and rotation about the task's z. What the arm tilts beyond that is
carried along kinematically: it shows in the arm's pose, contact does not feel it.
"""

from math import atan2, cos, remainder, sin, tau
from typing import TypeAlias

from hil.cell.arm.pose import Pose, Rotation, Vector3

Stage: TypeAlias = tuple[float, float, float, float]


def turn_about_z(angle: float, matrix: Rotation) -> Rotation:
    """Rz(angle) times matrix."""
    c, s = cos(angle), sin(angle)
    first, second, third = matrix
    return (
        (c * first[0] - s * second[0], c * first[1] - s * second[1], c * first[2] - s * second[2]),
        (s * first[0] + c * second[0], s * first[1] + c * second[1], s * first[2] + c * second[2]),
        third,
    )


class TaskGeometry:
    """Where the connector stands in the base frame, and how far the tip is from the flange."""

    def __init__(self, connector: Vector3, rotation: float, tool_length: float) -> None:
        self._origin = connector
        self._angle = rotation
        self._cos, self._sin = cos(rotation), sin(rotation)
        self._length = tool_length

    def stage(self, flange: Pose) -> Stage:
        """The tip's place in the task frame; theta within half a turn of the connector's."""
        (px, py, pz), rotation = flange
        length = self._length
        x = px + length * rotation[0][2] - self._origin[0]
        y = py + length * rotation[1][2] - self._origin[1]
        z = pz + length * rotation[2][2] - self._origin[2]
        theta = remainder(atan2(rotation[1][0], rotation[0][0]) - self._angle, tau)
        return self._cos * x + self._sin * y, self._cos * y - self._sin * x, z, theta

    def flange(self, stage: Stage, target: Pose, target_stage: Stage) -> Pose:
        """The flange that puts the tip at `stage`, tilted as `target` (at target_stage) is."""
        rotation = turn_about_z(stage[3] - target_stage[3], target.rotation)
        x = self._origin[0] + self._cos * stage[0] - self._sin * stage[1]
        y = self._origin[1] + self._sin * stage[0] + self._cos * stage[1]
        z = self._origin[2] + stage[2]
        length = self._length
        position = (
            x - length * rotation[0][2],
            y - length * rotation[1][2],
            z - length * rotation[2][2],
        )
        return Pose(position, rotation)

    def to_base(self, v: Vector3) -> Vector3:
        """A free vector of the task frame in the base frame."""
        return self._cos * v[0] - self._sin * v[1], self._sin * v[0] + self._cos * v[1], v[2]
