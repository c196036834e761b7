"""The stage: the arm's position loop along x, y, z and about z, as all plants share it.

Each axis is a critically damped second-order lag, M q'' = M w^2 (target - q) - 2 M w q' + load, so
a contact force pushes the stage back as a real joint servo gives way: by load / (M w^2).
"""

from math import pi

from hil.cell.rig.robot import Servo

MASS = 5.0
"""Moving mass of a linear axis, kg (assumed: it gives 95 N/mm of servo stiffness at 22 Hz)."""
INERTIA = 0.05
"""Moment of inertia about z, kg·m^2 (assumed)."""


def frequency(servo: Servo) -> float:
    """Natural frequency w, rad/s."""
    return 2 * pi * servo.bandwidth
