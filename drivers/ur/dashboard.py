"""The dashboard client: power, brakes and the release of stops, one line a command."""

import socket
from collections import deque
from typing import Final

from drivers.errors import LinkError, ProtocolError, RobotStateError
from drivers.protocol.dashboard import GREETING, LineCutter, encode
from drivers.protocol.errors import WireError
from drivers.ur.tcp import link_errors, open_stream

_UNLOCK_TOO_EARLY: Final = "Cannot unlock protective stop until 5s"


class Dashboard:
    """One dashboard connection, opened by the first command."""

    def __init__(self, host: str, port: int, limit: float) -> None:
        self._host = host
        self._port = port
        self._limit = limit
        self._stream: socket.socket | None = None
        self._cutter = LineCutter()
        self._lines: deque[str] = deque()

    def close(self) -> None:
        """Drop the connection; never raises."""
        if self._stream is not None:
            self._stream.close()
        self._stream = None

    def power_on(self) -> None:
        self._demand("power on", "Powering on")

    def release_brakes(self) -> None:
        self._demand("brake release", "Brake releasing")

    def stop(self) -> None:
        """Stop whatever program runs."""
        self._demand("stop", "Stopped")

    def unlock_protective_stop(self) -> bool:
        """Release a protective stop; false while the controller's 5 s of waiting last."""
        reply = self.request("unlock protective stop")
        if reply.startswith(_UNLOCK_TOO_EARLY):
            return False
        if reply != "Protective stop releasing":
            raise RobotStateError(f"the dashboard answers 'unlock protective stop' with '{reply}'")
        return True

    def request(self, command: str) -> str:
        """Send a command; its reply."""
        if self._stream is None:
            self._open()
        stream = self._connected()
        with link_errors(self._host, self._port, "dashboard", self._limit):
            stream.sendall(encode(command))
        return self._line()

    def _demand(self, command: str, expected: str) -> None:
        reply = self.request(command)
        if reply != expected:
            raise RobotStateError(f"the dashboard answers '{command}' with '{reply}'")

    def _open(self) -> None:
        self._cutter, self._lines = LineCutter(), deque()
        self._stream = open_stream(self._host, self._port, "dashboard", self._limit)
        greeting = self._line()
        if greeting != GREETING:
            self.close()
            raise ProtocolError(f"no dashboard at {self._host}:{self._port}: it says '{greeting}'")

    def _connected(self) -> socket.socket:
        if self._stream is None:
            raise LinkError(f"dashboard at {self._host}:{self._port} is not connected")
        return self._stream

    def _line(self) -> str:
        stream = self._connected()
        while not self._lines:
            with link_errors(self._host, self._port, "dashboard", self._limit):
                received = stream.recv(4096)
            if not received:
                self.close()
                raise LinkError(f"dashboard at {self._host}:{self._port} closed the connection")
            try:
                self._lines.extend(self._cutter.feed(received))
            except WireError as error:
                raise ProtocolError(str(error)) from error
        return self._lines.popleft()
