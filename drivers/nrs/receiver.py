"""A thread that takes messages off the bus, for wall-clock runs where nobody polls for a while."""

from collections import deque
from threading import Event, Thread
from typing import Final

import can

from drivers.errors import LinkError

CAPACITY: Final = 8192
"""Messages kept, two seconds of a saturated bus: beyond that the oldest go, they are stale."""
WAIT: Final = 0.1


class Receiver:
    """Owns the thread. python-can's own Notifier dies with the first error and tells nobody."""

    def __init__(self, bus: can.BusABC) -> None:
        self._bus = bus
        self._messages: deque[can.Message] = deque(maxlen=CAPACITY)
        self._error: Exception | None = None
        self._leave = Event()
        self._thread = Thread(target=self._run, name="nrs-receiver", daemon=True)
        self._thread.start()

    @property
    def alive(self) -> bool:
        return self._thread.is_alive() and self._error is None

    def take(self) -> list[can.Message]:
        """What has arrived since the last call; LinkError once the bus has failed."""
        messages = [self._messages.popleft() for _ in range(len(self._messages))]
        if not messages and self._error is not None:
            raise LinkError(f"CAN receive thread ended: {self._error!r}") from self._error
        return messages

    def close(self) -> None:
        self._leave.set()
        self._thread.join()

    def _run(self) -> None:
        try:
            while not self._leave.is_set():
                message = self._bus.recv(WAIT)
                if message is not None:
                    self._messages.append(message)
        except Exception as error:  # whatever a back end raises ends this thread, not silently
            self._error = error
