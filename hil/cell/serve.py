"""The cell with its doors open: TCP and CAN outside, the bench inside, paced by a clock."""

from collections.abc import Callable
from typing import NamedTuple, Self

from drivers.protocol.bus_address import BusAddress
from drivers.protocol.frame import CanFrame
from hil.cell.arm.modes import Event
from hil.cell.arm.server import UrServer
from hil.cell.bench import Bench
from hil.cell.clock import Schedule
from hil.cell.plant.interface import PlantStep
from hil.cell.sensor.gateway import Gateway
from hil.cell.sensor.tcp_port import TcpPort

WAKE = 0.05
"""How long, in wall seconds, a wait for commands lasts before the stop flag is looked at."""


LOST = 2_000_000_000
"""Bench time, ns, after which a cell in lockstep waits for a client that gets nothing: longer than
any watchdog of the robot's, and the same in every run."""

COARSE = 2_000_000
"""Shortest wait, ns, that is left to epoll, whose time-outs are whole milliseconds, rounded up."""
NAP = 200_000
"""Longest sleep between two looks at the doors in a shorter wait, ns."""


class Doors(NamedTuple):
    """Where the cell can be reached; sensor: host and port of the sensor's TCP front, if any."""

    host: str
    ports: dict[str, int]
    can: BusAddress
    sensor: tuple[str, int] | None = None


class Traffic(NamedTuple):
    """periods: passed so far. clients: on each port now. events: at the doors, by kind."""

    periods: int
    clients: dict[str, int]
    events: dict[str, int]


class Tick(NamedTuple):
    """One period as it left the cell: its end in bench time, ns, the bus traffic, the truth."""

    t: int
    frames: list[tuple[int, CanFrame]]
    truth: PlantStep


Observer = Callable[[Tick], None]
Stopped = Callable[[], bool]


class ServedCell:
    """Owns sockets and bus; `lockstep` or `wall` runs it in the caller's thread until stopped."""

    def __init__(
        self,
        bench: Bench,
        server: UrServer,
        gateway: Gateway,
        host: str,
        sensor_port: TcpPort | None = None,
        *,
        ahead: bool = False,
    ) -> None:
        """ahead: in lockstep no command can arrive within the period that it answers."""
        self.bench, self.server, self.gateway = bench, server, gateway
        self._ahead = ahead
        self._sensor_port = sensor_port
        self._host = host
        self._step = 0

    @property
    def doors(self) -> Doors:
        port = self._sensor_port
        sensor = None if port is None else port.address
        return Doors(self._host, self.server.ports, self.gateway.address, sensor)

    def describe(self) -> str:
        """One line for people: which bus was taken."""
        return self.gateway.describe()

    def power_up(self) -> None:
        """Power on and release the brakes, as somebody at the pendant would."""
        self.bench.arm.box.post(Event.BRAKE_RELEASE)

    def traffic(self) -> Traffic:
        """Who is there, and what the cell did not go along with."""
        clients, events = self.server.visitors, self.bench.arm.box.doors.counts
        if self._sensor_port is not None:
            clients = {**clients, "sensor": self._sensor_port.clients}
        return Traffic(self._step, clients, events)

    def lockstep(self, stopped: Stopped, observe: Observer) -> None:
        """One period for each command of a client that writes inputs, no sleep.

        What arrived on any door before the command is handled before its period. A period whose
        package is still on its way when it ends needs no command: nobody could answer yet.
        Where the rig's delays allow it, the next period begins while the host thinks.
        """
        edge = self.bench.t
        while not stopped():
            self.server.poll(edge, WAKE)
            if not self.server.take_commands():
                continue
            self.server.poll(edge, 0.0)
            self.server.take_commands()
            edge = self._until_answerable(observe)
            if self._ahead:
                self.bench.begin()

    def coast(self, periods: int, observe: Observer) -> None:
        """So many periods that nobody's command releases: what the cell does when left alone."""
        for _ in range(periods):
            self.server.poll(self.bench.t, 0.0)
            self.server.take_commands()
            self._tick()
            self._send(self.bench.t, observe)

    def _until_answerable(self, observe: Observer) -> int:
        """Tick until a package reaches a client; the bench time at which it does, ns.

        A client that hears nothing for so long will not answer, however long the cell goes on.
        """
        given_up = self.bench.t + LOST
        while True:
            self._tick()
            t = self.bench.t
            due = self.server.next_due
            answerable = due is None or due < t + self.bench.period
            edge = t if due is None or not answerable else max(t, due)
            self._send(edge, observe)
            if not answerable and t >= given_up:
                self.give_up()
            elif not answerable:
                continue
            return edge

    def give_up(self) -> None:
        """Nothing reaches a client, and in lockstep time stands until it says something."""

    def wall(self, stopped: Stopped, observe: Observer, schedule: Schedule) -> None:
        """Periods by the monotonic clock; a late one is counted and made up for, never dropped."""
        while not stopped():
            self._wait(schedule)
            schedule.begin()
            self.server.ration()
            self.server.poll(self.bench.t, 0.0)
            self._tick()
            self._send(self.bench.t, observe)

    def _wait(self, schedule: Schedule) -> None:
        """Serve the doors until the next period is due; packages leave when their delay is over."""
        while (remaining := schedule.remaining()) > 0:
            now = self.bench.t + self.bench.period - remaining
            self.server.flush(now)
            due = self.server.next_due
            pause = remaining if due is None else min(remaining, max(0, due - now))
            if pause >= COARSE:
                self.server.poll(now, min((pause - COARSE // 2) * 1e-9, WAKE))
            else:
                self.server.poll(now, 0.0)
                schedule.nap(min(pause, NAP))
        self.server.take_commands()

    def _tick(self) -> None:
        self.bench.begin()
        self.bench.put_on_bus(self.gateway.receive())
        port = self._sensor_port
        if port is not None:
            port.take(self.bench.t, self.bench.t + self.bench.period)
        self.bench.finish()
        if port is not None:
            port.publish(self.bench.t)
        self._step += 1
        self.server.publish(self.bench.t, self._step)

    def _send(self, edge: int, observe: Observer) -> None:
        """The sensor goes out before RTDE, so the RTDE package is the edge of the period.

        The observer comes first: what it sees is not mixed with what a host does upon it.
        """
        frames = self.bench.take_from_bus(edge)
        observe(Tick(self.bench.t, frames, self.bench.truth))
        self.gateway.send([frame for _, frame in frames])
        if self._sensor_port is not None:
            self._sensor_port.flush(edge)
        self.server.flush(edge)

    def close(self) -> None:
        self.server.close()
        self.gateway.close()
        if self._sensor_port is not None:
            self._sensor_port.close()

    def __enter__(self) -> Self:
        return self

    def __exit__(self, *_: object) -> None:
        self.close()
