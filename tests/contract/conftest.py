"""Every implementation of each interface, each with what its suite needs to drive it."""

from contextlib import closing, contextmanager
from importlib.util import module_from_spec, spec_from_file_location
from pathlib import Path

import numpy as np
import pytest

from drivers.nrs.can_sensor import CanSensor
from drivers.nrs.tcp_sensor import TcpSensor
from drivers.ur.gripper import DigitalGripper
from hil.app.near import near_side
from hil.app.real import doors
from hil.cell.arm.kinematics import Kinematics
from hil.cell.assemble import build_bench
from hil.cell.geometry import TaskGeometry
from hil.cell.rig import load, parse
from hil.cell.rig.task import Link
from hil.cell.sensor.gateway import open_gateway
from hil.cell.sensor.tcp_port import TcpPort
from hil_fixtures.testbed import open_testbed

SERIES = {
    "cb3": "model: ur5, series: cb3, version: 3.15.8.106339",
    "e-series": "model: ur5e, series: e-series, version: 5.11.0.108249",
}


ON_TCP = "sensor: {boot_time: 8 ms, wire: tcp, tcp: {port: 0}}"


def pytest_addoption(parser):
    group = parser.getgroup("hil contract")
    group.addoption("--moves", action="store_true", help="the arm of --rig may move")


def rig_of(series, more=""):
    """A cell of little physics; its sensor boots at once, so that tests are short."""
    text = (
        f"name: contract\nrobot: {{{SERIES[series]}}}\nphysics: {{plant: wall}}\n"
        f"can: {{interface: virtual}}\nsensor: {{boot_time: 8 ms}}\n{more}"
    )
    return parse(text).on_free_ports()


def with_part_at_home(series):
    """The same cell; a part waits where the jaws are at power-up."""
    rig = rig_of(series)
    flange = Kinematics(rig.robot.model).forward(rig.robot.home)
    x, y, z, theta = TaskGeometry((0.0, 0.0, 0.0), 0.0, rig.tool.length).stage(flange)
    part = f"{{name: A, position: [{x!r} m, {y!r} m, {z!r} m], rotation: {theta!r} rad}}"
    return rig_of(series, f"fixture: {{parts: [{part}]}}")


@pytest.fixture(scope="session")
def rigs():
    """Makes the rig of a series."""
    return rig_of


@pytest.fixture(scope="session")
def fakes():
    """The in-memory world of the controller's tests."""
    path = Path(__file__).parents[1] / "controller" / "conftest.py"
    spec = spec_from_file_location("controller_fakes", path)
    module = module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


# Arms


class ArmUnderTest:
    """arm: not yet connected. exchange: a command's package; the arm answers one with one."""

    def __init__(self, arm):
        self.arm = arm

    def states(self, periods, command):
        """The states that `command`, given before each read, leads to."""
        found = []
        for _ in range(periods):
            command()
            found.append(self.arm.read())
        return found

    def connect(self):
        """Connected, with no command in flight."""
        self.arm.connect()
        return self.arm.read()


@pytest.fixture(params=["fake", "cb3", "e-series", pytest.param("real", marks=pytest.mark.real_ok)])
def subject(request, fakes):
    if request.param == "real":
        rig = named_rig(request.config)
        with near_side(rig, doors(rig)) as near:
            yield ArmUnderTest(near.arm)
        return
    if request.param == "fake":
        arm = fakes.FakeArm(fakes.SpringWorld())
        yield ArmUnderTest(arm)
        arm.close()
        return
    with open_testbed(rig_of(request.param)) as bed:
        yield ArmUnderTest(bed.near.arm)


# Sensors


class FakeSensorCell:
    """The fake sensor on its fake arm; load: N and N·m, sensor frame."""

    keeps_its_zero = False
    noise = (0.0, 0.0)

    def __init__(self, fakes, load):
        world = fakes.SpringWorld(at=(0.0, 0.0, 0.1, 0.0))
        world.extra = load
        self._arm = fakes.FakeArm(world)
        self.sensor = fakes.FakeSensor(self._arm, boot=80_000_000)

    @property
    def t(self):
        return self._arm.t

    def step(self):
        self._arm.hold()

    def silence(self):
        """A period whose samples are lost."""
        self.step()
        self._arm.wrenches.clear()


class BusSensorCell:
    """The CAN driver against a bench in this process, over a real python-can bus."""

    keeps_its_zero = False
    noise = (0.05, 0.0008)

    def __init__(self, gateway, fd):
        kind = "fd" if fd else "classic"
        self._bench = build_bench(rig_of("cb3", f"sensor: {{frames: {kind}, boot_time: 8 ms}}"), 1)
        self._gateway = gateway
        self.sensor = CanSensor(*gateway.address, fd=fd)

    @property
    def t(self):
        return self._bench.t

    def step(self):
        self._gateway.send(self._period())

    def silence(self):
        """A period whose frames are lost."""
        self._period()

    def _period(self):
        self._bench.put_on_bus(self._gateway.receive())
        self._bench.tick()
        return [frame for _, frame in self._bench.take_from_bus(self._bench.t)]


