"""The cable sliding between the jaws: Coulomb return mapping on the pad's springs.

The pad's spring force is held to the friction limit by moving the spring's rest, so the cable
stays where it slid to. Force in the jaws' plane (x, z) and torque about their closing axis (y)
have each their own limit.
"""

from math import hypot
from typing import NamedTuple

from hil.cell.rig.parts import Pad


class PadState(NamedTuple):
    """Along x, z and about y: where the cable's root is, or where its springs rest. m, m, rad."""

    x: float
    z: float
    tilt: float


STUCK = PadState(0.0, 0.0, 0.0)


def load(pad: Pad, root: PadState, rest: PadState) -> float:
    """Share of the friction limit that the pad carries; above 1 the cable slips."""
    return max(_force_share(pad, root, rest), _torque_share(pad, root, rest))


def slipped(pad: Pad, root: PadState, rest: PadState) -> PadState:
    """The springs' rest after slip: unchanged within the limits, on the limit beyond them."""
    force = max(1.0, _force_share(pad, root, rest))
    torque = max(1.0, _torque_share(pad, root, rest))
    return PadState(
        root.x - (root.x - rest.x) / force,
        root.z - (root.z - rest.z) / force,
        root.tilt - (root.tilt - rest.tilt) / torque,
    )


def _force_share(pad: Pad, root: PadState, rest: PadState) -> float:
    along_x = pad.stiffness_x * (root.x - rest.x)
    along_z = pad.stiffness_z * (root.z - rest.z)
    return hypot(along_x, along_z) / pad.slip_force


def _torque_share(pad: Pad, root: PadState, rest: PadState) -> float:
    return abs(pad.stiffness_rotation * (root.tilt - rest.tilt)) / pad.slip_torque
