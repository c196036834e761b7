"""What a wrist sensor feels: contact at the tip, the tool's weight and its inertia.

For the plants without a rigid-body engine. Scalars only: Python calls it, numba compiles it.
"""

from math import cos, sin
from typing import NamedTuple, TypeAlias

from numba.extending import register_jitable

from hil.cell.plant.mjcf_stage import TOOL_INERTIA
from hil.cell.rig.parts import Tool

GRAVITY = 9.81

Vector3: TypeAlias = tuple[float, float, float]
Vector6: TypeAlias = tuple[float, float, float, float, float, float]


class ToolLoad(NamedTuple):
    """Mass, kg; its centre and the TCP below the sensor, m; inertia about z, kg·m^2."""

    mass: float
    centre_of_mass: float
    length: float
    inertia: float


def tool_load(tool: Tool) -> ToolLoad:
    return ToolLoad(tool.mass, tool.centre_of_mass, tool.length, TOOL_INERTIA[2])


@register_jitable
def into_sensor(v: Vector3, theta: float) -> Vector3:
    """A task-frame vector in the axes of a sensor turned by theta and facing down."""
    c, s = cos(theta), sin(theta)
    return c * v[0] + s * v[1], s * v[0] - c * v[1], -v[2]


@register_jitable
def sensor_wrench(
    tool: ToolLoad, theta: float, contact: Vector6, tip: Vector3, acceleration: Vector3
) -> Vector6:
    """Wrench on the tool at the sensor, in its frame, N and N·m.

    contact: force on the tip and moment about it; tip: against the TCP; acceleration of the
    stage, m/s^2: all in the task frame.
    """
    fx, fy, fz = into_sensor((contact[0], contact[1], contact[2]), theta)
    mx, my, mz = into_sensor((contact[3], contact[4], contact[5]), theta)
    x, y, below = into_sensor(tip, theta)
    z = tool.length + below
    ax, ay, az = acceleration
    gx, gy, gz = into_sensor((-ax, -ay, -GRAVITY - az), theta)
    m, lever = tool.mass, tool.mass * tool.centre_of_mass
    return (
        fx + m * gx,
        fy + m * gy,
        fz + m * gz,
        mx + y * fz - z * fy - lever * gy,
        my + z * fx - x * fz + lever * gx,
        mz + x * fy - y * fx,
    )
