"""The folder of a run: made, checked and opened before anything moves."""

import fcntl
import os
import shutil
from pathlib import Path

from hil.recording.errors import RecordingError

NAME = "run.mcap"
PART = "run.mcap.part"

MINIMUM_FREE = 64 * 2**20
"""Bytes a run may need: a minute of bench time takes about 15 MB."""


def open_part(folder: Path, overwrite: bool) -> int:
    """File descriptor of the part file in `folder`, which is made if need be; RecordingError.

    A folder that holds a run is refused unless `overwrite`; what an unfinished run left is
    replaced, other files are left alone. The part file is locked as long as somebody has it open,
    so that two runs never write into one folder.
    """
    try:
        folder.mkdir(parents=True, exist_ok=True)
        if not overwrite and (folder / NAME).exists():
            raise RecordingError(f"{folder}: holds a run; choose another folder or --overwrite")
        free = shutil.disk_usage(folder).free
        if free < MINIMUM_FREE:
            raise RecordingError(f"{folder}: {free} bytes free, a run may need {MINIMUM_FREE}")
        part = _locked(folder)
        (folder / NAME).unlink(missing_ok=True)
    except OSError as error:
        problem = f"{folder}: cannot record here: {error.strerror}; choose another folder"
        raise RecordingError(problem) from None
    return part


def _locked(folder: Path) -> int:
    """The part file, empty and ours alone; RecordingError while another run has it."""
    part = os.open(folder / PART, os.O_WRONLY | os.O_CREAT, 0o644)
    try:
        fcntl.flock(part, fcntl.LOCK_EX | fcntl.LOCK_NB)
        if os.fstat(part).st_size:
            os.ftruncate(part, 0)
    except BlockingIOError:
        os.close(part)
        raise RecordingError(f"{folder}: another run records here; choose another folder") from None
    except OSError:
        os.close(part)
        raise
    return part


def finish(folder: Path) -> Path:
    """Give the part file its final name."""
    try:
        return (folder / PART).rename(folder / NAME)
    except OSError as error:
        raise RecordingError(f"{folder / PART}: {error.strerror}") from None
