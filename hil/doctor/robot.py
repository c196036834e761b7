"""Whether the rig's control box answers, is the one that the rig names, and keeps its rate."""

import socket
from collections.abc import Iterator
from contextlib import closing
from itertools import pairwise
from time import perf_counter
from typing import Final, NamedTuple

from drivers.errors import DriverError
from drivers.protocol.rtde_setup import ControllerVersion
from drivers.ur.connection import RtdeConnection
from drivers.ur.dashboard import Dashboard
from hil.cell.rig.real import NEEDED
from hil.cell.rig.robot import FIRST_E_SERIES, Robot
from hil.doctor.finding import Finding, Verdict

LIMIT: Final = 2.0
"""Wall seconds for any answer."""
UNUSED: Final = "input_bit_register_127"
"""The client agrees on inputs too; the last bit register is nobody's, and stays untouched."""
SPAN: Final = 2.0
"""Seconds of RTDE packages looked at."""
UP: Final = "start it (`hil up RIG` for an emulated cell), check robot.host, robot.ports, firewall"


def findings(robot: Robot) -> Iterator[Finding]:
    """Ports first; what lies behind a port is asked only where it answers."""
    silent = set()
    for name, port in robot.ports.model_dump().items():
        finding = reach(robot.host, name, port)
        if finding.verdict is not Verdict.OK:
            silent.add(name)
        yield finding
    if "dashboard" not in silent:
        yield from dashboard(robot)
    if "rtde" not in silent:
        yield from rtde(robot)


def reach(host: str, name: str, port: int) -> Finding:
    """One TCP connection to a port of the control box."""
    bad = Verdict.FAIL if name in NEEDED else Verdict.WARN
    if not port:
        return Finding(name, bad, "port 0 in the rig", f"set robot.ports.{name} to the real one")
    try:
        socket.create_connection((host, port), timeout=LIMIT).close()
    except OSError as error:
        reason = error.strerror or f"no answer within {LIMIT:g} s"
        return Finding(name, bad, f"{host}:{port}: {reason.lower()}", UP)
    return Finding(name, Verdict.OK, f"{host}:{port} answers")


def dashboard(robot: Robot) -> Iterator[Finding]:
    """What the dashboard says of modes; on the e-Series also whether it may be commanded."""
    try:
        with closing(Dashboard(robot.host, robot.ports.dashboard, LIMIT)) as line:
            mode = line.request("robotmode")
            yield _mode(mode)
            yield _safety(line.request("safetymode"))
            if robot.series == "e-series":
                yield remote(line.request("is in remote control"))
    except DriverError as error:
        yield Finding("dashboard", Verdict.FAIL, str(error), UP)


def _mode(reply: str) -> Finding:
    mode = reply.removeprefix("Robotmode: ")
    if mode in {"RUNNING", "IDLE", "POWER_OFF"}:
        return Finding("robot mode", Verdict.OK, mode)
    advice = "wait until it has booted; look at the teach pendant"
    return Finding("robot mode", Verdict.WARN, mode, advice)


def _safety(reply: str) -> Finding:
    mode = reply.removeprefix("Safetymode: ")
    if mode in {"NORMAL", "REDUCED"}:
        return Finding("safety mode", Verdict.OK, mode)
    advice = "remove the cause, then release it on the teach pendant"
    return Finding("safety mode", Verdict.FAIL, mode, advice)


def remote(reply: str) -> Finding:
    """Of the e-Series: in local control it takes no script from the network."""
    if reply == "true":
        return Finding("remote control", Verdict.OK, "on")
    advice = "teach pendant: Settings, System, Remote Control: enable; then switch to Remote"
    return Finding("remote control", Verdict.FAIL, f"'{reply}'", advice)


class Stretch(NamedTuple):
    """Packages of a stretch of RTDE: controller times, s, and when they came, s."""

    sent: list[float]
    came: list[float]


def rtde(robot: Robot) -> Iterator[Finding]:
    """Version against the rig's, then the measured rate."""
    wire = RtdeConnection(robot.host, robot.ports.rtde, ("timestamp",), (UNUSED,), LIMIT)
    try:
        with closing(wire):
            yield version(wire.open().version, robot)
            yield rate(_listen(wire), robot.rate)
    except DriverError as error:
        advice = "in lockstep a cell sends nothing unasked: serve it by the wall clock"
        yield Finding("rtde rate", Verdict.FAIL, str(error), advice)


def _listen(wire: RtdeConnection) -> Stretch:
    stretch, end = Stretch([], []), perf_counter() + SPAN
    while (now := perf_counter()) < end:
        (timestamp,) = wire.read_newest()
        assert isinstance(timestamp, float), "the recipe's one field is a DOUBLE"
        stretch.sent.append(timestamp)
        stretch.came.append(now)
    return stretch


def version(found: ControllerVersion, robot: Robot) -> Finding:
    """FAIL for another series, WARN for another software of the same one."""
    text = ".".join(map(str, found))
    if text == robot.version:
        return Finding("controller", Verdict.OK, f"{robot.series} {text}")
    if (found.major < FIRST_E_SERIES) != (robot.series == "cb3"):
        advice = "set robot.series, robot.version and robot.model to what is there"
        named = f"software {text}, the rig names {robot.series} {robot.version}"
        return Finding("controller", Verdict.FAIL, named, advice)
    advice = f"set robot.version to {text}, so that an emulated run is of the same software"
    return Finding("controller", Verdict.WARN, f"{text}, the rig names {robot.version}", advice)


def rate(stretch: Stretch, expected: int) -> Finding:
    """Packages per second of the controller's own time, and the longest wait for one, here."""
    sent, came = stretch
    span = sent[-1] - sent[0]
    if len(sent) < 2 or span <= 0:
        return Finding("rtde rate", Verdict.FAIL, "time stands still", "restart the controller")
    period = 1.0 / expected
    missing = round(span / period) + 1 - len(sent)
    longest = max(after - before for before, after in pairwise(came))
    measured = (len(sent) - 1) / span
    found = (
        f"{measured:.1f} Hz of {expected}, {len(sent)} packages, {missing} not seen in time, "
        f"longest wait {longest * 1e3:.1f} ms"
    )
    if missing > 0.1 * len(sent):
        advice = "network or host cannot keep up: wired link, no switch under load, idle host"
        return Finding("rtde rate", Verdict.FAIL, found, advice)
    if missing or longest > 2 * period:
        advice = "single packages come late: see host jitter and the network"
        return Finding("rtde rate", Verdict.WARN, found, advice)
    return Finding("rtde rate", Verdict.OK, found)
