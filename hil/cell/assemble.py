"""The far side's composition root: a rig's cell put together, sound or with faults."""

from contextlib import ExitStack
from typing import TYPE_CHECKING

from hil.cell.arm.server import UrServer
from hil.cell.bench import Bench
from hil.cell.builder import Builder
from hil.cell.errors import RigError
from hil.cell.faults.schedule import Numbered
from hil.cell.rig import Rig
from hil.cell.sensor.gateway import Gateway
from hil.cell.sensor.tcp_port import TcpPort
from hil.cell.serve import ServedCell

if TYPE_CHECKING:
    from hil.cell.injection.cell import InjectedCell


def build_bench(rig: Rig, seed: int) -> Bench:
    """Arm, plant and sensor of a rig, everything random from `seed`; no socket, no bus."""
    return Builder(rig, seed).bench()


def serve(rig: Rig, seed: int, across_processes: bool) -> ServedCell:
    """The cell with its doors open; raises DoorError, and leaves none open when one fails.

    A rig of real devices is a RigError: nothing stands in for them.
    """
    if rig.rig == "real":
        raise RigError(f"rig '{rig.name}' names real devices; only `hil run` and `doctor` take it")
    ahead = rig.latency.rtde.to_cell.least > 0
    return ServedCell(*_opened(Builder(rig, seed), across_processes), ahead=ahead)


def serve_with_faults(
    rig: Rig, seed: int, across_processes: bool, faults: Numbered
) -> "InjectedCell":
    """As `serve`, for a cell that fails as `faults` say; FaultError for one it has no place for."""
    from hil.cell.injection.builder import FaultyBuilder  # noqa: PLC0415  a sound cell needs none
    from hil.cell.injection.cell import InjectedCell  # noqa: PLC0415

    builder = FaultyBuilder(rig, seed, faults)
    return InjectedCell(builder.injection, *_opened(builder, across_processes))


def _opened(
    builder: Builder, across_processes: bool
) -> tuple[Bench, UrServer, Gateway, str, TcpPort | None]:
    bench = builder.bench()
    gateway = builder.gateway(bench, across_processes)
    server = builder.server(bench)
    with ExitStack() as doors:
        doors.callback(gateway.close)
        server.open()
        doors.callback(server.close)
        port = builder.sensor_port(bench)
        doors.pop_all()
    return bench, server, gateway, builder.rig.robot.host, port
