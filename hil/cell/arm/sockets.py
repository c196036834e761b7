"""TCP connections that programs open to the outside: never blocking, polled once when asked.

What a peer sends arrives by the wall clock, as on a real box; how long a program waits for it is
bench time. A run with such a program repeats only as far as its peers do.
"""

import errno
import selectors
import socket
from typing import Final

_UNDER_WAY: Final = (0, errno.EINPROGRESS)

MAX_OPEN: Final = 64
"""Assumed: more means that a loop opens sockets without end."""

MAX_UNREAD: Final = 1 << 20
"""Bytes a peer may send ahead of the program; beyond that TCP holds it back."""


class _Connection:
    """One non-blocking socket with what it has received; `gone` once the peer has closed it."""

    __slots__ = ("gone", "link", "opening", "received")

    def __init__(self, link: socket.socket) -> None:
        self.link = link
        self.opening = True
        self.gone = False
        self.received = b""

    def poll(self) -> None:
        """Finish connecting, and take what has come."""
        if self.opening:
            self._finish()
        while not (self.opening or self.gone) and len(self.received) < MAX_UNREAD:
            try:
                got = self.link.recv(65536)
            except BlockingIOError:
                return
            except OSError:
                got = b""
            self.received += got
            self.gone = not got

    def _finish(self) -> None:
        with selectors.DefaultSelector() as selector:
            selector.register(self.link, selectors.EVENT_WRITE)
            if not selector.select(0):
                return
        self.opening = False
        self.gone = self.link.getsockopt(socket.SOL_SOCKET, socket.SO_ERROR) != 0


class Sockets:
    """Connections by the name that the program gives them; `close_all` when it ends."""

    __slots__ = ("_connections",)

    def __init__(self) -> None:
        self._connections: dict[str, _Connection] = {}

    def open(self, name: str, host: str, port: int) -> None:
        """Begin to connect; one of that name is closed before. ValueError when many are open."""
        self.close(name)
        if len(self._connections) >= MAX_OPEN:
            raise ValueError(f"{MAX_OPEN} sockets are open, which is all a program may have")
        link = socket.socket(socket.AF_INET, socket.SOCK_STREAM)
        link.setblocking(False)
        link.setsockopt(socket.IPPROTO_TCP, socket.TCP_NODELAY, 1)
        connection = self._connections[name] = _Connection(link)
        try:
            # An error that comes at once shows again when the connection is polled.
            connection.gone = link.connect_ex((host, port)) not in _UNDER_WAY
        except (OSError, UnicodeError):  # a host name that nobody knows, or that cannot be one
            connection.gone = True

    def connected(self, name: str) -> bool | None:
        """Whether the connection stands; None while that is not known yet."""
        connection = self._connections.get(name)
        if connection is None:
            return False
        connection.poll()
        if connection.gone and not connection.received:
            return False
        return None if connection.opening else True

    def unread(self, name: str) -> bytes:
        """What has come and was not taken."""
        connection = self._connections.get(name)
        if connection is None:
            return b""
        connection.poll()
        return connection.received

    def take(self, name: str, size: int) -> None:
        """Forget the first bytes of `unread`."""
        connection = self._connections[name]
        connection.received = connection.received[size:]

    def send(self, name: str, payload: bytes) -> bool:
        """False when nobody is there, or does not read: the controller waits for no peer."""
        connection = self._connections.get(name)
        if connection is None or connection.opening or connection.gone:
            return False
        try:
            return connection.link.send(payload) == len(payload)
        except OSError:
            return False

    def close(self, name: str) -> None:
        """Close one connection, if there is one of that name."""
        connection = self._connections.pop(name, None)
        if connection is not None:
            connection.link.close()

    def close_all(self) -> None:
        for name in tuple(self._connections):
            self.close(name)
