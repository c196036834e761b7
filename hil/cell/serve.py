"""The cell with its doors open: TCP and CAN outside, the bench inside, paced by a clock."""

from collections.abc import Callable
from typing import NamedTuple

from hil.cell.arm.server import UrServer
from hil.cell.bench import Bench, Tick
from hil.cell.clock import Schedule
from hil.cell.sensor.gateway import BusAddress, Gateway

Observer = Callable[[Tick], None]
Stopped = Callable[[], bool]
WAKE = 0.05
"""How long, in wall seconds, a wait for commands lasts before the stop flag is looked at."""


class Doors(NamedTuple):
    """Where the cell can be reached."""

    host: str
    ports: dict[str, int]
    can: BusAddress


class ServedCell:
    """Owns sockets and bus; `lockstep` or `wall` runs it in the caller's thread until stopped."""

    def __init__(self, bench: Bench, server: UrServer, gateway: Gateway) -> None:
        self.bench, self._server, self._gateway = bench, server, gateway
        self._step = 0

    @property
    def doors(self) -> Doors:
        return Doors(self._server.host, self._server.ports, self._gateway.address)

    def describe(self) -> str:
        """One line for people: which bus was taken."""
        return self._gateway.describe()

    def lockstep(self, stopped: Stopped, observe: Observer) -> None:
        """One period for each command of the client that holds the input recipe, no sleep.

        What arrived before the command on any other door is handled before its period.
        """
        while not stopped():
            self._server.poll(self.bench.t, WAKE)
            if self._server.take_commands():
                self._server.poll(self.bench.t, 0.0)
                self._server.take_commands()
                self._period(observe)

    def wall(self, stopped: Stopped, observe: Observer, schedule: Schedule) -> None:
        """Periods by the monotonic clock; a late one is counted and made up for, never dropped."""
        while not stopped():
            while (remaining := schedule.remaining()) > 0.0:
                self._server.poll(self.bench.t, min(remaining, WAKE))
            schedule.begin()
            self._server.poll(self.bench.t, 0.0)
            self._server.take_commands()
            self._period(observe)

    def _period(self, observe: Observer) -> None:
        """CAN goes out before RTDE, so the RTDE package is the edge of the period."""
        self.bench.receive(self._gateway.receive())
        tick = self.bench.tick()
        self._gateway.send(tick.frames)
        self._step += 1
        self._server.publish(tick.t, self._step)
        self._server.flush(tick.t)
        observe(tick)

    def close(self) -> None:
        self._server.close()
        self._gateway.close()

    def __enter__(self) -> "ServedCell":
        return self

    def __exit__(self, *_: object) -> None:
        self.close()
