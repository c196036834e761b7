"""The far side's composition root: the only place in the cell that names implementations."""

from contextlib import ExitStack
from functools import partial

from hil.cell.arm.controller import ArmController
from hil.cell.arm.door_log import Event
from hil.cell.arm.server import UrServer
from hil.cell.bench import Bench, CanLinks
from hil.cell.errors import RigError
from hil.cell.geometry import TaskGeometry
from hil.cell.link import Link
from hil.cell.plant.interface import Plant
from hil.cell.rig import Rig, drawn
from hil.cell.sensor.gateway import open_gateway
from hil.cell.sensor.node import SensorNode
from hil.cell.sensor.tcp_port import TcpPort
from hil.cell.serve import ServedCell
from hil.cell.streams import stream


def build_plant(rig: Rig, seed: int) -> Plant:
    """The rig's plant; each physics is imported only where it is asked for."""
    rng = stream(seed, "plant")
    if rig.physics.plant == "wall":
        from hil.cell.plant.wall import WallPlant  # noqa: PLC0415

        return WallPlant(rig, rng)
    if rig.physics.plant == "analytic":
        from hil.cell.plant.analytic import AnalyticPlant  # noqa: PLC0415

        return AnalyticPlant(rig, rng)
    if rig.physics.plant == "surface":
        from hil.cell.plant.surface import SurfacePlant  # noqa: PLC0415

        return SurfacePlant(rig)
    if rig.physics.plant == "surface_mujoco":
        from hil.cell.plant.surface_mujoco import MujocoSurfacePlant  # noqa: PLC0415

        return MujocoSurfacePlant(rig)
    from hil.cell.plant.ffc import FfcPlant  # noqa: PLC0415

    return FfcPlant(rig, rng)


def build_bench(rig: Rig, seed: int) -> Bench:
    """Arm, plant and sensor of a rig, everything random from `seed`; no socket, no bus."""
    rig = drawn(rig, stream(seed, "randomisation"))
    connector, can = rig.connector.as_placed(), rig.latency.can
    rig = rig.model_copy(update={"connector": connector})
    return Bench(
        arm=ArmController(rig.robot, stream(seed, "arm")),
        plant=build_plant(rig, seed),
        node=SensorNode(rig.sensor, stream(seed, "sensor")),
        geometry=TaskGeometry(connector.position, connector.rotation, rig.tool.length),
        bus=CanLinks(
            Link(can.to_cell, stream(seed, "can.to_cell")),
            Link(can.from_cell, stream(seed, "can.from_cell")),
        ),
        tool=rig.tool,
        period=rig.robot.period,
    )


def serve(rig: Rig, seed: int, across_processes: bool) -> ServedCell:
    """The cell with its doors open; raises DoorError, and leaves none open when one fails.

    A rig of real devices is a RigError: nothing stands in for them.
    """
    if rig.rig == "real":
        raise RigError(f"rig '{rig.name}' names real devices; only `hil run` and `doctor` take it")
    bench = build_bench(rig, seed)
    refused = partial(bench.arm.box.doors.note, Event.REFUSED)
    gateway = open_gateway(rig.can, across_processes, rig.sensor.frames == "fd", refused)
    robot = rig.robot
    server = UrServer(bench.arm, robot.ports, robot.host, rig.latency.rtde, stream(seed, "rtde"))
    with ExitStack() as doors:
        doors.callback(gateway.close)
        server.open()
        doors.callback(server.close)
        port = _sensor_port(rig, bench, seed)
        doors.pop_all()
    ahead = rig.latency.rtde.to_cell.least > 0
    return ServedCell(bench, server, gateway, robot.host, port, ahead=ahead)


def _sensor_port(rig: Rig, bench: Bench, seed: int) -> TcpPort | None:
    """The sensor's TCP front where the rig has one; raises DoorError."""
    if not rig.sensor.serves_tcp:
        return None
    return TcpPort(
        bench.node,
        rig.sensor,
        host=rig.robot.host,
        laws=rig.latency.sensor_tcp,
        rng=stream(seed, "sensor_tcp"),
        say=partial(bench.arm.box.doors.note, Event.TURNED_AWAY),
    )
