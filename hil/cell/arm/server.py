"""The control box's five TCP ports: the only file of the arm that touches a socket's life.

It never blocks but in `poll`, and reads no clock: what arrives in a call of `poll` arrives at the
bench time that the caller names.
"""

import selectors
import socket
from collections.abc import Callable, Iterator, Mapping
from itertools import repeat
from typing import Final, Self

import numpy as np

from hil.cell.arm.box import ControlBox
from hil.cell.arm.connection import Connection, Cut, Session
from hil.cell.arm.controller import ArmController
from hil.cell.arm.dashboard_session import DashboardSession
from hil.cell.arm.door_log import Event
from hil.cell.arm.listener import accept, listen
from hil.cell.arm.rtde_session import RtdeSession
from hil.cell.arm.script_session import ScriptSession
from hil.cell.arm.streams.stream import PrimaryStream, RealtimeStream, SecondaryStream, Stream
from hil.cell.errors import DoorError
from hil.cell.rig import LatencyLaw
from hil.cell.rig.robot import Ports
from hil.cell.rig.task import Link

DOORS: Final = ("dashboard", "primary", "secondary", "realtime", "rtde")
CLIENTS: Final = 32
"""On one port at a time; eight programs of ur_rtde hold 24 connections to RTDE."""
ROUNDS: Final = 8
"""Looks at the doors in one `poll`: a flood of clients does not hold the control loop."""
_STREAMS: Final[Mapping[str, Callable[[ControlBox], Stream]]] = {
    "primary": PrimaryStream,
    "secondary": SecondaryStream,
    "realtime": RealtimeStream,
}
DRAWN_AT_ONCE: Final = 256
"""Delays drawn in one call: a scalar draw costs a microsecond, a block of them little more."""


