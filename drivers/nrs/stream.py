"""The driver's end of the sensor's TCP stream: taken without waiting, its errors made ours."""

import socket
from typing import Final

from drivers.errors import LinkError

RECEIVE: Final = 1 << 16
CONNECT_LIMIT: Final = 5.0
"""Wall seconds."""


class Stream:
    """One connection; whatever ends it ends it for good, until `open` is called again."""

    def __init__(self, host: str, port: int) -> None:
        self._address = (host, port)
        self._peer = f"sensor at {host}:{port}"
        self._socket: socket.socket | None = None

    @property
    def is_open(self) -> bool:
        return self._socket is not None

    def open(self) -> None:
        """Raises LinkError with the address and what to check."""
        self.close()
        try:
            connection = socket.create_connection(self._address, timeout=CONNECT_LIMIT)
        except ConnectionRefusedError:
            raise LinkError(
                f"{self._peer} refused; check address, port and that it is switched on"
            ) from None
        except OSError as error:
            reason = error.strerror or f"no answer within {CONNECT_LIMIT:g} s"
            raise LinkError(f"{self._peer} cannot be reached: {reason}") from error
        connection.setblocking(False)
        connection.setsockopt(socket.IPPROTO_TCP, socket.TCP_NODELAY, 1)
        self._socket = connection

    def close(self) -> None:
        if self._socket is not None:
            self._socket.close()
        self._socket = None

    def take(self) -> bytes:
        """Everything that is here now; raises LinkError, with nothing kept, once it is cut."""
        chunks: list[bytes] = []
        while not chunks or len(chunks[-1]) == RECEIVE:
            try:
                chunk = self._opened().recv(RECEIVE)
            except BlockingIOError:
                break
            except OSError as error:
                raise self._cut(error.strerror) from error
            if not chunk:
                raise self._cut("it closed the connection")
            chunks.append(chunk)
        return b"".join(chunks)

    def send(self, octets: bytes) -> None:
        """Three bytes always fit in an idle socket's buffer; raises LinkError where they do not."""
        try:
            self._opened().sendall(octets)
        except OSError as error:
            raise self._cut(error.strerror) from error

    def _opened(self) -> socket.socket:
        if self._socket is None:
            raise LinkError(f"{self._peer} is not connected: call connect() first")
        return self._socket

    def _cut(self, reason: str | None) -> LinkError:
        self.close()
        return LinkError(
            f"{self._peer}: link lost ({reason}); if the sensor restarted, its tare is gone: "
            "connect() and start() again"
        )
