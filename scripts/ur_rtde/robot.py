"""A client's view of one controller: ur_rtde's interfaces, opened when a check first uses them."""

import time
from collections.abc import Sequence
from functools import cached_property

from dashboard_client import DashboardClient
from expect import becomes, equal, true_soon, worst
from rtde_control import RTDEControlInterface
from rtde_io import RTDEIOInterface
from rtde_receive import RTDEReceiveInterface

CONTACT = 0.070
"""Height of a flange pointing down whose tool touches the plate of the plate rigs, m."""
STIFFNESS = 10e3
"""Of that plate, N/m."""
DOWN = (3.141592653589793, 0.0, 0.0)
HOVER = (-0.40, -0.11, CONTACT + 0.004, *DOWN)
STILL = 1e-3
"""Joint speed below which the arm counts as standing, rad/s."""
RUNNING = 7
UNLOCK_AFTER = 5.2
"""A protective stop can be unlocked 5 s after it began."""


class Robot:
    """Interfaces to the controller at `host`; `home` are joint angles, rad."""

    def __init__(self, host: str, version: tuple[int, int], home: Sequence[float]) -> None:
        self.host, self.version, self.home = host, version, list(home)

    @property
    def step(self) -> float:
        """Control period of the series, s."""
        return 0.008 if self.version[0] == 3 else 0.002

    @cached_property
    def dashboard(self) -> DashboardClient:
        client = DashboardClient(self.host)
        client.connect()
        return client

    @cached_property
    def receive(self) -> RTDEReceiveInterface:
        return RTDEReceiveInterface(self.host)

    @cached_property
    def io(self) -> RTDEIOInterface:
        return RTDEIOInterface(self.host)

    @cached_property
    def control(self) -> RTDEControlInterface:
        self.power_up()
        return RTDEControlInterface(self.host)

    def power_up(self) -> None:
        """Out of a protective stop, powered, brakes off."""
        if self.receive.isProtectiveStopped():
            self.unlock()
        if self.receive.getRobotMode() != RUNNING:
            self.dashboard.powerOn()
            self.dashboard.brakeRelease()
            true_soon(lambda: self.receive.getRobotMode() == RUNNING, "robot mode RUNNING")

    def unlock(self) -> None:
        time.sleep(UNLOCK_AFTER)
        self.dashboard.closeSafetyPopup()
        self.dashboard.unlockProtectiveStop()
        true_soon(lambda: not self.receive.isProtectiveStopped(), "protective stop released")

    def ready(self) -> None:
        """The control script runs, the arm stands at home with its flange as TCP."""
        control = self.control
        self.power_up()
        if not control.isConnected():
            control.reconnect()
        if not control.isProgramRunning():
            self.restart_script()
        if worst(self.receive.getActualQ(), self.home) > 0.5e-3:
            equal(control.moveJ(self.home, 1.5, 4.0), True)
            becomes(self.receive.getActualQ, self.home, 1e-3)

    def restart_script(self) -> None:
        """Upload again; the call before it, refused, clears the client's last command."""
        if not self.control.isProgramRunning():
            self.control.isSteady()
        self.control.reuploadScript()
        true_soon(self.control.isProgramRunning, "control script running")

    def hover(self) -> None:
        """4 mm above the plate, tool down, at rest."""
        equal(self.control.moveL(list(HOVER), 0.5, 2.0), True)
        becomes(self.receive.getActualTCPPose, HOVER, 0.3e-3)
        self.stands()

    def stands(self) -> None:
        true_soon(lambda: worst(self.receive.getActualQd(), [0.0] * 6) < STILL, "arm at rest")

    def push(self) -> float:
        """Force of the plate on the tool, N; positive when they touch."""
        return float(self.receive.getActualTCPForce()[2])

    def height(self) -> float:
        return float(self.receive.getActualTCPPose()[2])

    def turned(self, joint: int, angle: float) -> list[float]:
        """Home with one joint turned on."""
        q = list(self.home)
        q[joint] += angle
        return q

    def shifted(self, x: float = 0.0, y: float = 0.0, z: float = 0.0) -> list[float]:
        """The present pose, displaced in the base frame."""
        pose = list(self.receive.getTargetTCPPose())
        return [pose[0] + x, pose[1] + y, pose[2] + z, *pose[3:]]

    def close(self) -> None:
        """Leave the controller idle for the next client."""
        held = vars(self)
        if "control" in held:
            self.control.stopScript()
        for name in ("control", "io", "receive", "dashboard"):
            if name in held:
                held[name].disconnect()
