"""A bench with faults and without sockets, driven by hand."""

import numpy as np
import pytest

from drivers.protocol.nrs_can import Identifiers
from drivers.protocol.nrs_command import Command, Opcode, encode_command
from drivers.protocol.nrs_sample import decode_pair
from hil.cell.arm.kinematics import Kinematics
from hil.cell.arm.modes import Event
from hil.cell.faults.parse import schedule
from hil.cell.geometry import TaskGeometry
from hil.cell.injection.builder import FaultyBuilder
from hil.cell.rig import parse

RIG = """
name: faults
physics: {{plant: {plant}}}
sensor: {{boot_time: 20 ms, preset: nrs-6050-d80-quiet, frames: {frames}}}
robot: {{repeatability: 0 mm, jaws: {{close_delay: 8 ms, open_delay: 8 ms, sense_delay: 0 s}}}}
fixture:
  play: 0 mm
  parts: [{{name: FFC1, position: [{x!r} m, {y!r} m, {z!r} m], rotation: {theta!r} rad}}]
"""
IDS = Identifiers.of(1)
TRANSMIT = encode_command(IDS, Command(Opcode.TRANSMIT, 1, (1,)))
START = 10
"""Periods until the node transmits: faults come later."""


def _pairs(found):
    """Payloads of FORCE and TORQUE frames of one counter each."""
    paired, waiting = [], {}
    for _, frame in found:
        if frame.id == IDS.force:
            waiting[frame.data[7]] = frame.data
        elif frame.id == IDS.torque and frame.data[7] in waiting:
            paired.append((waiting.pop(frame.data[7]), frame.data))
    return paired


class FaultyBench:
    """frames: (arrival, frame) of the last period."""

    def __init__(self, rig, faults, seed=1):
        builder = FaultyBuilder(rig, seed, schedule(faults).numbered(seed))
        self.bench, self.injection = builder.bench(), builder.injection
        self.wire = builder._from_cell
        self.frames = []

    @property
    def box(self):
        return self.bench.arm.box

    def run(self, periods):
        found = []
        for _ in range(periods):
            self.bench.tick()
            self.frames = self.bench.take_from_bus(self.bench.t)
            found += self.frames
        return found

    def begin(self):
        """Transmitting, brakes open, up to the period in which faults begin."""
        self.run(5)
        self.bench.put_on_bus([TRANSMIT])
        self.box.post(Event.POWER_ON)
        self.box.post(Event.BRAKE_RELEASE)
        self.run(START - 5)
        return self

    def output(self, bits):
        self.bench.arm.accept(
            {"standard_digital_output_mask": 1, "standard_digital_output": bits}, self.bench.t
        )

    def stages(self, kind):
        return [e.stage.value for e in self.injection.events(self.bench.t) if e.kind == kind]


def rig(plant="wall", frames="classic"):
    base = parse(RIG.format(plant=plant, frames=frames, x=0.0, y=0.0, z=0.0, theta=0.0))
    connector = base.connector
    geometry = TaskGeometry(connector.position, connector.rotation, base.tool.length)
    flange = Kinematics(base.robot.model).forward(base.robot.home)
    x, y, z, theta = geometry.stage(flange)
    cx, cy, cz = connector.position
    text = RIG.format(plant=plant, frames=frames, x=cx + x, y=cy + y, z=cz + z, theta=theta)
    return parse(text)


@pytest.fixture(scope="session")
def pairs():
    """Payloads of FORCE and TORQUE frames of one counter each, out of (arrival, frame) pairs."""
    return _pairs


@pytest.fixture(scope="session")
def wrenches():
    """Wrenches out of (arrival, frame) pairs, (n, 6)."""
    return lambda found: np.array([decode_pair(*pair).wrench for pair in _pairs(found)])


@pytest.fixture(scope="session")
def read():
    """Samples out of (arrival, frame) pairs."""
    return lambda found: [decode_pair(*pair) for pair in _pairs(found)]


@pytest.fixture
def faulty():
    """Makes a bench with one fault that begins when the node transmits."""

    def make(kind, plant="wall", frames="classic", at=START, **content):
        params = content.pop("params", {})
        trigger = {} if at is None else {"cycle": at}
        fault = {"kind": kind, "trigger": trigger, "params": params, **content}
        return FaultyBench(rig(plant, frames), [fault]).begin()

    return make


@pytest.fixture
def sound():
    """The same bench with a fault that never begins."""
    return lambda plant="wall", frames="classic": FaultyBench(
        rig(plant, frames), [{"kind": "C1", "trigger": {"at": "1000 s"}}]
    ).begin()
