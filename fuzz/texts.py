"""Targets of what people write: rig files, bus addresses, monitor formulas."""

from contextlib import suppress

from drivers.protocol.bus_address import BusAddress
from fuzz.target import Target
from hil.cell.errors import RigError
from hil.cell.rig import parse as parse_rig
from hil.monitors.errors import MonitorError
from hil.monitors.monitor import Monitor

SIGNALS = {"f_z": 1.0, "depth": 1e-3}


def check_rig(octets: bytes) -> None:
    with suppress(RigError):
        parse_rig(octets.decode("utf-8", "replace"))


def check_bus_address(octets: bytes) -> None:
    interface, _, channel = octets.decode("utf-8", "replace").partition(" ")
    try:
        options = BusAddress(interface, channel).options()
    except ValueError:
        return
    assert set(options) <= {"interface", "channel", "port", "hop_limit"}


def check_formula(octets: bytes) -> None:
    """Read the formula and, if it can be read, judge a few steps by it."""
    try:
        monitor = Monitor(octets.decode("utf-8", "replace"), SIGNALS)
    except MonitorError:
        return
    for f_z in (0.0, -1e300, float("nan"), float("inf")):
        monitor.step({"f_z": f_z, "depth": 0.0})


TARGETS = {
    "rig": Target(
        check_rig,
        (b"name: a\nphysics: {plant: wall}\n", b"name: a\nrobot: {series: cb3, home: [1 deg]}\n"),
        (b"sensor:", b"latency:", b"18.5 mm", b"&a [*a]", b"!!python/none", b"{mean: 1 ms}"),
    ),
    "bus-address": Target(
        check_bus_address, (b"udp_multicast 239.74.1.2:4", b"socketcan vcan0"), (b":",)
    ),
    "formula": Target(
        check_formula,
        (b"f_z <= 10 and once[0:5] depth > 0.1", b"historically not (f_z < -2 * depth)"),
        (b"->", b"previously", b"or ", b"|f_z|", b"[1:2]"),
    ),
}
