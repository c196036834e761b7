"""An emulated control box with an arm that follows exactly, served in a thread of the test."""

import threading
from contextlib import contextmanager
from functools import partial
from time import monotonic_ns

import numpy as np
import pytest

from drivers.ur.arm import UrArm, UrPorts
from drivers.ur.program import ServoProgram
from hil.cell.arm.controller import ArmController
from hil.cell.arm.server import UrServer
from hil.cell.rig.robot import Ports, Robot
from hil.cell.rig.task import Link

FREE = Ports(dashboard=0, primary=0, secondary=0, realtime=0, rtde=0)
# Its step lets a leap through to the controller, which has to refuse it.
TOOL = ServoProgram(tcp=(0.0, 0.0, 0.12, 0.0, 0.0, 0.0), mass=0.6, step=0.1)
ZERO = (0.0,) * 6


class EmulatedArm:
    """t: bench time, ns. sent: target joints of every period, to compare runs by."""

    def __init__(self, robot, host="127.0.0.1", ports=FREE):
        self.controller = ArmController(robot, np.random.default_rng(1))
        self.period = robot.period
        self.sent = []
        self.server = UrServer(self.controller, ports, host, Link(), np.random.default_rng(2))
        self.t = self._step = 0
        self._stopped = threading.Event()

    def lockstep(self):
        while not self._stopped.is_set():
            self.server.poll(self.t, 0.05)
            if self.server.take_commands():
                self.server.poll(self.t, 0.0)
                self.server.take_commands()
                self._tick()

    def wall(self):
        start = monotonic_ns()
        while not self._stopped.is_set():
            due = start + (self._step + 1) * self.period
            while (left := due - monotonic_ns()) > 0:
                self.server.poll(self.t, left * 1e-9)
            self._tick()

    def _tick(self):
        target = self.controller.frame(self.t)
        self.sent.append(target.q)
        self.t += self.period
        self._step += 1
        self.controller.observe(self.t, target.flange, ZERO, ZERO, False)
        self.server.publish(self.t, self._step)
        self.server.flush(self.t + self.period)

    @contextmanager
    def running(self, pace):
        with self.server:
            thread = threading.Thread(target=pace)
            thread.start()
            try:
                yield self
            finally:
                self._stopped.set()
                thread.join()

    def driver(self, limit=20.0):
        """Our driver, not yet connected."""
        ports = self.server.ports
        return UrArm(
            "127.0.0.1",
            UrPorts(ports["rtde"], ports["dashboard"], ports["secondary"]),
            program=TOOL,
            limit=limit,
        )


@pytest.fixture(params=["cb3", "e-series"])
def robot(request):
    if request.param == "cb3":
        return Robot(repeatability="0 m")
    return Robot(model="ur5e", series="e-series", version="5.11.0.108249", repeatability="0 m")


@pytest.fixture
def emulated_arm(robot):
    """Makes arms that are alike."""
    return partial(EmulatedArm, robot)


@pytest.fixture
def emulated(emulated_arm):
    arm = emulated_arm()
    with arm.running(arm.lockstep):
        yield arm
