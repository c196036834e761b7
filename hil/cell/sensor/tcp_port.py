"""The sensor's TCP port: clients come and go, the node behind it is the one on the CAN bus."""

import socket
from collections.abc import Callable
from contextlib import suppress
from typing import Final

import numpy as np

from hil.cell.errors import DoorError
from hil.cell.rig.sensor import Sensor
from hil.cell.rig.task import Link as Laws
from hil.cell.sensor.node import SensorNode
from hil.cell.sensor.tcp_connection import Ended, TcpConnection
from hil.cell.sensor.tcp_session import TcpSession

CLIENTS: Final = 8
"""More are turned away: each costs its share of every period."""


class TcpPort:
    """Listens from construction on (DoorError when it cannot); never waits.

    host: where to listen unless the sensor's section says. say: told in one line why a client was
    cut off or turned away.
    """

    def __init__(
        self,
        node: SensorNode,
        sensor: Sensor,
        *,
        host: str,
        laws: Laws,
        rng: np.random.Generator,
        say: Callable[[str], None],
    ) -> None:
        self._node, self._sensor, self._laws, self._rng = node, sensor, laws, rng
        self._say = say
        self._boots = node.boots
        self._connections: list[TcpConnection] = []
        self._listener = _listen(sensor.tcp.host or host, sensor.tcp.port)

    @property
    def address(self) -> tuple[str, int]:
        """Where a driver finds it."""
        host, port = self._listener.getsockname()
        return host, port

    @property
    def clients(self) -> int:
        """Connections now."""
        return len(self._connections)

    def take(self, t: int, until: int) -> None:
        """Before a period: accept and read what came by t; commands that arrive by `until`, ns."""
        if self._boots != self._node.boots:
            self._boots = self._node.boots
            self.drop_all()  # a sensor that restarts knows no client
        if not self._node.booting:
            self._accept()
        self._each(lambda connection: connection.take(t, until))
        self._node.listened = any(one.session.listening for one in self._connections)

    def publish(self, t: int) -> None:
        """After a period that ended at t, ns: its samples start to travel."""
        for connection in self._connections:
            connection.publish(t)

    def flush(self, t: int) -> None:
        """Send what has travelled by t, ns."""
        self._each(lambda connection: connection.flush(t))

    def drop_all(self) -> None:
        for connection in self._connections:
            connection.close()
        self._connections.clear()

    def close(self) -> None:
        self.drop_all()
        self._listener.close()

    def _accept(self) -> None:
        with suppress(OSError):  # nobody there, or gone between knocking and opening
            for _ in range(2 * CLIENTS):  # a flood of clients does not hold the period
                client, _ = self._listener.accept()
                if len(self._connections) < CLIENTS:
                    self._connections.append(self._connect(client))
                else:
                    client.close()
                    self._say(f"sensor TCP: turned away, {CLIENTS} clients are there")

    def _connect(self, client: socket.socket) -> TcpConnection:
        (rng,) = self._rng.spawn(1)  # a client's delays do not depend on other clients
        return TcpConnection(client, TcpSession(self._node, self._sensor), self._laws, rng)

    def _each(self, act: Callable[[TcpConnection], None]) -> None:
        for connection in tuple(self._connections):
            try:
                act(connection)
            except Ended as end:
                self._connections.remove(connection)
                connection.close()
                if str(end):
                    self._say(f"sensor TCP: {end}")


def _listen(host: str, port: int) -> socket.socket:
    try:
        listener = socket.create_server((host, port), backlog=CLIENTS)
    except OSError as error:
        raise DoorError(
            f"sensor port {host}:{port} cannot be opened ({error.strerror}); stop what holds it, "
            "or set sensor.tcp.port to 0 for a free port"
        ) from None
    listener.setblocking(False)
    return listener
