"""One client's socket and session, with what is on its way to the client."""

import socket
from collections import deque
from collections.abc import Iterator
from typing import Final, Protocol

from drivers.protocol.errors import WireError
from hil.cell.arm.door_log import Event
from hil.cell.errors import CellError

MAX_BACKLOG: Final = 1 << 18
"""Bytes kept, beyond the kernel's own buffer, for a client that does not read: some 5 s of a
20-variable recipe at 125 Hz. Then it is cut off, for the control loop never waits."""

RECEIVE: Final = 1 << 16

ANY: Final = 1 << 62
"""A share that nobody uses up."""


class Session(Protocol):
    """A sans-IO session of one client.

    lossy: what it publishes is dropped, newest first, while the client leaves older bytes unread;
    any other client that does not read is cut off.
    share: bytes that are handled in a control period when the clock does not wait for them.
    """

    greeting: bytes
    lossy: bool
    share: int

    @property
    def closing(self) -> bool: ...
    def receive(self, data: bytes, t: int) -> bytes: ...
    def publish(self, step: int) -> bytes: ...
    def close(self) -> None: ...


class Cut(CellError):  # noqa: N818 - an event, not a fault of the cell
    """The connection is over; the message says why."""

    def __init__(self, event: Event, why: str) -> None:
        super().__init__(f"{event}: {why}")
        self.event = event


class Connection:
    """A session, and the bytes that wait for their time (`_travelling`) or the kernel (`_out`).

    left: bytes that it may still send in this control period.
    """

    __slots__ = ("_delays", "_last_due", "_out", "_travelling", "door", "left", "session", "socket")

    def __init__(
        self, door: str, client: socket.socket, session: Session, delays: Iterator[int]
    ) -> None:
        """delays: travel times of the data packages, ns; replies take none."""
        self.door = door
        self.socket = client
        self.session = session
        self.left = ANY
        self._out = session.greeting
        self._delays = delays
        self._travelling: deque[tuple[int, bytes]] = deque()
        self._last_due = 0

    def fileno(self) -> int:
        return self.socket.fileno()

    def read(self, t: int) -> None:
        """Take what is readable and queue the replies; raises Cut."""
        try:
            data = self.socket.recv(min(RECEIVE, self.left))
        except BlockingIOError:
            return
        except OSError as error:
            raise _lost(error) from None
        if not data:
            raise Cut(Event.LEFT, "closed by the client")
        self.left -= len(data)
        self.hear(data, t)

    def hear(self, data: bytes, t: int) -> None:
        """Let the session take what came, and send what it says to it; raises Cut."""
        try:
            replies = self.session.receive(data, t)
        except WireError as error:
            raise Cut(Event.CUT_OFF, str(error)) from None
        if replies:
            self._reply(replies)
        self.send()
        if self.session.closing:
            raise Cut(Event.LEFT, "quit")

    def publish(self, t: int, step: int) -> None:
        """Put the session's package of this control step, if one is due, on its way at t, ns.

        No package overtakes the one before it: they share a TCP stream.
        """
        if package := self.session.publish(step):
            self._last_due = max(self._last_due, t + next(self._delays))
            self._travelling.append((self._last_due, package))

    def stream(self, step: int) -> None:
        """Queue what a lossy session sends in this control step, if the client keeps up."""
        if not self._out:
            self._out = self.session.publish(step)

    @property
    def next_due(self) -> int | None:
        """When the oldest travelling package reaches the client, ns."""
        return self._travelling[0][0] if self._travelling else None

    def flush(self, t: int) -> None:
        """Send what is due at t, and what the kernel refused before, at once; raises Cut."""
        travelling = self._travelling
        while travelling and travelling[0][0] <= t:
            self._out += travelling.popleft()[1]
        self.send()

    def send(self) -> None:
        """Hand the kernel what it takes; raises Cut for a client that does not read."""
        if not self._out:
            return
        try:
            sent = self.socket.send(self._out)
        except BlockingIOError:
            sent = 0
        except OSError as error:
            raise _lost(error) from None
        self._out = self._out[sent:]
        if len(self._out) > MAX_BACKLOG:
            unread = f"{len(self._out)} bytes unread, allowed are {MAX_BACKLOG}"
            raise Cut(Event.CUT_OFF, unread)

    def close(self) -> None:
        self.session.close()
        self.socket.close()

    def _reply(self, replies: bytes) -> None:
        """Set-up takes no bench time; packages already travelling stay ahead of the reply."""
        self._out += b"".join(package for _, package in self._travelling) + replies
        self._travelling.clear()


def _lost(error: OSError) -> Cut:
    return Cut(Event.LOST, error.strerror or type(error).__name__)
