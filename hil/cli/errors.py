"""Which errors a user may meet, the one line that says each, and the exit status it ends in."""

from typing import Protocol, runtime_checkable

FAILED = 1
"""A run that began and failed, or a machine that failed it; of `hil diff`: they differ."""

BAD_INPUT = 2
"""Usage, a rig file or a folder that cannot be used: nothing moved."""

INTERRUPTED = 130
"""Ctrl-C, as shells report it."""


@runtime_checkable
class UsageError(Protocol):
    """A usage error of click's; by shape, since typer may bundle its own copy of click."""

    exit_code: int

    def format_message(self) -> str: ...


def status(error: BaseException) -> int | None:
    """The exit status for a known error, None for one that is a bug of ours."""
    if isinstance(error, KeyboardInterrupt):
        return INTERRUPTED
    if isinstance(error, UsageError):
        return BAD_INPUT
    # Imported when something went wrong: `hil --help` needs none of these rooms.
    from controller.errors import ControlError  # noqa: PLC0415
    from drivers.errors import DriverError  # noqa: PLC0415
    from hil.campaign.errors import CampaignError  # noqa: PLC0415
    from hil.cell.errors import CellError, RigError  # noqa: PLC0415
    from hil.falsify.errors import FalsifyError  # noqa: PLC0415
    from hil.monitors.errors import MonitorError  # noqa: PLC0415
    from hil.recording.errors import RecordingError  # noqa: PLC0415
    from hil.tuning.errors import TuningError  # noqa: PLC0415
    from learner.errors import LearnerError  # noqa: PLC0415

    bad = RigError | RecordingError | CampaignError | TuningError | LearnerError
    if isinstance(error, bad | FalsifyError | MonitorError):
        return BAD_INPUT
    if isinstance(error, DriverError | CellError | ControlError | OSError):
        return FAILED
    return None


def said(error: BaseException) -> str:
    """What stderr gets: one line, or the help text where a command was left out."""
    text = error.format_message() if isinstance(error, UsageError) else str(error)
    return text if text.startswith("Usage:") else f"hil: {line(error)}"


def line(error: BaseException) -> str:
    """One line, whatever the error's own text looks like."""
    text = error.format_message() if isinstance(error, UsageError) else str(error)
    words = " ".join(text.split()).replace("Value error, ", "")  # the option parser's own prefix
    return words or type(error).__name__
