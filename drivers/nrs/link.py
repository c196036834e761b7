"""One open bus with its optional receive thread, and the way back when it fails."""

from collections.abc import Callable
from contextlib import suppress
from errno import ENETDOWN

import can

from drivers.errors import LinkError
from drivers.nrs.bus import drain, send
from drivers.nrs.receiver import Receiver
from drivers.protocol.frame import CanFrame


class Link:
    """Open from the first `open` on; a failing bus is reopened once per call that meets it.

    opener: gives a fresh bus, or raises LinkError.
    """

    def __init__(self, opener: Callable[[], can.BusABC], background: bool) -> None:
        self._opener = opener
        self._background = background
        self._bus: can.BusABC | None = None
        self._receiver: Receiver | None = None
        self.last_error = ""
        self.openings = 0

    @property
    def alive(self) -> bool:
        """Whether somebody takes messages: the thread, or the caller by polling an open bus."""
        return self._receiver.alive if self._receiver else self._bus is not None

    def open(self) -> None:
        """Raises LinkError."""
        self._bus = self._opener()
        self.openings += 1
        self._receiver = Receiver(self._bus) if self._background else None

    def close(self) -> None:
        if self._receiver is not None:
            self._receiver.close()
        if self._bus is not None:
            # What a dead adapter raises while it is let go changes nothing for the caller.
            with suppress(can.CanError, OSError):
                self._bus.shutdown()
        self._bus = self._receiver = None

    def reopen(self) -> None:
        """Raises LinkError. A kernel interface that came back is silent until reopened."""
        self.close()
        self.open()

    def take(self) -> list[can.Message]:
        """Messages since the last call; after a failure [] and a fresh bus, or LinkError."""
        messages: list[can.Message] = []
        try:
            if self._receiver is not None:
                return self._receiver.take()
            drain(self._opened(), messages)
        except (can.CanError, OSError, ValueError) as error:
            self._recover(error)
        except LinkError as error:
            if self._bus is None:
                raise
            self._recover(error)
        return messages

    def send(self, frame: CanFrame) -> None:
        """Raises LinkError when neither this bus nor a fresh one takes the frame."""
        try:
            send(self._opened(), frame)
        except (can.CanError, OSError) as error:
            self._recover(error)
            try:
                send(self._opened(), frame)
            except (can.CanError, OSError) as again:
                raise LinkError(f"CAN: cannot send: {again}") from again

    def _opened(self) -> can.BusABC:
        if self._bus is None:
            raise LinkError("the CAN bus is not open: call connect() first")
        return self._bus

    def _recover(self, error: Exception) -> None:
        self.last_error = f"{type(error).__name__}: {error}"
        # A kernel socket outlives its interface's going down and hears again once it is up; a new
        # one, opened while it is down, would owe the same error first and lose what came meanwhile.
        code = getattr(error, "error_code", None) or getattr(error, "errno", None)
        if code == ENETDOWN and self._receiver is None:
            return
        self.reopen()
