"""The folder of a run: made, checked and opened before anything moves."""

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

    A folder that holds anything is refused unless `overwrite`, which replaces a run's own files
    and leaves the others alone.
    """
    try:
        folder.mkdir(parents=True, exist_ok=True)
        if not overwrite and any(folder.iterdir()):
            raise RecordingError(f"{folder}: is not empty; choose another folder or --overwrite")
        free = shutil.disk_usage(folder).free
        if free < MINIMUM_FREE:
            raise RecordingError(f"{folder}: {free} bytes free, a run may need {MINIMUM_FREE}")
        (folder / NAME).unlink(missing_ok=True)
        return os.open(folder / PART, os.O_WRONLY | os.O_CREAT | os.O_TRUNC, 0o644)
    except OSError as error:
        raise RecordingError(f"{folder}: cannot record here: {error.strerror}") from None


def finish(folder: Path) -> Path:
    """Give the part file its final name."""
    try:
        return (folder / PART).rename(folder / NAME)
    except OSError as error:
        raise RecordingError(f"{folder / PART}: {error.strerror}") from None
