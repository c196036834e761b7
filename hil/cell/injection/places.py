"""Which places a rig has, and why a fault has none in it."""

from collections.abc import Collection
from typing import Final

from hil.cell.errors import FaultError
from hil.cell.faults.row import Place
from hil.cell.faults.schedule import Fault, Numbered
from hil.cell.faults.trigger import never
from hil.cell.rig import Rig

OF_THE_CELL: Final = frozenset(
    (Place.RTDE, Place.ROBOT, Place.BUS, Place.SENSOR, Place.GRIPPER, Place.PLANT)
)
NEAR: Final = frozenset((Place.HOST, Place.POLICY, Place.AGENTS))
"""On the near side of the wire: neither side hears of the other's faults."""
OF_A_RUN: Final = OF_THE_CELL | {Place.HOST, Place.POLICY}
"""With the near side of an assembly, whose policy does not learn."""
OF_A_TRAINING: Final = OF_A_RUN | {Place.AGENTS}
"""With a parallel learner in the near side's process."""
_WITH_JAWS: Final = ("mujoco", "analytic", "wall")
_MUJOCO_ONLY: Final = ("P2", "P3", "P4")


def check(
    faults: Numbered, rig: Rig, places: Collection[Place] = OF_THE_CELL, episodes: int = 1
) -> None:
    """FaultError for the first fault that this run has no place for, or that can never begin."""
    if rig.rig == "real":
        raise FaultError(f"rig '{rig.name}' names real devices: faults are for emulated cells")
    for index, fault in faults:
        near = fault.row.place in NEAR
        others = {one.kind for n, one in faults if n != index and (one.row.place in NEAR) is near}
        reason = _missing(fault, rig, places) or never(
            fault.trigger, rig.robot.period, episodes, others
        )
        if reason:
            raise FaultError(f"faults[{index}]: {fault.kind} {fault.row.name}: {reason}")


def _missing(fault: Fault, rig: Rig, places: Collection[Place]) -> str:
    place, plant = fault.row.place, rig.physics.plant
    if place not in places:
        there = ", ".join(sorted(places))
        return f"this run has no {place} that could fail (it has: {there})"
    if place is Place.BUS and rig.sensor.wire != "can":
        return f"the rig has no CAN bus: its sensor is read over {rig.sensor.wire}"
    if fault.kind == "C9" and rig.sensor.frames != "classic":
        return f"frames are {rig.sensor.frames}: a wrench is one frame and has no halves"
    if place in (Place.GRIPPER, Place.PLANT) and plant not in _WITH_JAWS:
        return (
            f"plant '{plant}' has neither jaws nor parts (those that do: {', '.join(_WITH_JAWS)})"
        )
    slips = fault.kind == "G1" and fault.word("what") == "slip"
    if plant != "mujoco" and (fault.kind in _MUJOCO_ONLY or slips):
        return f"plant '{plant}' has no place for it, physics.plant: mujoco has"
    return ""
