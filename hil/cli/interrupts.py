"""SIGINT and SIGTERM end a command the same way: what it opened is closed, then it says so."""

import signal
from collections.abc import Iterator
from contextlib import contextmanager
from types import FrameType


@contextmanager
def heard() -> Iterator[list[int]]:
    """The signals that came so far; each is raised as KeyboardInterrupt where it strikes.

    They are kept, since an extension module struck while it loads turns the exception into an
    ImportError.
    """
    came: list[int] = []

    def note(number: int, _frame: FrameType | None) -> None:
        came.append(number)
        raise KeyboardInterrupt

    before = {number: signal.signal(number, note) for number in (signal.SIGINT, signal.SIGTERM)}
    try:
        yield came
    finally:
        for number, handler in before.items():
            signal.signal(number, handler)
