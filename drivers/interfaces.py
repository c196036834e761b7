"""What a controller may ask of an arm, a force/torque sensor and a gripper; nothing else crosses.

Poses are (x, y, z, rx, ry, rz): metres and a rotation vector in radians, of the TCP in the robot's
base frame. Wrenches are (fx, fy, fz, tx, ty, tz): newtons and newton-metres on the tool, in the
sensor's frame. Time is the arm controller's own clock in integer nanoseconds, carried by each
`ArmState`; no driver reads the host's clock to judge age.
"""

from enum import Enum
from typing import NamedTuple, Protocol, TypeAlias

from drivers.protocol.can_error import BusState
from drivers.protocol.rtde_states import RobotMode, SafetyMode

__all__ = [
    "Arm",
    "ArmState",
    "BusState",
    "ForceTorqueSensor",
    "Freshness",
    "Gripper",
    "RobotMode",
    "SafetyMode",
    "SensorHealth",
    "Vector6",
    "WrenchReading",
]

Vector6: TypeAlias = tuple[float, float, float, float, float, float]


class ArmState(NamedTuple):
    """One package of the arm controller.

    t: controller time, ns. q: joint angles, rad. pose, target_pose: TCP in base, m and rad.
    twist: TCP velocity in base, m/s and rad/s. inputs, outputs: digital I/O bits.
    program_running: the uploaded motion program accepts set-points.
    """

    t: int
    q: Vector6
    pose: Vector6
    target_pose: Vector6
    twist: Vector6
    robot_mode: RobotMode
    safety_mode: SafetyMode
    program_running: bool
    inputs: int
    outputs: int


class Arm(Protocol):
    """A position-controlled arm whose packages pace the control loop."""

    @property
    def period(self) -> int:
        """Control period, ns."""
        ...

    def connect(self) -> ArmState:
        """Bring the arm to where it follows set-points: power, brakes, program; DriverError."""
        ...

    def recover(self) -> ArmState:
        """The same from a protective stop too, whose cause somebody has removed; DriverError."""
        ...

    def close(self) -> None:
        """Stop the motion program and leave; never raises for a dead link."""
        ...

    def read(self) -> ArmState:
        """Block for the next package and return the newest one.

        Raises LinkError, LinkTimeoutError, ProtectiveStopError, RobotStateError.
        """
        ...

    def servo(self, pose: Vector6) -> Vector6:
        """Send one TCP set-point; returns the pose sent. Raises ValueError for a non-finite one."""
        ...

    def hold(self) -> Vector6:
        """Repeat the last set-point (the first time: the actual pose), so that the link lives."""
        ...

    def stop(self) -> None:
        """Ask for a controlled stop; the next `servo` starts from the actual pose."""
        ...

    def set_output(self, bit: int, on: bool) -> None:
        """Set a standard digital output with the next command."""
        ...


class Freshness(Enum):
    """OK: a new sample came since the last read. HELD: the last one stands in, within the limit."""

    OK = "ok"
    HELD = "held"


class WrenchReading(NamedTuple):
    """What the sensor said since the last read.

    wrench: the newest complete sample, N and N·m, sensor frame. samples: all new ones, oldest
    first, empty when HELD. counter: the newest sample's unwrapped count. age: ns in arm time.
    """

    wrench: Vector6
    samples: tuple[Vector6, ...]
    counter: int
    age: int
    freshness: Freshness
    tared: bool


class SensorHealth(NamedTuple):
    """Counts since connect: what the wire lost, repeated or bent; bus: as its error frames say,
    which only kernel CAN interfaces make.
    """

    pairs: int
    gaps: int
    duplicates: int
    torn: int
    malformed: int
    foreign: int
    receiver_alive: bool
    last_error: str
    bus: BusState = BusState.ACTIVE


class ForceTorqueSensor(Protocol):
    """A wrist sensor that streams samples; a later poll brings the answer to a command."""

    def connect(self) -> None:
        """Open the bus; raises LinkError."""
        ...

    def close(self) -> None: ...

    def start(self) -> None:
        """Ask the node to transmit; `ready` turns true once samples flow."""
        ...

    @property
    def ready(self) -> bool: ...

    def poll(self, t: int) -> None:
        """Take what the bus holds at arm time t; raises what a pending command came to."""
        ...

    def read(self, t: int) -> WrenchReading:
        """Poll, then the newest wrench; raises NotReadyError, StaleSampleError, OverloadError,
        SensorResetError or LinkError, never an old number.
        """
        ...

    def begin_tare(self, samples: int) -> None:
        """Ask the node to zero itself on the mean of so many samples."""
        ...

    @property
    def tare_pending(self) -> bool: ...

    @property
    def health(self) -> SensorHealth: ...


class Gripper(Protocol):
    """A two-jaw gripper that says whether it holds something."""

    def open(self) -> None: ...

    def close(self) -> None: ...

    def holds(self, state: ArmState) -> bool:
        """Whether the jaws sensed a part in this package."""
        ...
