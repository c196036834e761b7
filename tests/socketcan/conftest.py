"""An emulated node, a CAN bus and our driver, period by period; and the tools around them."""

import os
import shutil
import sys
from contextlib import contextmanager
from pathlib import Path

import numpy as np
import pytest

import drivers.protocol
from drivers.nrs.can_sensor import CanSensor
from drivers.protocol.frame import CanFrame
from hil.cell.rig.sensor import CanBus, Sensor
from hil.cell.sensor.gateway import open_gateway
from hil.cell.sensor.node import SensorNode

PERIOD = 8_000_000
LOAD = np.array([1.5, -3.0, -9.81, 0.05, -0.1, 0.02])
DBC = Path(drivers.protocol.__file__).with_name("nrs.dbc")
CANTOOLS = (sys.executable, "-m", "cantools")


class CanCell:
    """gateway: the node's end of the bus. driver: connected. sent: every frame of the node."""

    def __init__(self, gateway, driver):
        self.node = SensorNode(Sensor(), np.random.default_rng(7))
        self.gateway = gateway
        self.driver = driver
        self.t = 0
        self.load = LOAD
        self.sent = []

    def period(self):
        """The frames of one more period, not yet sent."""
        self.t += PERIOD
        for frame in self.gateway.receive():
            self.node.receive(frame, self.t)
        return [frame for _, frame in self.node.advance(self.t, np.tile(self.load, (8, 1)))]

    def step(self):
        frames = self.period()
        self.gateway.send(frames)
        self.sent += frames

    def until(self, reached, periods=300):
        for _ in range(periods):
            self.step()
            self.driver.poll(self.t)
            if reached():
                return
        pytest.fail(f"nothing after {periods} periods: {self.driver.health}")

    def stream(self):
        """Start the driver; its first samples are taken."""
        self.driver.start()
        self.until(lambda: self.driver.ready)
        self.driver.read(self.t)

    def read(self):
        self.step()
        return self.driver.read(self.t)


@contextmanager
def can_cell_on(interface, channel=""):
    bus = CanBus(interface=interface, channel=channel)
    gateway = open_gateway(bus, across_processes=interface != "virtual")
    driver = CanSensor(*gateway.address)
    try:
        driver.connect()
        yield CanCell(gateway, driver)
    finally:
        driver.close()
        gateway.close()


@pytest.fixture
def can_cell():
    """Opens a cell on a bus."""
    return can_cell_on


@pytest.fixture
def cell_of():
    """Joins a driver with the node's end of some other bus."""
    return CanCell


@pytest.fixture
def vcan():
    """A cell on the kernel's vcan0."""
    with can_cell_on("socketcan", "vcan0") as cell:
        yield cell


@pytest.fixture
def dbc():
    return DBC


@pytest.fixture
def cantools():
    """The command line of cantools, which nobody here wrote."""
    return CANTOOLS


@pytest.fixture
def tool():
    """The path of a command of can-utils or tshark; skips where it is not installed."""

    def tool(name):
        path = shutil.which(name, path=os.environ["PATH"] + ":/usr/sbin:/sbin")
        if path is None:
            pytest.skip(f"{name} is not installed: run scripts/install-can-tools as root")
        return path

    return tool


@pytest.fixture
def frame_of():
    """Our frame from python-can's message."""
    return lambda message: CanFrame(message.arbitration_id, bytes(message.data), message.is_fd)
