"""A listening TCP port of the control box: opened, and what comes of those who knock."""

import socket
from typing import Final

from hil.cell.errors import DoorError

BACKLOG: Final = 32
"""Clients that may knock at once; the kernel lets further ones try again after a second."""

KEEPALIVE: Final = (("TCP_KEEPIDLE", 10), ("TCP_KEEPINTVL", 5), ("TCP_KEEPCNT", 3))
"""A silent peer that is no more (its host lost power) is found out after 25 s; until then it holds
its RTDE inputs. Not every system has these options; then its own defaults hold."""


def listen(door: str, host: str, port: int) -> socket.socket:
    """The open port; DoorError says who holds it and what to do."""
    listener = socket.socket(socket.AF_INET, socket.SOCK_STREAM)
    listener.setsockopt(socket.SOL_SOCKET, socket.SO_REUSEADDR, 1)
    try:
        listener.bind((host, port))
        listener.listen(BACKLOG)
    except OSError as error:
        listener.close()
        raise DoorError(
            f"{door} port {host}:{port} cannot be opened ({error.strerror}); stop what "
            f"holds it, or set robot.ports.{door} to 0 for a free port"
        ) from None
    listener.setblocking(False)
    return listener


def accept(listener: socket.socket) -> socket.socket | None:
    """The next client, None when nobody is left at the door; OSError when there is no room."""
    try:
        client, _ = listener.accept()
    except (BlockingIOError, ConnectionAbortedError):  # left between knocking and opening
        return None
    client.setblocking(False)
    client.setsockopt(socket.IPPROTO_TCP, socket.TCP_NODELAY, 1)
    client.setsockopt(socket.SOL_SOCKET, socket.SO_KEEPALIVE, 1)
    for name, value in KEEPALIVE:
        if hasattr(socket, name):
            client.setsockopt(socket.IPPROTO_TCP, getattr(socket, name), value)
    return client
