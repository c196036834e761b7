"""A bench without sockets, driven by hand: inputs in, frames and RTDE values out."""

import pytest

from drivers.protocol.nrs_can import Identifiers
from drivers.protocol.nrs_command import Command, Opcode, encode_command
from hil.cell.arm.kinematics import Kinematics
from hil.cell.arm.variables import readers
from hil.cell.assemble import build_bench
from hil.cell.geometry import TaskGeometry
from hil.cell.rig import parse

RIG = """
name: bench
physics: {{plant: {plant}}}
sensor: {{boot_time: 20 ms}}
robot: {{repeatability: {repeatability}}}
fixture:
  play: {play}
  parts: [{{name: FFC1, position: [{x!r} m, {y!r} m, {z!r} m], rotation: {theta!r} rad}}]
latency: {{can: {{to_cell: {{mean: 1 ms}}, from_cell: {from_cell}}}}}
"""
TRANSMIT = encode_command(Identifiers.of(1), Command(Opcode.TRANSMIT, 1, (1,)))


class HandBench:
    """frames: (arrival, frame) so far. values: every RTDE output variable, one dict a period."""

    def __init__(self, rig, seed):
        self.bench = build_bench(rig, seed)
        self.readers = readers(self.bench.arm.box)
        self.frames = []
        self.values = []

    def output(self, bits):
        self.bench.arm.accept(
            {"standard_digital_output_mask": 1, "standard_digital_output": bits}, self.bench.t
        )

    def run(self, periods):
        for _ in range(periods):
            self.bench.tick()
            self.frames += self.bench.take_from_bus(self.bench.t)
            self.values.append({name: read() for name, read in self.readers.items()})
        return self

    def streaming(self, periods=10):
        """Past the sensor's boot, with the node told to transmit."""
        self.run(5)
        self.bench.put_on_bus([TRANSMIT])
        return self.run(periods)

    def gripped(self):
        """Streaming, with the jaws closed on the part that waits where the tool is."""
        self.streaming()
        self.output(1)
        return self.run(30)


def rig(plant="wall", play="0.8 mm", repeatability="0.03 mm", from_cell="{mean: 1 ms}"):
    """A cell whose arm powers up with its jaws around the waiting part."""
    bare = parse("name: bare")
    flange = Kinematics(bare.robot.model).forward(bare.robot.home)
    x, y, z, theta = TaskGeometry((0.0, 0.0, 0.0), 0.0, bare.tool.length).stage(flange)
    text = RIG.format(
        plant=plant, play=play, repeatability=repeatability, from_cell=from_cell,
        x=x, y=y, z=z, theta=theta,
    )  # fmt: skip
    return parse(text)


@pytest.fixture(scope="session")
def make_bench():
    return lambda seed=1, **choices: HandBench(rig(**choices), seed)
