"""A recording beside a trial, on a disk that may fail (H4); it goes with the trial."""

from contextlib import ExitStack
from pathlib import Path
from tempfile import TemporaryDirectory

from hil.app.cell import RunningCell
from hil.app.host_faults import FullDisk, HostFaults
from hil.app.near import task_frame
from hil.app.record import RunRecord, identity
from hil.cell.rig import Rig
from hil.recording.recorder import Recorder


def recording(
    rig: Rig, seed: int, cell: RunningCell, host: HostFaults, stack: ExitStack
) -> RunRecord:
    """Open until the stack is left. RecordingError when there is no room for it from the start."""
    folder = Path(stack.enter_context(TemporaryDirectory())) / "trial"
    recorder = stack.enter_context(Recorder(folder, identity(rig.name, b"", seed, {})))
    return RunRecord(FullDisk(recorder, host), cell, task_frame(rig), rig.robot.period)
