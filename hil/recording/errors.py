"""The recording's error tree."""


class RecordingError(Exception):
    """A recording cannot be written or read; the message names the file and the reason."""
