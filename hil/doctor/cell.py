"""Every check of a rig's devices, emulated and up or real, in the order of what needs what."""

from collections.abc import Iterator

from hil.cell.rig import Rig
from hil.doctor import host, robot, wrist
from hil.doctor.finding import Finding


def findings(rig: Rig) -> Iterator[Finding]:
    """Nothing here moves the arm or sets a zero; the sensor is asked to stream."""
    yield from robot.findings(rig.robot)
    yield from wrist.findings(rig)
    yield host.jitter(rig.robot.period * 1e-9)
    yield host.priority()
