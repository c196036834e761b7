"""The cable's chain inside a MuJoCo state: hung into the jaws, taken away, read and resisted."""

from math import atan2, cos, sin

import mujoco
import numpy as np
from numpy.typing import NDArray

from hil.cell.plant import slip
from hil.cell.plant.grip import Grip
from hil.cell.plant.mating import TerminalFriction
from hil.cell.plant.mjcf_contact import CABLE, CONNECTOR
from hil.cell.plant.slip import STUCK, PadState
from hil.cell.rig import Rig


class GrippedCable:
    """Indices and laws of the chain; the model's springs and frame are its memory."""

    def __init__(self, rig: Rig, model: mujoco.MjModel, state: mujoco.MjData) -> None:
        self._model, self._state = model, state
        self._pad = rig.pad
        self._terminals = TerminalFriction(rig.connector)
        self._plate = rig.cable.free_length / rig.cable.segments
        self._jaws = model.body("jaws").id
        self._jaws_rest = model.body_pos[self._jaws].copy()
        self._geoms = _cable_geoms(model, rig.cable.segments)
        self._first = int(model.joint("pad_y").qposadr[0])
        pads = (int(model.joint(n).qposadr[0]) for n in ("pad_x", "pad_z", "pad_tilt"))
        self._x, self._z, self._tilt = pads
        tip = model.body("tip").id
        self._tip_origin = state.xpos[tip]  # (3,)
        self._tip_rotation = state.xmat[tip]  # (9,)
        self._push = state.xfrc_applied[tip]  # (6,)
        self.rest = STUCK

    def hang(self, grip: Grip) -> None:
        """Put a straight cable into the jaws, held as `grip` says, and let it touch."""
        offset = np.array((grip.x, grip.y, grip.z))
        self._model.body_pos[self._jaws] = self._jaws_rest + offset
        half = grip.theta / 2
        self._model.body_quat[self._jaws] = (cos(half), 0.0, 0.0, sin(half))
        self._straighten()
        self._appear(contype=CABLE, conaffinity=CONNECTOR, opacity=1.0)

    def remove(self) -> None:
        """Take the cable away: what remains of the chain is weightless and touches nothing."""
        self._straighten()
        self._appear(contype=0, conaffinity=0, opacity=0.0)

    def tip(self) -> tuple[tuple[float, float, float], float]:
        """Middle of the tip's edge in the task frame, m, and its rotation about z, rad."""
        x, y, z = self._tip_origin.tolist()
        r = self._tip_rotation.tolist()
        h = self._plate
        return (x - h * r[2], y - h * r[5], z - h * r[8]), atan2(r[3], r[0])

    def resist(self) -> None:
        """Set the terminals' force on the tip for the next millisecond.

        As an applied force on the body, which the sensor feels; a joint force it would not.
        """
        self._push[2] = self._terminals.force(self.tip()[0][2])

    def let_go(self) -> None:
        """Free of the terminals."""
        self._terminals.release()
        self._push[2] = 0.0

    def slip_load(self) -> float:
        """Share of the jaws' friction that the cable uses."""
        return slip.load(self._pad, self._root(), self.rest)

    def slip(self) -> None:
        """Let the cable slide where the jaws no longer hold it."""
        self.rest = slip.slipped(self._pad, self._root(), self.rest)
        self._set_rest(self.rest)

    def shift(self, dz: float) -> None:
        """Let the cable slide by dz along the jaws, m; positive is up into them."""
        self.rest = self.rest._replace(z=self.rest.z + dz)
        self._set_rest(self.rest)

    def _root(self) -> PadState:
        q = self._state.qpos
        return PadState(float(q[self._x]), float(q[self._z]), float(q[self._tilt]))

    def _set_rest(self, rest: PadState) -> None:
        spring = self._model.qpos_spring
        spring[self._x], spring[self._z], spring[self._tilt] = rest

    def _straighten(self) -> None:
        self._state.qpos[self._first :] = 0.0
        self._state.qvel[self._first :] = 0.0
        self.rest = STUCK
        self._set_rest(STUCK)
        self.let_go()

    def _appear(self, contype: int, conaffinity: int, opacity: float) -> None:
        self._model.geom_contype[self._geoms] = contype
        self._model.geom_conaffinity[self._geoms] = conaffinity
        self._model.geom_rgba[self._geoms, 3] = opacity


def _cable_geoms(model: mujoco.MjModel, segments: int) -> NDArray[np.intp]:
    return np.array([model.geom(f"cable{i}").id for i in range(segments)], dtype=np.intp)
