"""Makes the devices of a rig's cell: where implementations are named."""

from functools import partial

from drivers.protocol.frame import CanFrame
from hil.cell.arm.controller import ArmController
from hil.cell.arm.door_log import Event
from hil.cell.arm.server import UrServer
from hil.cell.bench import Bench, CanLinks, Parts
from hil.cell.geometry import TaskGeometry
from hil.cell.link import Link
from hil.cell.plant.interface import Plant
from hil.cell.rig import LatencyLaw, Rig, drawn
from hil.cell.sensor.gateway import Gateway, open_gateway
from hil.cell.sensor.node import SensorNode
from hil.cell.sensor.tcp_port import TcpPort
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


class Builder:
    """Makes each device of one rig's cell, everything random from `seed`."""

    def __init__(self, rig: Rig, seed: int) -> None:
        rig = drawn(rig, stream(seed, "randomisation"))
        connector = rig.connector.as_placed()
        self.rig, self.seed = rig.model_copy(update={"connector": connector}), seed

    def bench(self) -> Bench:
        """Arm, plant and sensor joined; no socket, no bus."""
        rig, can = self.rig, self.rig.latency.can
        connector = rig.connector
        return self.joined(
            Parts(
                arm=self.arm(),
                plant=self.plant(),
                node=self.node(),
                geometry=TaskGeometry(connector.position, connector.rotation, rig.tool.length),
                tool=rig.tool,
                bus=CanLinks(
                    self.wire(can.to_cell, "to_cell"), self.wire(can.from_cell, "from_cell")
                ),
                period=rig.robot.period,
            )
        )

    def joined(self, parts: Parts) -> Bench:
        return Bench(**parts)

    def arm(self) -> ArmController:
        return ArmController(self.rig.robot, stream(self.seed, "arm"))

    def plant(self) -> Plant:
        return build_plant(self.rig, self.seed)

    def node(self) -> SensorNode:
        return SensorNode(self.rig.sensor, stream(self.seed, "sensor"))

    def wire(self, law: LatencyLaw, way: str) -> Link[CanFrame]:
        return Link(law, stream(self.seed, f"can.{way}"))

    def gateway(self, bench: Bench, across_processes: bool) -> Gateway:
        """The open bus; raises DoorError."""
        refused = partial(bench.arm.box.doors.note, Event.REFUSED)
        return open_gateway(self.rig.can, across_processes, self.rig.sensor.frames == "fd", refused)

    def server(self, bench: Bench) -> UrServer:
        """The robot's ports, not open yet."""
        rig, robot = self.rig, self.rig.robot
        rng = stream(self.seed, "rtde")
        return UrServer(bench.arm, robot.ports, robot.host, rig.latency.rtde, rng)

    def sensor_port(self, bench: Bench) -> TcpPort | None:
        """The sensor's TCP front where the rig has one; raises DoorError."""
        rig = self.rig
        if not rig.sensor.serves_tcp:
            return None
        return TcpPort(
            bench.node,
            rig.sensor,
            host=rig.robot.host,
            laws=rig.latency.sensor_tcp,
            rng=stream(self.seed, "sensor_tcp"),
            say=partial(bench.arm.box.doors.note, Event.TURNED_AWAY),
        )
