"""What `hil doctor` looks at on this machine: each check says what it found."""

import importlib.metadata
import os
import shutil
import socket
import sys
import time
from collections.abc import Callable, Iterator
from pathlib import Path
from subprocess import TimeoutExpired, run
from tempfile import TemporaryFile
from typing import Final

from hil.doctor.finding import Finding, Verdict

PYTHON: Final = (3, 11)
PORTS: Final = range(29999, 30005)
REQUIRED: Final = (
    "lark", "matplotlib", "mcap", "msgpack", "mujoco", "numba", "numpy", "orjson", "pint",
    "pydantic", "python-can", "pyyaml", "rich", "scipy", "typer", "ur-analytic-ik", "zstandard",
)  # fmt: skip
GROUP: Final = "239.74.163.2"
"""Multicast group of python-can's udp_multicast bus (its default IPv4 group)."""

DRAW: Final = (
    "import mujoco; m = mujoco.MjModel.from_xml_string('<mujoco/>'); "
    "r = mujoco.Renderer(m, 16, 16); r.update_scene(mujoco.MjData(m)); r.render()"
)
DRAW_LIMIT: Final = 60.0
"""Wall seconds for the first off-screen frame, library load included."""


def findings(out: Path) -> Iterator[Finding]:
    """Every check, in the order in which a new user meets what they look at."""
    checks: tuple[Callable[[], Finding], ...] = (
        python, packages, cpus, timer, ports, multicast, can_interfaces, rendering,
    )  # fmt: skip
    for check in checks:
        yield check()
    yield folder(out)


def python() -> Finding:
    version = ".".join(map(str, sys.version_info[:3]))
    if sys.version_info >= PYTHON:
        return Finding("python", Verdict.OK, version)
    return Finding("python", Verdict.FAIL, version, "install Python 3.11 or later")


def packages() -> Finding:
    found, absent = [], []
    for name in REQUIRED:
        try:
            found.append(f"{name} {importlib.metadata.version(name)}")
        except importlib.metadata.PackageNotFoundError:
            absent.append(name)
    if absent:
        advice = f"pip install {' '.join(absent)}"
        return Finding("packages", Verdict.FAIL, f"not installed: {', '.join(absent)}", advice)
    return Finding("packages", Verdict.OK, ", ".join(found))


def cpus() -> Finding:
    count = len(os.sched_getaffinity(0))
    if count > 1:
        return Finding("cpus", Verdict.OK, str(count))
    advice = "recording and cell share one core: expect a lower real-time factor"
    return Finding("cpus", Verdict.WARN, "1", advice)


def timer() -> Finding:
    """Lateness of 100 sleeps of 1 ms: what a wall-clock run has to live with."""
    late = sorted(_oversleep() for _ in range(100))
    found = f"1 ms sleeps late by {late[50] * 1e6:.0f} us (median), {late[98] * 1e6:.0f} us (p99)"
    if late[98] < 1e-3:
        return Finding("timer", Verdict.OK, found)
    return Finding("timer", Verdict.WARN, found, "use the lockstep clock, or a quieter machine")


def _oversleep() -> float:
    start = time.perf_counter()
    time.sleep(1e-3)
    return time.perf_counter() - start - 1e-3


def ports(wanted: range = PORTS) -> Finding:
    taken = [port for port in wanted if not _free(port)]
    if not taken:
        return Finding("ports", Verdict.OK, f"{wanted[0]}-{wanted[-1]} free on 127.0.0.1")
    advice = "set robot.ports to 0 to take free ones"
    return Finding("ports", Verdict.WARN, f"in use: {', '.join(map(str, taken))}", advice)


def _free(port: int) -> bool:
    with socket.socket() as probe:
        probe.setsockopt(socket.SOL_SOCKET, socket.SO_REUSEADDR, 1)
        try:
            probe.bind(("127.0.0.1", port))
        except OSError:
            return False
    return True


def multicast() -> Finding:
    """One datagram to the group and back over loopback, as the CAN bus between processes does."""
    try:
        _loop_back()
    except OSError as error:
        advice = "runs in one process need no multicast; else: ip link set lo multicast on"
        return Finding("multicast", Verdict.WARN, str(error), advice)
    return Finding("multicast", Verdict.OK, f"{GROUP} loops back")


def _loop_back() -> None:
    local = socket.inet_aton("127.0.0.1")
    with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as end:
        end.bind(("", 0))
        end.settimeout(1.0)
        end.setsockopt(socket.IPPROTO_IP, socket.IP_ADD_MEMBERSHIP, socket.inet_aton(GROUP) + local)
        end.setsockopt(socket.IPPROTO_IP, socket.IP_MULTICAST_IF, local)
        end.sendto(b"hil", (GROUP, end.getsockname()[1]))
        end.recv(16)


def can_interfaces() -> Finding:
    names = [name for _, name in socket.if_nameindex() if name.startswith(("can", "vcan"))]
    if names:
        return Finding("can", Verdict.OK, ", ".join(names))
    advice = "optional; ip link add vcan0 type vcan && ip link set vcan0 up"
    return Finding("can", Verdict.OK, "no kernel interface: virtual or udp_multicast bus", advice)


def rendering() -> Finding:
    """One off-screen frame in a child: a missing GL library may end the process that tries."""
    try:
        child = run(
            [sys.executable, "-c", DRAW],
            env=os.environ | {"MUJOCO_GL": "egl"},  # as hil.view.scene draws
            capture_output=True,
            timeout=DRAW_LIMIT,
            check=False,
        )
        drawn = child.returncode == 0
    except TimeoutExpired:
        drawn = False
    if drawn:
        return Finding("rendering", Verdict.OK, "EGL draws off screen")
    advice = "pictures of the scene only: apt-get install libegl1 libgl1-mesa-dri"
    return Finding("rendering", Verdict.WARN, "EGL cannot draw off screen", advice)


def folder(out: Path) -> Finding:
    """Whether runs can be recorded under `out`, without making it."""
    place = next(path for path in (out.absolute(), *out.absolute().parents) if path.exists())
    try:
        TemporaryFile(dir=place).close()  # access rights alone say yes to root, even in /proc
    except OSError:
        advice = "name another folder with --out"
        return Finding("folder", Verdict.FAIL, f"{place} is not writable", advice)
    free = shutil.disk_usage(place).free / 2**30
    return Finding("folder", Verdict.OK, f"{place} is writable, {free:.1f} GiB free")