class StreamSensorCell:
    """The TCP driver against a bench in this process, over a real TCP connection."""

    keeps_its_zero = False
    noise = (0.05, 0.0008)

    def __init__(self, rig):
        self._bench = build_bench(rig, 1)
        self._port = TcpPort(
            self._bench.node,
            rig.sensor,
            host=rig.robot.host,
            laws=Link(),
            rng=np.random.default_rng(1),
            say=self._refuse,
        )
        self.sensor = TcpSensor(*self._port.address)

    @property
    def t(self):
        return self._bench.t

    def step(self):
        self.silence()
        self._port.flush(self.t)

    def silence(self):
        """A period in which the network stalls: a stream loses nothing, it comes later."""
        self._port.take(self.t, self.t + self._bench.period)
        self._bench.tick()
        self._port.publish(self.t)

    def close(self):
        self._port.close()

    @staticmethod
    def _refuse(reason):
        pytest.fail(reason)


class RealSensorCell:
    """The sensor of a rig's devices, paced by its arm, which stands still: a step is a package."""

    keeps_its_zero = True

    def __init__(self, rig, near):
        self.noise = (rig.sensor.errors.noise_force, rig.sensor.errors.noise_torque)
        self.sensor, self._arm = near.sensor, near.arm
        self._arm.connect()
        self.t = self._arm.read().t

    def step(self):
        self._arm.hold()
        self.t = self._arm.read().t

    def silence(self):
        pytest.skip("nobody silences a real wire")


def named_rig(config):
    """The rig that `--rig FILE` names; skips unless its arm may move."""
    file = config.getoption("--rig")
    if file is None:
        pytest.skip("needs --rig FILE: a rig whose devices are up")
    if not config.getoption("--moves"):
        pytest.skip("powers the arm, moves it 10 mm along x, sets outputs 3 and 5: add --moves")
    return load(Path(file))


@contextmanager
def sensor_cell(kind, fakes):
    if kind == "tcp":
        with closing(StreamSensorCell(rig_of("cb3", ON_TCP))) as cell:
            yield cell
        return
    if kind == "fake":
        yield FakeSensorCell(fakes, (0.2, -0.1, 5.9, 0.0, 0.01, 0.0))
        return
    interface, _, frames = kind.partition(" ")
    section = parse(f"name: x\ncan: {{interface: {interface}}}").can
    gateway = open_gateway(section, across_processes=interface != "virtual", fd=frames == "fd")
    try:
        yield BusSensorCell(gateway, frames == "fd")
    finally:
        gateway.close()


@pytest.fixture(
    params=[
        "fake",
        pytest.param("real", marks=pytest.mark.real_ok),
        "virtual classic",
        "virtual fd",
        "udp_multicast classic",
        "udp_multicast fd",
        pytest.param("socketcan classic", marks=pytest.mark.socketcan),
        pytest.param("socketcan fd", marks=pytest.mark.socketcan),
        "tcp",
    ]
)
def cell(request, fakes):
    if request.param == "real":
        rig = named_rig(request.config)
        with near_side(rig, doors(rig)) as near:
            yield RealSensorCell(rig, near)
        return
    with sensor_cell(request.param, fakes) as cell:
        yield cell
        cell.sensor.close()


# Grippers


class GripperUnderTest:
    """subject: a connected arm. gripper: its open jaws, around a waiting part or nothing."""

    def __init__(self, arm, gripper):
        self.subject = ArmUnderTest(arm)
        self.gripper = gripper
        self.subject.connect()

    def holds(self, seconds=0.5):
        """Whether the jaws hold something in each period of a stretch of standing still."""
        periods = round(seconds * 1e9 / self.subject.arm.period)
        states = self.subject.states(periods, self.subject.arm.hold)
        return [self.gripper.holds(state) for state in states]


@pytest.fixture(params=["fake", "cb3", "e-series"])
def grippers(request, fakes):
    """Makes a gripper around a part or around nothing."""

    @contextmanager
    def make(part):
        if request.param == "fake":
            at = (0.0, 0.0, 0.02, 0.0)
            arm = fakes.FakeArm(fakes.SpringWorld(part=at if part else None, at=at))
            yield GripperUnderTest(arm, fakes.FakeGripper(arm))
            return
        rig = with_part_at_home(request.param) if part else rig_of(request.param)
        with open_testbed(rig) as bed:
            arm = bed.near.arm
            yield GripperUnderTest(arm, DigitalGripper(arm, 0, 0))

    return make
