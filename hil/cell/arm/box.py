"""The control box: the state that the control loop, the program and the clients' sessions share."""

import re
from collections import deque
from typing import Final

from drivers.protocol.primary_messages import ErrorCode, Level, Message
from hil.cell.arm.door_log import DoorLog
from hil.cell.arm.force.contact import THRESHOLDS, ContactHistory
from hil.cell.arm.force.estimate import ForceEstimate
from hil.cell.arm.force.mode import ForceMode
from hil.cell.arm.inputs import InputImage
from hil.cell.arm.jaws import Jaws
from hil.cell.arm.kinematics import Kinematics
from hil.cell.arm.measurement import Measurement, Target, Tool
from hil.cell.arm.modes import Event, Modes
from hil.cell.arm.ownership import Ownership
from hil.cell.arm.pendant import Pendant
from hil.cell.arm.registers import Registers
from hil.cell.arm.servo import Servo
from hil.cell.arm.signals import Signals
from hil.cell.arm.sockets import Sockets
from hil.cell.arm.streams.announcer import Announcer
from hil.cell.arm.watchdog import Watchdog
from hil.cell.rig.robot import Robot

_CODE: Final = re.compile(r"C(\d+)A(\d+)\b")

NS: Final = 1_000_000_000
LOG_LINES: Final = 10_000
"""The newest lines that a box keeps; a program may write one every cycle."""


class ControlBox:
    """t: controller time, ns. version: of the emulated software. log: (t, text), oldest first."""

    __slots__ = (
        "announcer", "contact", "doors", "estimate", "force_mode", "inputs", "jaws", "kinematics",
        "log", "measured", "modes", "ownership", "pendant", "period", "registers", "robot", "servo",
        "signals", "sockets", "t", "target", "tool", "version", "watchdog",
    )  # fmt: skip

    def __init__(self, robot: Robot) -> None:
        dt = robot.period / NS
        self.robot = robot
        self.period = robot.period
        self.version = tuple(int(part) for part in robot.version.split("."))
        self.t = 0
        self.log: deque[tuple[int, str]] = deque(maxlen=LOG_LINES)
        self.doors = DoorLog(self.say)
        self.announcer = Announcer()
        self.pendant = Pendant(robot.programs)
        self.modes = Modes()
        self.registers = Registers()
        self.signals = Signals()
        self.inputs = InputImage(self.registers, self.signals)
        self.sockets = Sockets()
        self.ownership = Ownership()
        self.watchdog = Watchdog()
        self.jaws = Jaws(robot.jaws)
        self.kinematics = Kinematics(robot.model)
        self.tool = Tool()
        self.servo = Servo(robot.home, dt)
        self.target = Target(self.kinematics.forward(robot.home), self.tool, dt)
        self.measured = Measurement(robot.home, self.kinematics, self.tool)
        self.estimate = ForceEstimate(self.measured, self.tool, self.inputs, robot.period)
        self.contact = ContactHistory(self.estimate, THRESHOLDS[robot.series != "cb3"])
        self.force_mode = ForceMode(dt)

    @property
    def seconds(self) -> float:
        """Controller time, s; the nearest double to a whole number of nanoseconds."""
        return self.t / NS

    def say(self, text: str) -> None:
        """Write a line to the controller's log."""
        self.log.append((self.t, text))

    def post(self, event: Event) -> bool:
        """Pass an event to the mode machines now; false when it changed nothing."""
        return self.modes.post(event, self.t)

    def announce(self, message: Message) -> None:
        """Tell the clients of the primary port."""
        self.announcer.post(self.t, message)

    def protective_stop(self, reason: str) -> None:
        """Stop in a controlled way and end the program, saying why in the log.

        Clients are told an error code: the one that `reason` begins with (C207A0: ...), or C0A0,
        for UR publishes no table of its codes that could be relied on.
        """
        if self.post(Event.PROTECTIVE_STOP):
            self.say(f"protective stop: {reason}")
            found = _CODE.match(reason)
            code, argument = (int(found[1]), int(found[2])) if found else (0, 0)
            self.announce(ErrorCode(code, argument, Level.WARNING, reason))
