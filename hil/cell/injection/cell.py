"""A served cell that fails on schedule, and is told out of band where the job stands."""

from collections.abc import Callable

from hil.cell.arm.server import UrServer
from hil.cell.bench import Bench
from hil.cell.faults.log import FaultEvent
from hil.cell.injection.injection import Injection
from hil.cell.injection.server import InjectedServer
from hil.cell.sensor.gateway import Gateway
from hil.cell.sensor.tcp_port import TcpPort
from hil.cell.serve import ServedCell


class InjectedCell(ServedCell):
    """What is told before a command is known in the period that the command lets pass, so no
    period begins while the host thinks.
    """

    def __init__(  # noqa: PLR0917  those of a served cell
        self,
        injection: Injection,
        bench: Bench,
        server: UrServer,
        gateway: Gateway,
        host: str,
        sensor_port: TcpPort | None = None,
    ) -> None:
        super().__init__(bench, server, gateway, host, sensor_port)
        self._injection = injection

    def note(self, phase: str, episode: int) -> None:
        """Where the job stands, by its own name of the phase; episodes count from 1."""
        self._injection.note(phase, episode)

    def leave(self, duration: int) -> None:
        """The host is not there for so long, ns: the cell goes on without it."""
        assert isinstance(self.server, InjectedServer)
        self.server.leave(duration)

    @property
    def deserted(self) -> bool:
        """Whether the cell goes on without anybody, as nobody can come back yet."""
        assert isinstance(self.server, InjectedServer)
        return self.server.deserted

    def give_up(self) -> None:
        """Cut clients off, as their own limit on silence would: here no clock runs towards it."""
        assert isinstance(self.server, InjectedServer)
        self.server.cut_off("nothing reaches it any more")

    def listen(self, hear: Callable[[], None]) -> None:
        """Let `hear` call `note` and `leave` at the moments when they may still matter."""
        self._injection.hear = hear

    @property
    def events(self) -> tuple[FaultEvent, ...]:
        """What became of the faults so far."""
        return self._injection.events(self.bench.t)
