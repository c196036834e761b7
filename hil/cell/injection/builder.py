"""Makes the devices of a cell that is to fail: sound ones' kin, each with faults at its place."""

from functools import partial

from drivers.protocol.frame import CanFrame
from drivers.protocol.nrs_can import Identifiers
from hil.cell.arm.controller import ArmController
from hil.cell.arm.server import UrServer
from hil.cell.bench import Bench, Parts
from hil.cell.builder import Builder, build_plant
from hil.cell.faults.injector import Injector
from hil.cell.faults.schedule import Numbered
from hil.cell.faults.situation import Situation
from hil.cell.injection.bench import InjectedBench
from hil.cell.injection.bus import InjectedGateway, InjectedWire
from hil.cell.injection.injection import Injection
from hil.cell.injection.jaws import InjectedJaws
from hil.cell.injection.places import check
from hil.cell.injection.plant import InjectedPlant, has_jaws
from hil.cell.injection.robot import InjectedArm
from hil.cell.injection.sensor import InjectedTransducer, NodeRestart
from hil.cell.injection.server import InjectedServer
from hil.cell.link import Link
from hil.cell.plant.interface import Plant
from hil.cell.rig import LatencyLaw, Rig
from hil.cell.sensor.gateway import Gateway
from hil.cell.sensor.node import SensorNode
from hil.cell.streams import stream


class FaultyBuilder(Builder):
    """Faults that exist at power-up are in force before anybody can knock at a door."""

    def __init__(self, rig: Rig, seed: int, faults: Numbered) -> None:
        check(faults, rig)
        super().__init__(rig, seed)
        injector = Injector(faults, seed, rig.robot.period)
        injector.look(Situation(0, 0))
        self.injection = Injection(injector)

    def joined(self, parts: Parts) -> Bench:
        return InjectedBench(self.injection, parts)

    def arm(self) -> ArmController:
        arm = InjectedArm(self.rig.robot, stream(self.seed, "arm"), self.injection)
        arm.box.jaws = InjectedJaws(self.rig.robot.jaws, self.injection)
        return arm

    def plant(self) -> Plant:
        plant = self._physics()
        return InjectedPlant(plant, self.injection) if has_jaws(plant) else plant

    def _physics(self) -> Plant:
        if self.rig.physics.plant != "mujoco":
            return build_plant(self.rig, self.seed)
        from hil.cell.injection.cable import InjectedFfcPlant  # noqa: PLC0415  loads MuJoCo

        return InjectedFfcPlant(self.rig, stream(self.seed, "plant"), self.injection)

    def node(self) -> SensorNode:
        build = partial(InjectedTransducer, injection=self.injection)
        node = SensorNode(self.rig.sensor, stream(self.seed, "sensor"), build)
        self.injection.add(NodeRestart(self.injection, node))
        return node

    def wire(self, law: LatencyLaw, way: str) -> Link[CanFrame]:
        if way != "from_cell":
            return super().wire(law, way)
        ids = Identifiers.of(self.rig.sensor.node)
        self._from_cell = InjectedWire(law, stream(self.seed, f"can.{way}"), self.injection, ids)
        return self._from_cell

    def gateway(self, bench: Bench, across_processes: bool) -> Gateway:
        return InjectedGateway(super().gateway(bench, across_processes), self._from_cell)

    def server(self, bench: Bench) -> UrServer:
        rig, rng = self.rig, stream(self.seed, "rtde")
        assert isinstance(bench.arm, InjectedArm)
        return InjectedServer(
            self.injection, bench.arm, rig.robot.ports, rig.robot.host, rig.latency.rtde, rng
        )
