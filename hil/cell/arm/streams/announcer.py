"""Messages on their way from the box to its primary clients; free of cost while nobody listens."""

from collections import deque
from typing import Final, TypeAlias

from drivers.protocol.primary_messages import Message

Queue: TypeAlias = deque[tuple[int, Message]]

KEPT: Final = 256
"""Messages kept for a client that does not read; then the oldest are lost, as their news is."""


class Announcer:
    """Copies each message into the queue of every listener."""

    __slots__ = ("_queues",)

    def __init__(self) -> None:
        self._queues: list[Queue] = []

    def post(self, t: int, message: Message) -> None:
        """Tell every listener at controller time t, ns."""
        for queue in self._queues:
            queue.append((t, message))

    def subscribe(self) -> Queue:
        """A new listener's queue, which it empties itself."""
        queue: Queue = deque(maxlen=KEPT)
        self._queues.append(queue)
        return queue

    def unsubscribe(self, queue: Queue) -> None:
        self._queues = [other for other in self._queues if other is not queue]
