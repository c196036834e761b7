"""The control box's doors, with faults at them: refusals, resets, a client that is not there."""

import socket
from collections.abc import Iterator
from typing import Final

import numpy as np

from hil.cell.arm.connection import Connection, Cut
from hil.cell.arm.door_log import Event
from hil.cell.arm.listener import accept
from hil.cell.arm.ownership import FIELDBUS
from hil.cell.arm.rtde_session import RtdeSession
from hil.cell.arm.server import UrServer
from hil.cell.faults.injector import Running
from hil.cell.injection.injection import Injection, Switch
from hil.cell.injection.link import (
    FROM_CELL,
    NS,
    TO_CELL,
    Delays,
    InjectedConnection,
    RtdeLink,
    linger,
)
from hil.cell.injection.robot import InjectedArm
from hil.cell.rig.robot import Ports
from hil.cell.rig.task import Link

GONE: Final = 500_000_000
"""Bench time, ns, for which the cell goes on without a client whose connection was cut: enough for
the robot's own watchdogs to act before anybody can come back."""


class InjectedServer(UrServer):
    """Reads faults before and after each period of the cell, as an `Act`."""

    def __init__(  # noqa: PLR0917  those of a sound server
        self, injection: Injection, arm: InjectedArm, ports: Ports, host: str, link: Link,
        rng: np.random.Generator,
    ) -> None:  # fmt: skip
        super().__init__(arm, ports, host, link, rng)
        self._box_and_arm, self._injection = arm, injection
        self._rtde_link = RtdeLink(injection)
        self._turned_away: dict[int, int] = {}
        ownership = arm.box.ownership
        injection.add(
            self,
            Switch(injection, "T5", self._cut),
            Switch(injection, "R10", self._reboot),
            Switch(
                injection,
                "T12",
                lambda one, t: self._rtde_link.seize(ownership, one, t),
                lambda: ownership.release(FIELDBUS),
            ),
        )

    def before(self, t: int) -> None:
        self._rtde_link.now = t

    def after(self, t: int) -> None:
        """A spike is over with the period's own packages, which have set out by the next one."""
        self._rtde_link.now = t
        for one in self._rtde_link.of("T2"):
            if one.effect is not None and t > one.effect[0]:
                one.spent = True

    def leave(self, duration: int) -> None:
        """For so long, ns, no client is heard or hears anything; the cell goes on meanwhile."""
        self._rtde_link.absent = self._rtde_link.now + duration

    @property
    def deserted(self) -> bool:
        """Whether no client is heard or hears anything now."""
        return self._rtde_link.absent > self._rtde_link.now

    def cut_off(self, why: str) -> None:
        """Drop every RTDE client."""
        for connection, _ in tuple(self._rtde):
            self._drop(connection, Cut(Event.LOST, why))

    def poll(self, t: int, timeout: float | None) -> None:
        self._rtde_link.now = t
        super().poll(t, timeout)

    def take_commands(self) -> int:
        """A cell whose only client is gone goes on as if it had been told to."""
        self._injection.hear()
        count = super().take_commands()
        return count or int(not self._rtde and self.deserted)

    @property
    def next_due(self) -> int | None:
        """Nobody can answer while nobody is there."""
        due, absent = super().next_due, self._rtde_link.absent
        return due if absent <= self._rtde_link.now else max(due or 0, absent)

    def _accept(self, door: str) -> bool:
        for one in self._rtde_link.of("T6"):
            if door == "rtde" and self._turned_away.get(one.index, 0) < one.fault.number("count"):
                self._refuse(one, door)
                return True
        return super()._accept(door)

    def _refuse(self, one: Running, door: str) -> None:
        client = accept(self._listeners[door])
        if client is not None:
            linger(client)
            client.close()
            self._turned_away[one.index] = self._turned_away.get(one.index, 0) + 1
            one.felt(self._rtde_link.now, "a client is turned away")
            self._doors.note(Event.TURNED_AWAY, f"{door}: refused")

    def _rtde_ends(
        self, client: socket.socket, to_cell: Iterator[int], from_cell: Iterator[int]
    ) -> tuple[Connection, RtdeSession]:
        link = self._rtde_link
        session = RtdeSession(self._arm, self._clients, Delays(to_cell, link, TO_CELL))
        delays = Delays(from_cell, link, FROM_CELL)
        return InjectedConnection(client, session, delays, link), session

    def _cut(self, one: Running, t: int) -> None:
        """Drop every RTDE client."""
        for connection, _ in tuple(self._rtde):
            assert isinstance(connection, InjectedConnection)
            connection.reset(one.fault.word("how"))
            self._drop(connection, Cut(Event.LOST, "connection reset"))
            one.done(t, one.fault.word("how"))
            self.leave(GONE)

    def _reboot(self, one: Running, t: int) -> None:
        """Drop everybody and start the box anew; the doors are deaf until it is up."""
        for connection in tuple(self._connections):
            linger(connection.socket)
            self._drop(connection, Cut(Event.LOST, "the controller restarts"))
        self._box_and_arm.restart()
        self.leave(round(one.fault.number("down") * NS))
        one.done(t, "power off")
