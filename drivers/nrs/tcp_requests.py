"""Commands over the sensor's TCP protocol, one at a time: an answer carries the command's type."""

from collections import deque
from typing import Final, NamedTuple

from drivers.errors import CommandRefusedError
from drivers.protocol.nrs_tcp import Kind, encode

ANSWER_TIME: Final = 2_000_000_000
"""Arm time for an answer, ns: as long as the vendor's demo waits. A tare takes its part of it."""


class Request(NamedTuple):
    kind: Kind
    value: int


class TcpRequests:
    """A queue; nothing is sent twice, for the stream loses nothing."""

    def __init__(self) -> None:
        self._queue: deque[Request] = deque()
        self._deadline: int | None = None

    def put(self, kind: Kind, value: int) -> None:
        self._queue.append(Request(kind, value))

    def pending(self, kind: Kind) -> bool:
        return any(request.kind is kind for request in self._queue)

    def clear(self) -> None:
        self._queue.clear()
        self._deadline = None

    def due(self, t: int) -> bytes:
        """What to send at arm time t, b"" for nothing; CommandRefusedError without an answer."""
        if not self._queue:
            return b""
        request = self._queue[0]
        if self._deadline is None:
            self._deadline = t + ANSWER_TIME
            return encode(*request)
        if t > self._deadline:
            self.clear()
            raise CommandRefusedError(
                f"{request.kind.name} {request.value}: no answer for {ANSWER_TIME / 1e9:g} s"
            )
        return b""

    def answer(self, kind: int) -> Kind | None:
        """The kind of the command in flight if this answers it, else None: a foreign answer.

        What the answer's third byte means is not public, so it is not judged: that samples flow
        and are on a new zero is seen by them.
        """
        if self._deadline is None or kind != self._queue[0].kind:
            return None
        self._deadline = None
        return self._queue.popleft().kind
