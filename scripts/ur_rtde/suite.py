"""ur_rtde's own C++ test suite from its PyPI source, unchanged, against both series.

    python scripts/ur_rtde/suite.py --work /tmp/ur_rtde_suite

Needs g++, cmake and (Debian) libboost-{thread,system,chrono,date-time,atomic,program-options}-dev
and doctest-dev; builds in --work with -O0, since optimising one generated file takes ten minutes.
The suite has the robot's address built in: run as root, or add it to the loopback device first
(`ip addr add 192.168.56.101/32 dev lo`).
"""

import argparse
import json
import re
import subprocess
import sys
from pathlib import Path

from cell import HIL, RIGS, served

RELEASE = "ur_rtde-1.6.5"
ADDRESS = "192.168.56.101"
START = [f"{q} rad" for q in (-1.6007, -1.7271, -2.203, -0.808, 1.5951, -0.031)]
"""Where URSim starts: the suite was written there and comes back to it after every move."""
LIMIT = 300.0
"""Longest that the suite may take against one series, s; it needs about 40."""


def build(work: Path) -> Path:
    """The suite's executable, built once in `work`."""
    suite = work / "suite" / "tests"
    if suite.exists():
        return suite
    work.mkdir(parents=True, exist_ok=True)
    _run(work, sys.executable, "-m", "pip", "download", "--no-deps", "--no-binary", "ur_rtde",
         RELEASE.replace("-", "=="))  # fmt: skip
    _run(work, "tar", "xf", f"{RELEASE}.tar.gz")
    _run(work, "cmake", "-S", RELEASE, "-B", "library", "-DPYTHON_BINDINGS=OFF", "-DEXAMPLES=OFF",
         "-DCMAKE_BUILD_TYPE=Debug", "-DCMAKE_CXX_FLAGS=-O0")  # fmt: skip
    _run(work, "cmake", "--build", "library", "--parallel", "2")
    found = f"-Dur_rtde_DIR={(work / 'library' / 'ur_rtde').resolve()}"
    _run(work, "cmake", "-S", f"{RELEASE}/test", "-B", "suite", found)
    _run(work, "cmake", "--build", "suite")
    return suite


def _run(folder: Path, *command: str) -> None:
    """One step of the build at low priority; its output is the user's."""
    subprocess.run(["nice", "-n", "19", *command], cwd=folder, check=True)


def own_the_address() -> None:
    """Have the built-in address on the loopback device."""
    shown = subprocess.run(["ip", "addr", "show", "lo"], capture_output=True, text=True, check=True)
    if ADDRESS not in shown.stdout:
        subprocess.run(["ip", "addr", "add", f"{ADDRESS}/32", "dev", "lo"], check=True)


def _at_the_address(rig: str, work: Path) -> str:
    """A rig file of this rig at the suite's address and start; --host takes loopback only."""
    shown = subprocess.run(
        [HIL, "rig", "show", rig, "--json"], capture_output=True, text=True, check=True
    )
    cell = json.loads(shown.stdout)
    cell["robot"] |= {"host": ADDRESS, "home": START}
    path = work / f"{rig}.yaml"
    path.write_text(json.dumps(cell))  # JSON is YAML
    return str(path)


def counts(output: str) -> str:
    """Closing lines of doctest: cases and assertions."""
    lines = re.findall(r"\[doctest\] ((?:test cases|assertions):.*)", output)
    return "; ".join(" ".join(line.split()) for line in lines) or "no summary: the suite broke off"


def main() -> int:
    """Exit status 1 when the suite fails against a series."""
    parser = argparse.ArgumentParser(description="ur_rtde's own C++ test suite, both series")
    parser.add_argument("--work", type=Path, required=True, help="folder to build in")
    work = parser.parse_args().work.resolve()
    suite = build(work)
    own_the_address()
    failed = False
    for series, rig in RIGS.items():
        with served(_at_the_address(rig, work), None):
            done = subprocess.run(
                [suite], capture_output=True, text=True, timeout=LIMIT, check=False
            )
        print(f"{series}: {counts(done.stdout)}", flush=True)
        if done.returncode != 0:
            failed = True
            print(done.stdout, done.stderr, sep="\n")
    return int(failed)


if __name__ == "__main__":
    sys.exit(main())
