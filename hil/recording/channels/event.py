"""/event: what a reader of the run should be told, in words."""

from enum import StrEnum

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


def encode(kind: EventKind, line: str) -> bytes:
    return f"{kind.value}\n{line}".encode()


def fields(payload: bytes) -> Fields:
    kind, _, line = payload.decode().partition("\n")
    return {"kind": kind, "text": line}
