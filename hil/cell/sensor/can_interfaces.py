"""Which kernel CAN interfaces this host has, and a UDP port that nobody uses."""

import socket
from pathlib import Path
from typing import Final

ARPHRD_CAN: Final = 280
IFF_UP: Final = 0x1
NETWORK_DEVICES: Final = Path("/sys/class/net")


def up_can_interfaces(devices: Path = NETWORK_DEVICES) -> list[str]:
    """Names of CAN interfaces that are up, sorted; [] on a host without sysfs."""
    if not devices.is_dir():
        return []
    return sorted(device.name for device in devices.iterdir() if _is_up_can(device))


def _is_up_can(device: Path) -> bool:
    try:
        kind = int((device / "type").read_text())
        # operstate says "unknown" for vcan; the flags tell.
        flags = int((device / "flags").read_text(), base=16)
    except (OSError, ValueError):
        return False
    return kind == ARPHRD_CAN and bool(flags & IFF_UP)


def free_udp_port() -> int:
    """A UDP port that was free a moment ago."""
    with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as probe:
        probe.bind(("", 0))
        port: int = probe.getsockname()[1]
        return port
