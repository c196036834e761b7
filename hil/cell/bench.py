"""One control period of the cell: the way of a wrench sample from contact to the wire.

`begin`: the arm decides on the inputs that RTDE brought; physics moves, and true wrenches at 1 kHz
come into being. `finish`: the sensor node turns them into CAN frames, which start to travel; the
arm feels where it is. Then `serve` sends the frames that have arrived (`take_from_bus`) and after
them the arm's RTDE package; the host's answer, over RTDE, releases the next period.

An answer that travels takes effect a period later, so `begin` need not wait for it: physics runs
while the host thinks. Until `finish` nothing of it can be seen.

The loop between contact and motion is cut at one place: the arm of this period knows the plant of
the last one, as in the real cell.
"""

from math import remainder, tau
from typing import NamedTuple, TypedDict

from drivers.protocol.frame import CanFrame
from hil.cell.arm.controller import ArmController
from hil.cell.arm.pose import Pose, Rotation, Vector6, turn
from hil.cell.geometry import Stage, TaskGeometry
from hil.cell.link import Link
from hil.cell.plant.interface import Plant, PlantStep, StageTarget
from hil.cell.rig.parts import Tool
from hil.cell.sensor.node import SensorNode

G = 9.81
NS = 1_000_000_000


class CanLinks(NamedTuple):
    """The bus between host and node, one delay law a direction."""

    to_cell: Link[CanFrame]
    from_cell: Link[CanFrame]


class _Begun(NamedTuple):
    """A period whose end nobody has seen: where flange and stage should go, where they went."""

    wanted: Pose
    stage: Stage
    moved: PlantStep


class Parts(TypedDict):
    """What a bench joins. period: of control, ns."""

    arm: ArmController
    plant: Plant
    node: SensorNode
    geometry: TaskGeometry
    tool: Tool
    bus: CanLinks
    period: int


class Bench:
    """Arm, plant and sensor node joined; whoever owns it decides when a period passes.

    t: bench time, ns. truth: the plant at t, for recordings and tests, never for the wire.
    """

    def __init__(
        self,
        *,
        arm: ArmController,
        plant: Plant,
        node: SensorNode,
        geometry: TaskGeometry,
        tool: Tool,
        bus: CanLinks,
        period: int,
    ) -> None:
        self.arm, self.plant, self.node, self._geometry = arm, plant, node, geometry
        self._weight, self._length = tool.mass * G, tool.length
        self._can_in, self._can_out = bus
        self.period = period
        self.t = 0
        self._begun: _Begun | None = None
        stage = geometry.stage(arm.flange)
        self.truth = plant.reset(StageTarget(*stage, jaws_closed=False))

    def tick(self) -> PlantStep:
        """One whole control period: the arm decides, physics moves, the sensor speaks."""
        self.begin()
        return self.finish()

    def begin(self) -> None:
        """The arm decides on the inputs that have arrived, physics moves, unless they have."""
        if self._begun is None:
            target = self.arm.frame(self.t)
            stage = self._stage(target.flange)
            moved = self.plant.step(StageTarget(*stage, target.jaws_closed), self.period)
            self._begun = _Begun(target.flange, stage, moved)

    def finish(self) -> PlantStep:
        """The period that was begun passes: the sensor speaks, the arm feels where it is."""
        assert self._begun is not None, "begin comes first"
        (wanted, stage, self.truth), before = self._begun, self.truth.stage
        self._begun = None
        self.t += self.period
        for arrival, frame in self._can_in.due(self.t):
            self.node.receive(frame, arrival)
        self._can_out.extend(self.node.advance(self.t, self.truth.wrenches))
        flange = self._geometry.flange(self.truth.stage, wanted, stage)
        self._feel(flange, before)
        return self.truth

    def _stage(self, flange: Pose) -> Stage:
        """The flange's place in the task frame, theta on the turn where the stage is now.

        A tool at half a turn from the connector would else go all the way round for a rounding
        error: (0, pi, 0), UR's own favourite way of pointing down, is such a pose.
        """
        x, y, z, theta = self._geometry.stage(flange)
        return x, y, z, theta + tau * round((self.truth.stage[3] - theta) / tau)

    def put_on_bus(self, frames: list[CanFrame]) -> None:
        """Take what the host wrote on the bus; it is on its way to the node from now on."""
        for frame in frames:
            self._can_in.push(self.t, frame)

    def take_from_bus(self, t: int) -> list[tuple[int, CanFrame]]:
        """The node's frames that have reached the host by t, ns, with their arrival."""
        return self._can_out.due(t)

    def _feel(self, flange: Pose, before: Stage) -> None:
        """Show the arm where it is, how fast, what pushes it, and whether the jaws hold a part.

        before: the stage a period ago. Speed is the mean over the period, as from encoders: the
        plant's own at the period's end is a tenth low at 125 Hz, where every set-point is a step.
        """
        truth = self.truth
        held = truth.part.name is not None
        force = self._force(truth.wrenches[-1].tolist(), flange.rotation)
        self.arm.observe(self.t, flange, self._twist(before, truth.stage), force, held)

    def _twist(self, before: Stage, now: Stage) -> Vector6:
        rate = NS / self.period
        x, y, z = self._geometry.to_base(
            ((now[0] - before[0]) * rate, (now[1] - before[1]) * rate, (now[2] - before[2]) * rate)
        )
        return x, y, z, 0.0, 0.0, remainder(now[3] - before[3], tau) * rate

    def _force(self, wrench: list[float], rotation: Rotation) -> Vector6:
        """What the environment does at the TCP, base frame: the tool's weight is known payload."""
        fx, fy, fz, tx, ty, tz = wrench
        x, y, z = turn(rotation, (fx, fy, fz))
        lever = (tx + self._length * fy, ty - self._length * fx, tz)
        return x, y, z + self._weight, *turn(rotation, lever)
