"""What the kernel says of a CAN interface: state and bit rate."""

import json
import shutil
from subprocess import TimeoutExpired, run
from typing import Final

from hil.cell.rig.sensor import CanBus
from hil.doctor.finding import Finding, Verdict

LIMIT: Final = 5.0
STATES: Final = {
    "ERROR-ACTIVE": (Verdict.OK, ""),
    "ERROR-WARNING": (Verdict.WARN, "errors on the bus: check termination, cable and bit rate"),
    "ERROR-PASSIVE": (Verdict.FAIL, "nobody acknowledges: check termination, power and bit rate"),
    "BUS-OFF": (Verdict.FAIL, "ip link set {0} type can restart-ms 100; check wires and bit rate"),
    "STOPPED": (Verdict.FAIL, "ip link set {0} up type can bitrate {1:.0f}"),
}
"""Fault confinement states (ISO 11898-1) as `ip -details link` writes them."""


def kernel_interface(can: CanBus) -> Finding:
    """State and bit rate of the rig's socketcan interface."""
    if shutil.which("ip") is None:
        return Finding("can bus", Verdict.WARN, "no `ip` command", "apt-get install iproute2")
    command = ["ip", "-details", "-json", "link", "show", "dev", can.channel]
    try:
        asked = run(command, capture_output=True, text=True, timeout=LIMIT, check=False)
    except TimeoutExpired:
        return Finding("can bus", Verdict.WARN, "`ip` did not answer", "look at `ip link` yourself")
    if asked.returncode:
        return Finding("can bus", Verdict.FAIL, f"no interface '{can.channel}'", "plug it in")
    return judged(asked.stdout, can)


def judged(text: str, can: CanBus) -> Finding:
    """The finding in what `ip -details -json link show` printed."""
    (link,) = json.loads(text)
    kind = link.get("linkinfo", {}).get("info_kind")
    if "UP" not in link.get("flags", []):
        advice = f"ip link set {can.channel} up type can bitrate {can.bitrate:.0f}"
        return Finding("can bus", Verdict.FAIL, f"{can.channel} is down", advice)
    if kind == "vcan":
        return Finding("can bus", Verdict.OK, f"{can.channel} is virtual: no state, no bit rate")
    details = link["linkinfo"].get("info_data", {})
    rate = details.get("bittiming", {}).get("bitrate")
    state = details.get("state", "unknown")
    found = f"{can.channel}: {state}, {rate or 'unknown'} bit/s"
    if rate is not None and rate != round(can.bitrate):
        advice = f"set the interface or can.bitrate: the rig says {can.bitrate:.0f} bit/s"
        return Finding("can bus", Verdict.FAIL, found, advice)
    verdict, advice = STATES.get(state, (Verdict.WARN, "look at `ip -details link`"))
    return Finding("can bus", verdict, found, advice.format(can.channel, can.bitrate))
