"""Commands to the node, one at a time: sent again when unanswered, matched by sequence number."""

from collections import deque
from dataclasses import dataclass
from typing import Final

from drivers.errors import CommandRefusedError
from drivers.protocol.frame import CanFrame
from drivers.protocol.nrs_can import Identifiers
from drivers.protocol.nrs_command import Command, Opcode, Reply, Result, encode_command

TRIES: Final = 3
ANSWER_TIME: Final = 100_000_000
"""Arm time for an answer, ns, on top of what the command itself takes."""


@dataclass(slots=True)
class _Request:
    command: Command
    patience: int
    tries: int = 0
    deadline: int | None = None


class Requests:
    """A queue of commands; repeats carry the same sequence number, so the node does them once."""

    def __init__(self, identifiers: Identifiers) -> None:
        self._ids = identifiers
        self._queue: deque[_Request] = deque()
        self._seq = 0

    def put(self, opcode: Opcode, arguments: tuple[int, ...] = (), duration: int = 0) -> None:
        """Queue a command that takes `duration` ns; ValueError when an argument does not fit."""
        self._seq = (self._seq + 1) & 0xFF
        command = Command(opcode, self._seq, arguments)
        encode_command(self._ids, command)
        self._queue.append(_Request(command, ANSWER_TIME + duration))

    def pending(self, opcode: Opcode) -> bool:
        return any(request.command.opcode == opcode for request in self._queue)

    def clear(self) -> None:
        self._queue.clear()

    def rewind(self) -> None:
        """The node has restarted and knows nothing of what was sent."""
        if self._queue:
            self._queue[0].tries, self._queue[0].deadline = 0, None

    def due(self, t: int) -> CanFrame | None:
        """What to send at arm time t; CommandRefusedError when every try went unanswered."""
        if not self._queue:
            return None
        request = self._queue[0]
        if request.deadline is not None and t < request.deadline:
            return None
        if request.tries == TRIES:
            self._queue.popleft()
            raise CommandRefusedError(
                f"{Opcode(request.command.opcode).name}: no answer to {TRIES} tries of "
                f"{request.patience / 1e6:g} ms"
            )
        request.tries += 1
        request.deadline = t + request.patience
        return encode_command(self._ids, request.command)

    def answer(self, reply: Reply) -> Reply | None:
        """The reply if it settles the command in flight, else None: late, or another host's.

        Raises CommandRefusedError when the node said no.
        """
        if not self._queue or self._queue[0].tries == 0:
            return None
        command = self._queue[0].command
        if (reply.opcode, reply.seq) != (command.opcode, command.seq):
            return None
        self._queue.popleft()
        if reply.result is not Result.OK:
            raise CommandRefusedError(
                f"{Opcode(command.opcode).name}{command.arguments}: {reply.result.name}"
            )
        return reply
