"""What a rig of real devices must name, since there is no cell that could choose it."""

from typing import TYPE_CHECKING, Final

if TYPE_CHECKING:
    from hil.cell.rig.rig import Rig

NEEDED: Final = ("dashboard", "secondary", "rtde")
"""Ports that the arm's driver opens."""


def unnamed(rig: "Rig") -> str:
    """Why a real rig's devices cannot be reached or paced; "" when they can."""
    if rig.clock != "wall":
        return "clock must be wall: real devices do not wait for lockstep"
    free = [name for name in NEEDED if not getattr(rig.robot.ports, name)]
    if free:
        return f"robot.ports.{free[0]} must be a real port, not 0"
    return _on_tcp(rig) if rig.sensor.wire == "tcp" else _on_can(rig)


def _on_tcp(rig: "Rig") -> str:
    if not rig.sensor.tcp.host:
        return "sensor.tcp.host must be the sensor's address"
    return "" if rig.sensor.tcp.port else "sensor.tcp.port must be a real port, not 0"


def _on_can(rig: "Rig") -> str:
    if rig.can.interface in {"auto", "virtual"}:
        return f"can.interface must be the adapter's (socketcan, pcan, ..), not {rig.can.interface}"
    if rig.can.interface != "config" and not rig.can.channel:
        return f"can.channel must say which {rig.can.interface}: can0, PCAN_USBBUS1, .."
    return ""
