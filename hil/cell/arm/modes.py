"""Robot, safety and program state as transition tables, with their delays in bench time.

The box starts as a real one does: safe, without power, no program. An event that a table does not
list changes nothing; `Modes.post` says so, because the dashboard's answers depend on it.
"""

from collections.abc import Mapping
from enum import Enum, auto
from types import MappingProxyType
from typing import Final

from drivers.protocol.rtde_states import SAFETY_BITS, JointMode, RobotMode, RuntimeState, SafetyMode

MS: Final = 1_000_000

BOOT_TIME: Final = 1000 * MS  # assumed; a real arm takes several seconds
BRAKE_TIME: Final = 800 * MS  # assumed: six brakes released one after another
RELEASE_TIME: Final = 200 * MS  # assumed, from the raw unlock command to the end of the stop
UNLOCK_DELAY: Final = 5000 * MS
"""A protective stop can be unlocked 5 s after it began (so says the dashboard's own reply)."""


class Event(Enum):
    POWER_ON = auto()
    POWER_OFF = auto()
    BRAKE_RELEASE = auto()
    BOOTED = auto()
    BRAKES_OPEN = auto()
    PROTECTIVE_STOP = auto()
    UNLOCK = auto()
    SAFEGUARD_OPEN = auto()
    SAFEGUARD_RESET = auto()
    EMERGENCY_STOP = auto()
    EMERGENCY_RESET = auto()
    RESTART_SAFETY = auto()
    START = auto()
    PAUSE = auto()
    RESUME = auto()
    FINISH = auto()


R, S, P = RobotMode, SafetyMode, RuntimeState

ROBOT: Final[Mapping[tuple[RobotMode, Event], RobotMode]] = MappingProxyType(
    {
        (R.POWER_OFF, Event.POWER_ON): R.BOOTING,
        (R.POWER_OFF, Event.BRAKE_RELEASE): R.BOOTING,
        (R.BOOTING, Event.BRAKE_RELEASE): R.BOOTING,
        (R.BOOTING, Event.BOOTED): R.IDLE,
        (R.IDLE, Event.BRAKE_RELEASE): R.IDLE,
        (R.IDLE, Event.BRAKES_OPEN): R.RUNNING,
        **{
            (mode, event): R.POWER_OFF
            for mode in (R.POWER_OFF, R.BOOTING, R.IDLE, R.RUNNING)
            for event in (Event.POWER_OFF, Event.EMERGENCY_STOP, Event.RESTART_SAFETY)
        },
    }
)

SAFETY: Final[Mapping[tuple[SafetyMode, Event], SafetyMode]] = MappingProxyType(
    {
        (S.NORMAL, Event.PROTECTIVE_STOP): S.PROTECTIVE_STOP,
        (S.REDUCED, Event.PROTECTIVE_STOP): S.PROTECTIVE_STOP,
        (S.PROTECTIVE_STOP, Event.UNLOCK): S.NORMAL,
        (S.NORMAL, Event.SAFEGUARD_OPEN): S.SAFEGUARD_STOP,
        (S.REDUCED, Event.SAFEGUARD_OPEN): S.SAFEGUARD_STOP,
        (S.SAFEGUARD_STOP, Event.SAFEGUARD_RESET): S.NORMAL,
        (S.SAFEGUARD_STOP, Event.EMERGENCY_STOP): S.ROBOT_EMERGENCY_STOP,
        (S.NORMAL, Event.EMERGENCY_STOP): S.ROBOT_EMERGENCY_STOP,
        (S.REDUCED, Event.EMERGENCY_STOP): S.ROBOT_EMERGENCY_STOP,
        (S.PROTECTIVE_STOP, Event.EMERGENCY_STOP): S.ROBOT_EMERGENCY_STOP,
        (S.ROBOT_EMERGENCY_STOP, Event.EMERGENCY_RESET): S.NORMAL,
        (S.VIOLATION, Event.RESTART_SAFETY): S.NORMAL,
        (S.FAULT, Event.RESTART_SAFETY): S.NORMAL,
        (S.NORMAL, Event.RESTART_SAFETY): S.NORMAL,
        (S.PROTECTIVE_STOP, Event.RESTART_SAFETY): S.NORMAL,
    }
)

_ENDS_PROGRAM: Final = (
    Event.FINISH,
    Event.PROTECTIVE_STOP,
    Event.EMERGENCY_STOP,
    Event.POWER_OFF,
    Event.RESTART_SAFETY,
)

