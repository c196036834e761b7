"""How long a user waits for the first control cycle, and what a cell takes of memory."""

import resource
import subprocess
import sys
from dataclasses import dataclass
from pathlib import Path
from tempfile import TemporaryDirectory
from time import perf_counter

from hil.cell.errors import CellError

LIMIT = 120.0
"""Wall seconds; a cold start takes a few."""


@dataclass(frozen=True, slots=True)
class Startup:
    """first_cycle_s: from the command on. memory_mb: of cell, drivers, recorder; without code."""

    first_cycle_s: float
    memory_mb: float


def measure(rig_text: bytes) -> Startup:
    """Start a run in a process of its own and stop it at its first cycle; raises CellError."""
    with TemporaryDirectory() as folder:
        rig = Path(folder) / "rig.yaml"
        rig.write_bytes(rig_text)
        begin = perf_counter()
        command = [sys.executable, "-m", "hil.bench.first_cycle", str(rig)]
        child = subprocess.run(command, capture_output=True, timeout=LIMIT, check=False)
    if child.returncode != 0:
        raise CellError(f"a run for the bench failed: {child.stderr.decode().strip()[-300:]}")
    moment, memory = map(float, child.stdout.split())
    return Startup(moment - begin, memory)


def main(rig_file: Path) -> None:
    """The child: what `hil run` does until its first cycle."""
    import mujoco  # noqa: F401, PLC0415  code, not the cell's memory

    from controller.course import Course  # noqa: PLC0415
    from controller.cycle import Cycle  # noqa: PLC0415
    from hil.app.cell import RunningCell  # noqa: PLC0415
    from hil.app.run import Request, run  # noqa: PLC0415
    from hil.cell.rig import load  # noqa: PLC0415

    rig = load(rig_file).on_free_ports()
    before = _resident_mb()

    def stop(_cycle: Cycle, _course: Course, _cell: RunningCell) -> None:
        print(perf_counter(), _resident_mb() - before)  # CLOCK_MONOTONIC: the parent's clock too
        raise SystemExit(0)

    out = rig_file.parent / "run"
    run(Request(rig, rig_file.read_bytes(), rig.seed, rig.first_part, out=out), stop)


def _resident_mb() -> float:
    pages = int(Path("/proc/self/statm").read_text(encoding="ascii").split()[1])
    return pages * resource.getpagesize() / 1e6


if __name__ == "__main__":
    main(Path(sys.argv[1]))
