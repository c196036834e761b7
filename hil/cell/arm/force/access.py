"""Force control as a program may use it: `ForcePort` on the control box."""

from typing import Final

from hil.cell.arm.box import ControlBox
from hil.cell.arm.force.mode import Selection, Task
from hil.cell.arm.pose import Vector3, Vector6, of

WATCHED: Final = "external_force_torque"
SLOWEST: Final = 10.0
"""Hz: the watchdog that a program gets with external force input if it has set none (Script
Manual, ft_rtde_input_enable); the program pauses when the input falls silent."""


class ForceAccess:
    __slots__ = ("_box",)

    def __init__(self, box: ControlBox) -> None:
        self._box = box

    @property
    def freedrive(self) -> bool:
        return self._box.force_mode.freedrive

    def wrench(self) -> Vector6:
        return self._box.estimate.wrench

    def zero(self) -> None:
        self._box.estimate.zero()

    def believe(self, external: bool, at: Vector3) -> None:
        box = self._box
        box.estimate.believe(external, at)
        if external and box.watchdog.idle:
            box.watchdog.watch(WATCHED, SLOWEST, "pause", box.t)
        elif not external:
            box.watchdog.forget(WATCHED)

    def start(
        self, frame: Vector6, selection: Selection, wrench: Vector6, kind: int, limits: Vector6
    ) -> None:
        self._box.force_mode.start(Task(of(frame), selection, wrench, kind, limits))

    def release(self, frame: Vector6, selection: Selection) -> None:
        self._box.force_mode.release(of(frame), selection)

    def end(self) -> None:
        self._box.force_mode.end()

    def damp(self, damping: float) -> None:
        self._box.force_mode.tune(damping=damping)

    def scale(self, gain: float) -> None:
        self._box.force_mode.tune(gain=gain)

    def cycles_since_contact(self, direction: Vector3) -> int:
        return self._box.contact.cycles_since(direction)

    def joints_before(self, cycles: int) -> Vector6:
        return self._box.contact.joints(cycles)