class UrServer:
    """Doors to one arm; `with` opens and closes them. ports: the real ones, once open."""

    def __init__(
        self,
        arm: ArmController,
        ports: Ports,
        host: str,
        link: Link,
        rng: np.random.Generator,
    ) -> None:
        """link, rng: travel times of RTDE data packages; each client has its own streams."""
        self.host = host
        self.ports: dict[str, int] = {}
        self._arm = arm
        self._wanted = ports
        self._link = link
        self._rng = rng
        self._selector: selectors.BaseSelector | None = None
        self._listeners: dict[str, socket.socket] = {}
        self._connections: list[Connection] = []
        self._rtde: list[tuple[Connection, RtdeSession]] = []
        self._streams: list[Connection] = []
        self._clients = 0
        self._commands = 0
        self._resting: list[Connection] = []
        self._doors = arm.box.doors

    def __enter__(self) -> Self:
        return self.open()

    def __exit__(self, *exception: object) -> None:
        self.close()

    def open(self) -> Self:
        """Listen on every port; DoorError says which one is taken, and leaves none open."""
        self._selector = selectors.DefaultSelector()
        try:
            for door in DOORS:
                listener = listen(door, self.host, getattr(self._wanted, door))
                self._listeners[door] = listener
                self.ports[door] = listener.getsockname()[1]
                self._selector.register(listener, selectors.EVENT_READ, door)
        except DoorError:
            self.close()
            raise
        return self

    def close(self) -> None:
        """Close every connection and every port; may be called again."""
        for connection in tuple(self._connections):
            self._drop(connection, Cut(Event.LEFT, "the cell closes"))
        self._arm.box.sockets.close_all()
        for listener in self._listeners.values():
            listener.close()
        self._listeners.clear()
        if self._selector is not None:
            self._selector.close()
            self._selector = None

    def poll(self, t: int, timeout: float | None) -> None:
        """Accept and read what has come, at bench time t, ns; wait `timeout` s for the first.

        What a new client sent with its connection is read too.
        """
        for _ in range(ROUNDS):
            if not self._serve(t, timeout):
                return
            timeout = 0.0

    def ration(self) -> None:
        """Begin a control period in which no client is heard beyond its session's share.

        For a cell that a clock paces: a flood waits in the kernel's buffers, not the control loop.
        """
        for connection in self._connections:
            connection.left = connection.session.share
        assert self._selector is not None
        for connection in self._resting:
            self._selector.register(connection.socket, selectors.EVENT_READ, connection)
        self._resting.clear()

    @property
    def commands(self) -> int:
        """Valid RTDE data packages since the last `take_commands`."""
        return self._commands + sum(session.commands for _, session in self._rtde)

    def take_commands(self) -> int:
        """The count of `commands`, which starts anew."""
        count, self._commands = self.commands, 0
        for _, session in self._rtde:
            session.commands = 0
        return count

    @property
    def clients(self) -> int:
        """Connections on all ports."""
        return len(self._connections)

    @property
    def visitors(self) -> dict[str, int]:
        """Connections on each port."""
        return {door: sum(c.door == door for c in self._connections) for door in DOORS}

    def publish(self, t: int, step: int) -> None:
        """Build the packages of control step `step` and put them on their way at t, ns.

        Streams leave with the next `flush`, without a travel time: nobody servos by them.
        """
        for connection, _ in self._rtde:
            connection.publish(t, step)
        for connection in self._streams:
            connection.stream(step)

    @property
    def next_due(self) -> int | None:
        """When the next package reaches a client, ns; None when none is on its way."""
        return min((d for c, _ in self._rtde if (d := c.next_due) is not None), default=None)

    def flush(self, t: int) -> None:
        """Send what is due at t, ns: one send for each client."""
        for connection in tuple(self._connections):
            self._guarded(connection, lambda c: c.flush(t))

    def _serve(self, t: int, timeout: float | None) -> bool:
        """One look at every door and client; whether somebody new came in."""
        assert self._selector is not None, "poll needs open ports"
        accepted = False
        for key, _ in self._selector.select(timeout):
            if isinstance(key.data, Connection):
                self._guarded(key.data, lambda c: c.read(t))
                if key.data.left <= 0:
                    self._rest(key.data)
            else:
                accepted |= self._accept(key.data)
        return accepted

    def _accept(self, door: str) -> bool:
        try:
            client = accept(self._listeners[door])
        except OSError as error:  # no descriptor is free
            self._doors.note(Event.TURNED_AWAY, f"{door}: turned away: {error.strerror}")
            return False
        if client is None:
            return False
        if sum(connection.door == door for connection in self._connections) >= CLIENTS:
            client.close()
            self._doors.note(Event.TURNED_AWAY, f"{door}: turned away, {CLIENTS} clients are there")
            return True
        self._clients += 1
        connection = self._connect(door, client)
        self._connections.append(connection)
        assert self._selector is not None
        self._selector.register(client, selectors.EVENT_READ, connection)
        self._guarded(connection, Connection.send)
        return True

    def _connect(self, door: str, client: socket.socket) -> Connection:
        if door != "rtde":
            connection = Connection(door, client, self._session(door), repeat(0))
            if connection.session.lossy:
                self._streams.append(connection)
            return connection
        to_cell, from_cell = self._rng.spawn(2)  # a client's delays do not depend on other clients
        connection, session = self._rtde_ends(
            client,
            _delays(self._link.to_cell, to_cell),
            _delays(self._link.from_cell, from_cell),
        )
        self._rtde.append((connection, session))
        return connection

    def _rtde_ends(
        self, client: socket.socket, to_cell: Iterator[int], from_cell: Iterator[int]
    ) -> tuple[Connection, RtdeSession]:
        """A client's connection and session, with the travel times of either direction, ns."""
        session = RtdeSession(self._arm, self._clients, to_cell)
        return Connection("rtde", client, session, from_cell), session

    def _session(self, door: str) -> Session:
        if door == "dashboard":
            return DashboardSession(self._arm)
        return ScriptSession(self._arm, _STREAMS[door](self._arm.box))

    def _guarded(self, connection: Connection, act: Callable[[Connection], None]) -> None:
        """Do it; a connection that ends by it is dropped with a line in the log."""
        try:
            act(connection)
        except Cut as cut:
            self._drop(connection, cut)

    def _rest(self, connection: Connection) -> None:
        """Hear no more of it in this period, if it is still there."""
        if connection not in self._connections:
            return
        assert self._selector is not None
        self._selector.unregister(connection.socket)
        self._resting.append(connection)
        self._doors.count(Event.RESTED)

    def _drop(self, connection: Connection, cut: Cut) -> None:
        assert self._selector is not None
        if connection in self._resting:
            self._resting.remove(connection)
        else:
            self._selector.unregister(connection.socket)
        self._connections.remove(connection)
        self._streams = [other for other in self._streams if other is not connection]
        for pair in tuple(self._rtde):
            if pair[0] is connection:
                self._commands += pair[1].commands
                self._rtde.remove(pair)
        connection.close()
        self._doors.note(cut.event, f"{connection.door}: {cut}")


def _delays(law: LatencyLaw, rng: np.random.Generator) -> Iterator[int]:
    while True:
        yield from law.draws(rng, DRAWN_AT_ONCE)
