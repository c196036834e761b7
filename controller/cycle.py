"""What the controller knows in one period."""

from typing import NamedTuple

from controller.place import Place
from drivers.interfaces import ArmState, Vector6, WrenchReading


class Cycle(NamedTuple):
    """t: arm time, ns. state, reading: as the drivers gave them.

    wrench: mean of the last 8 ms, N and N·m, push of the environment on the tool, task frame.
    stage: actual TCP in the task frame.
    """

    t: int
    state: ArmState
    reading: WrenchReading
    wrench: Vector6
    stage: Place