PROGRAM: Final[Mapping[tuple[RuntimeState, Event], RuntimeState]] = MappingProxyType(
    {
        (P.STOPPED, Event.START): P.PLAYING,
        (P.PLAYING, Event.START): P.PLAYING,
        (P.PAUSED, Event.START): P.PLAYING,
        (P.PLAYING, Event.PAUSE): P.PAUSED,
        (P.PLAYING, Event.SAFEGUARD_OPEN): P.PAUSED,
        (P.PAUSED, Event.RESUME): P.PLAYING,
        **{(s, e): P.STOPPED for s in (P.PLAYING, P.PAUSED) for e in _ENDS_PROGRAM},
    }
)

_SAFE: Final = (S.NORMAL, S.REDUCED)
_NEEDS_SAFE: Final = (Event.POWER_ON, Event.BRAKE_RELEASE, Event.START, Event.RESUME)


class Modes:
    """The three machines, stepped by one stream of events and by bench time."""

    __slots__ = (
        "_brakes_wanted", "_due", "_stopped_at", "_unlock_at", "joint_modes", "program",
        "robot", "robot_bits", "safety", "safety_bits",
    )  # fmt: skip

    def __init__(self) -> None:
        self.robot = RobotMode.POWER_OFF
        self.safety = SafetyMode.NORMAL
        self.program = RuntimeState.STOPPED
        self._due: tuple[int, Event] | None = None
        self._brakes_wanted = False
        self._stopped_at = 0
        self._unlock_at: int | None = None
        self._refresh()

    def post(self, event: Event, t: int) -> bool:
        """Take one event at bench time t, ns; false when no machine had a transition for it."""
        if event in _NEEDS_SAFE and self.safety not in _SAFE:
            return False
        if event is Event.START and self.robot is not RobotMode.RUNNING:
            return False
        robot = ROBOT.get((self.robot, event))
        safety = SAFETY.get((self.safety, event))
        program = PROGRAM.get((self.program, event))
        self.safety = safety or self.safety
        self.program = program or self.program
        if robot is not None:
            self._enter(robot, event, t)
        if safety is SafetyMode.PROTECTIVE_STOP:
            self._stopped_at = t
        self._refresh()
        return (robot, safety, program) != (None, None, None)

    def advance(self, t: int) -> None:
        """Post the delayed events that are due at t."""
        while self._due is not None and t >= self._due[0]:
            due, event = self._due
            self._due = None
            self.post(event, due)
        if self._unlock_at is not None and t >= self._unlock_at:
            self._unlock_at = None
            self.post(Event.UNLOCK, t)

    def unlock_soon(self, t: int) -> None:
        """Unlock a protective stop, however young, as the primary port's raw command does.

        The rule of 5 s is the dashboard's alone: UR's client library unlocks over the primary port
        within a second of the stop, and waits 5 s at most.
        """
        self._unlock_at = t + RELEASE_TIME

    def unlockable(self, t: int) -> bool:
        """Whether a protective stop, if there is one, is old enough to be unlocked."""
        return self.safety is not SafetyMode.PROTECTIVE_STOP or t - self._stopped_at >= UNLOCK_DELAY

    @property
    def moving(self) -> bool:
        """Brakes open and no safety stop: the servo may follow a program."""
        return self.robot is RobotMode.RUNNING and self.safety in _SAFE

    @property
    def powered(self) -> bool:
        return self.robot >= RobotMode.POWER_ON

    def _enter(self, mode: RobotMode, event: Event, t: int) -> None:
        self.robot = mode
        if mode is RobotMode.POWER_OFF:
            self._due, self._brakes_wanted = None, False
            return
        self._brakes_wanted |= event is Event.BRAKE_RELEASE
        if mode is RobotMode.BOOTING and self._due is None:
            self._due = (t + BOOT_TIME, Event.BOOTED)
        elif mode is RobotMode.IDLE and self._brakes_wanted and self._due is None:
            self._due = (t + BRAKE_TIME, Event.BRAKES_OPEN)

    def _refresh(self) -> None:
        """Derive what RTDE sends every cycle, once a change."""
        running = self.program is RuntimeState.PLAYING
        self.robot_bits = int(self.powered) | running << 1
        self.safety_bits = SAFETY_BITS[self.safety]
        self.joint_modes = (int(_JOINTS[self.robot]),) * 6


_JOINTS: Final = MappingProxyType(
    {
        RobotMode.POWER_OFF: JointMode.POWER_OFF,
        RobotMode.BOOTING: JointMode.BOOTING,
        RobotMode.IDLE: JointMode.IDLE,
        RobotMode.RUNNING: JointMode.RUNNING,
    }
)
