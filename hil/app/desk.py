"""Asks a running `hil up` how it is doing: a Unix socket a process, in a folder of the user's."""

import os
import socket
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path
from tempfile import gettempdir
from typing import Final

from hil.cell.errors import DoorError

ANSWER_LIMIT: Final = 2.0
"""Wall seconds: a cell that is alive answers in its next control period, a stalled one later."""

Desk = Callable[[Callable[[], bytes]], None]
"""Answers, with what the callable makes, everybody who has asked; never waits."""


def folder() -> Path:
    """Where the sockets of this user's cells lie."""
    return Path(gettempdir()) / f"hil-{os.getuid()}"


@contextmanager
def open_desk() -> Iterator[Desk]:
    """The process's own socket, which goes with the `with`; DoorError when it cannot be had."""
    path = folder() / f"{os.getpid()}.sock"
    desk = socket.socket(socket.AF_UNIX, socket.SOCK_STREAM)
    try:
        path.parent.mkdir(mode=0o700, exist_ok=True)
        path.unlink(missing_ok=True)  # of a process with this number that was killed
        desk.bind(str(path))
        desk.listen()
    except OSError as error:
        desk.close()
        raise DoorError(
            f"status socket {path} cannot be opened ({error.strerror or error}); "
            "set TMPDIR to a folder of a shorter path that you may write to"
        ) from None
    desk.setblocking(False)
    try:
        yield lambda make: _answer(desk, make)
    finally:
        path.unlink(missing_ok=True)
        desk.close()


def _answer(desk: socket.socket, make: Callable[[], bytes]) -> None:
    try:
        guest, _ = desk.accept()
    except OSError:  # nobody there
        return
    with guest:
        guest.setblocking(False)
        try:
            guest.send(make())
        except OSError:  # gone again
            return


def ask_all() -> Iterator[bytes]:
    """What each of the user's cells answers; a socket whose process was killed is removed."""
    for path in sorted(folder().glob("*.sock")):
        with socket.socket(socket.AF_UNIX, socket.SOCK_STREAM) as link:
            link.settimeout(ANSWER_LIMIT)
            try:
                link.connect(str(path))
                yield b"".join(iter(lambda: link.recv(1 << 16), b""))
            except ConnectionRefusedError:
                path.unlink(missing_ok=True)
            except OSError:  # it ended just now, or it hangs
                continue
