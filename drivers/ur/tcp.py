"""TCP streams to the control box, with errors that say where and what to check."""

import socket
import struct
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from itertools import count
from time import sleep
from typing import Final, TypeVar

from drivers.errors import LinkError, LinkTimeoutError

R = TypeVar("R")
BACK_OFF: Final = 0.1
"""Wall s before the second attempt at a link; each later wait is twice as long."""


def open_stream(host: str, port: int, service: str, limit: float) -> socket.socket:
    """A connected stream with `limit` seconds of wall time for every later call.

    The kernel keeps the limit (POSIX timeval): Python's own timeout polls before each call, which
    cost a third of a round trip (16 us against 10 us, measured).
    """
    with link_errors(host, port, service, limit):
        stream = socket.create_connection((host, port), timeout=limit)
    stream.setsockopt(socket.IPPROTO_TCP, socket.TCP_NODELAY, 1)  # set-points must not wait
    stream.settimeout(None)
    timeval = struct.pack("ll", int(limit), int(limit % 1.0 * 1e6))
    stream.setsockopt(socket.SOL_SOCKET, socket.SO_RCVTIMEO, timeval)
    stream.setsockopt(socket.SOL_SOCKET, socket.SO_SNDTIMEO, timeval)
    return stream


@contextmanager
def link_errors(host: str, port: int, service: str, limit: float) -> Iterator[None]:
    """Turns the system's errors into LinkError and LinkTimeoutError."""
    try:
        yield
    except OSError as error:
        raise explain(error, f"{service} at {host}:{port}", limit) from error


def explain(error: OSError, peer: str, limit: float) -> LinkError:
    """The link error behind a system error; `peer` is service and address."""
    if isinstance(error, (TimeoutError, BlockingIOError)):  # the latter: SO_RCVTIMEO ran out
        return LinkTimeoutError(f"{peer} said nothing for {limit} s; is the controller running?")
    if isinstance(error, ConnectionRefusedError):
        return LinkError(f"{peer} refused; check address, port and that the controller is up")
    if isinstance(error, ConnectionError):
        return LinkError(f"{peer} cut the connection")
    return LinkError(f"{peer} cannot be reached: {error.strerror or error}")


def insist(attempt: Callable[[], R], tries: int) -> R:
    """The attempt's result, tried anew, ever later, when a link is refused or cut.

    Raises the last LinkError with the number of attempts as its note. Silence is not tried again:
    it has taken its time already.
    """
    for tried in count(1):
        try:
            return attempt()
        except LinkTimeoutError:
            raise
        except LinkError as error:
            if tried >= tries:
                error.add_note(f"{tried} attempts")
                raise
        sleep(BACK_OFF * 2 ** (tried - 1))
    raise AssertionError("counting has no end")
