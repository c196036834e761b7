"""The script port: URScript text goes in; the state stream that comes back is thrown away."""

import socket
from contextlib import suppress
from typing import Final

from drivers.errors import LinkError
from drivers.ur.tcp import link_errors, open_stream

_CHUNK: Final = 65536


class ScriptPort:
    """One connection to the secondary interface, open until the uploaded program runs.

    Closing with the stream unread makes TCP reset the link, which can lose the program's text;
    leaving it open and unread fills the controller's buffers.
    """

    def __init__(self, host: str, port: int, limit: float) -> None:
        self._host = host
        self._port = port
        self._limit = limit
        self._stream: socket.socket | None = None

    def open(self) -> None:
        self.close()
        self._stream = open_stream(self._host, self._port, "script port", self._limit)

    def close(self) -> None:
        """Read what is left and drop the connection; never raises."""
        if self._stream is not None:
            with self._stream, suppress(OSError):
                self._stream.setblocking(False)
                while self._stream.recv(_CHUNK):
                    pass
        self._stream = None

    def upload(self, text: str) -> None:
        """Send one program; a `def` replaces the program that runs."""
        if self._stream is None:
            raise LinkError(f"script port at {self._host}:{self._port} is not connected")
        with link_errors(self._host, self._port, "script port", self._limit):
            self._stream.sendall(text.encode("ascii"))
