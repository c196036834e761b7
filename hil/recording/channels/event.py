"""/event: what a reader of the run should be told, in words."""

import re
from enum import StrEnum
from typing import Final

from hil.recording.channels.schema import Fields, message, text


class EventKind(StrEnum):
    """What the line is about.

    GUARD: a limit ended or held the motion. FAULT: the cell was made to fail. OUTCOME: how the task
    ended. NOTE: anything else.
    """

    GUARD = "guard"
    FAULT = "fault"
    OUTCOME = "outcome"
    NOTE = "note"


SCHEMA = message(
    "event",
    kind=text(", ".join(kind.value for kind in EventKind)),
    text=text("one line"),
)


_PORT: Final = re.compile(r"(?<=\d\.\d):\d+")


def portless(line: str) -> str:
    """The line without the ports behind its addresses: a cell on free ports has others each time,
    and two runs of one seed are to be the same.
    """
    return _PORT.sub("", line)


def encode(kind: EventKind, line: str) -> bytes:
    return f"{kind.value}\n{portless(line)}".encode()


def fields(payload: bytes) -> Fields:
    kind, _, line = payload.decode().partition("\n")
    return {"kind": kind, "text": line}
