"""A controlled stop and the proof that the arm stands still."""

from math import hypot

from drivers.errors import DriverError
from drivers.interfaces import Arm

REST_SPEED = 1e-3
"""m/s and rad/s below which the arm counts as standing still."""
LONGEST = 1.0
"""s of arm time within which it must."""


def come_to_rest(arm: Arm) -> bool:
    """Stop the arm and watch it; False when its standstill could not be seen.

    The request is repeated every period, as an arm in lockstep moves on only when it is told
    something. After a protective stop or on a dead link nothing can be seen: the robot's own
    safety system has stopped it, or its program's watchdog does.
    """
    try:
        arm.stop()
        for _ in range(max(1, round(LONGEST * 1e9 / arm.period))):
            twist = arm.read().twist
            arm.stop()
            if hypot(*twist[:3]) < REST_SPEED and hypot(*twist[3:]) < REST_SPEED:
                return True
    except DriverError:
        return False
    return False
