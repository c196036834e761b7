"""The far side's one tick: arm, plant, sensor, in the order in which a sample travels.

The loop between contact and motion is cut at one place: the arm of this period knows the plant of
the last one, as in the real cell.
"""

from typing import NamedTuple

from drivers.protocol.frame import CanFrame
from hil.cell.arm.controller import ArmController
from hil.cell.geometry import Stage, TaskGeometry, Vector3, rotate
from hil.cell.link import Link
from hil.cell.plant.interface import Plant, PlantStep, StageTarget
from hil.cell.sensor.node import SensorNode

G = 9.81


class Tick(NamedTuple):
    """One period: its end in bench time, the CAN frames that left by then, and the truth."""

    t: int
    frames: list[CanFrame]
    truth: PlantStep


class CanLinks(NamedTuple):
    """The bus between host and node, one delay law a direction."""

    to_cell: Link[CanFrame]
    from_cell: Link[CanFrame]


class Bench:
    """Arm, plant and sensor node joined; whoever owns it decides when a period passes."""

    def __init__(
        self,
        *,
        arm: ArmController,
        plant: Plant,
        node: SensorNode,
        geometry: TaskGeometry,
        bus: CanLinks,
        tool_mass: float,
    ) -> None:
        self.arm, self._plant, self._node, self._geometry = arm, plant, node, geometry
        self._can_in, self._can_out = bus
        self._weight = tool_mass * G
        self.t = 0
        self.truth = plant.reset(StageTarget(*geometry.stage(arm.flange_target), False))

    def receive(self, frames: list[CanFrame]) -> None:
        """Put what the host wrote on the bus on its way to the node."""
        for frame in frames:
            self._can_in.push(self.t, frame)

    def tick(self) -> Tick:
        """One control period: 1. the arm decides, 2. physics moves, 3. the sensor speaks."""
        target = self.arm.frame(self.t)
        stage = self._geometry.stage(target.flange)
        self.truth = self._plant.step(StageTarget(*stage, target.jaws_closed), self.arm.period)
        self.t += self.arm.period
        for frame in self._can_in.due(self.t):
            self._node.receive(frame, self.t)
        self._can_out.extend(self._node.advance(self.t, self.truth.wrenches))
        flange = self._geometry.flange(self.truth.stage, target.flange, stage)
        held = self.truth.part.name is not None
        self.arm.observe(self.t, flange, self._twist(self.truth.velocity), self._force(), held)
        return Tick(self.t, self._can_out.due(self.t), self.truth)

    def _twist(self, velocity: Stage) -> tuple[float, float, float, float, float, float]:
        x, y, z = self._geometry.to_base(velocity[:3])
        return x, y, z, 0.0, 0.0, velocity[3]

    def _force(self) -> tuple[float, float, float, float, float, float]:
        """What the environment does to the tool at the flange, base frame: weight is payload."""
        fx, fy, fz, tx, ty, tz = self.truth.wrenches[-1].tolist()
        rotation = self.arm.flange_target.rotation
        force: Vector3 = rotate(rotation, (fx, fy, fz))
        torque: Vector3 = rotate(rotation, (tx, ty, tz))
        return force[0], force[1], force[2] + self._weight, *torque
