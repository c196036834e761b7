"""Transitions from the control process to the learner's: one writer, one reader, shared memory.

The writer never waits: it overwrites the oldest, and the reader notices by the sequence number. A
slot's number is stored after its content, which holds where stores stay in order (x86).
"""

from typing import Final, NamedTuple

import numpy as np
from numpy.typing import NDArray

from learner.errors import RingGapError

SLOT: Final = np.dtype(
    [
        ("before", "<i4"), ("action", "<i4"), ("after", "<i4"), ("step", "<i4"),
        ("ending", "<i8"), ("number", "<u8"),
    ]
)  # fmt: skip


class Record(NamedTuple):
    """Rows before and after, the action, its step, and how the episode ended: an index or -1."""

    before: int
    action: int
    after: int
    step: int
    ending: int


class Ring:
    """A view on `slots`, zeroed shared memory; make one in either process, and use one end each."""

    def __init__(self, slots: NDArray[np.void]) -> None:
        self._slots = slots
        self._written = self._taken = 0

    def put(self, record: Record) -> None:
        """Append; the writer's end."""
        slot = self._slots[self._written % len(self._slots)]
        self._written += 1
        slot["number"] = 0  # whoever looks now sees neither the old record nor half of the new one
        for name, value in zip(Record._fields, record, strict=True):
            slot[name] = value
        slot["number"] = self._written

    def take(self) -> Record | None:
        """The next record, None when there is none yet; the reader's end. RingGapError when it was
        overwritten before.
        """
        slot = self._slots[self._taken % len(self._slots)]
        wanted = self._taken + 1
        if slot["number"] < wanted:
            return None
        record = Record(*(int(slot[name]) for name in Record._fields))
        if (found := int(slot["number"])) != wanted:
            raise RingGapError(
                f"transition {wanted} was overwritten by {found or 'a newer one'}: the learner is "
                f"more than {len(self._slots)} behind"
            )
        self._taken = wanted
        return record
