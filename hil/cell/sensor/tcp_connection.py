"""One TCP client of the sensor: its socket, its session, and what travels between them."""

import socket
from typing import Final

import numpy as np

from drivers.protocol.errors import WireError
from hil.cell.errors import CellError
from hil.cell.link import Link
from hil.cell.rig.task import Link as Laws
from hil.cell.sensor.tcp_session import TcpSession

RECEIVE: Final = 4096
MAX_UNREAD: Final = 1 << 18
"""Bytes kept, beyond the kernel's buffer, for a client that does not read: 5 s of the stream."""


class Ended(CellError):  # noqa: N818 - an event, not a fault of the cell
    """The connection is over; the message says why, "" when the client simply left."""


class TcpConnection:
    """Delays bytes by the rig's laws in bench time; the order of a stream is kept."""

    def __init__(
        self, client: socket.socket, session: TcpSession, laws: Laws, rng: np.random.Generator
    ) -> None:
        client.setblocking(False)
        client.setsockopt(socket.IPPROTO_TCP, socket.TCP_NODELAY, 1)
        self.session = session
        self._client = client
        to_cell, from_cell = rng.spawn(2)
        self._in: Link[bytes] = Link(laws.to_cell, to_cell)
        self._travelling: Link[bytes] = Link(laws.from_cell, from_cell)
        self._out = b""

    def take(self, t: int, until: int) -> None:
        """Read what came by t, and do what has travelled by `until`, ns; raises Ended."""
        try:
            octets = self._client.recv(RECEIVE)
        except BlockingIOError:
            octets = None
        except OSError:
            octets = b""
        if octets:
            self._in.push(t, octets)
        try:
            for arrival, arrived in self._in.due(until):
                self.session.receive(arrived, arrival)
        except WireError as error:
            raise Ended(f"cut off: {error}") from None
        if octets == b"":
            raise Ended("")

    def publish(self, t: int) -> None:
        """Put what the session says of the period that ended at t on its way."""
        self._travelling.extend(self.session.publish(t))

    def flush(self, t: int) -> None:
        """Hand the kernel what has travelled by t; raises Ended for a client that is gone."""
        self._out += b"".join([octets for _, octets in self._travelling.due(t)])
        if not self._out:
            return
        try:
            self._out = self._out[self._client.send(self._out) :]
        except BlockingIOError:
            pass
        except OSError:
            raise Ended("") from None
        if len(self._out) > MAX_UNREAD:
            raise Ended(f"cut off: {len(self._out)} bytes unread, allowed are {MAX_UNREAD}")

    def close(self) -> None:
        self.session.close()
        self._client.close()
