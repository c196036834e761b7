"""The search task on the whole cell as a gymnasium environment, beside the one on fast worlds."""

from typing import Final

import gymnasium

from hil.app.world import CellWorld
from hil.cell.rig import Rig
from learner.environment.flat_cable import FlatCable

NAME: Final = "hil/FlatCableCell-v0"


def over_the_wire(rig: Rig, *, forces: bool = True, render_mode: str | None = None) -> FlatCable:
    """The environment on a rig's cell: actions go out over RTDE, forces come in over CAN."""
    return FlatCable(CellWorld(rig), forces=forces, render_mode=render_mode)


def register() -> str:
    """From now on `gymnasium.make(NAME, rig=...)` works in this process; NAME."""
    if NAME not in gymnasium.registry:
        gymnasium.register(NAME, entry_point=f"{__name__}:over_the_wire")
    return NAME
