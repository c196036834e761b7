"""A UR arm behind `drivers.interfaces.Arm`: RTDE set-points to a program that servos the TCP.

One command a package: `connect` leaves a command on the wire, and from then on `read` and a command
(`servo`, `hold` or `stop`) alternate. On a robot this paces the loop by the controller; an emulated
cell in lockstep advances one period for each command.
"""

from collections.abc import Callable
from contextlib import suppress
from dataclasses import dataclass
from math import hypot, isfinite
from types import TracebackType
from typing import Final, Self, TypeAlias

from drivers.errors import DriverError, LinkError, ProtocolError, RobotStateError
from drivers.interfaces import ArmState, Vector6
from drivers.protocol.rtde import PackageType, encode
from drivers.ur.bring_up import NS, end_program, power_up, release_stop, start_program
from drivers.ur.connection import RtdeConnection
from drivers.ur.dashboard import Dashboard
from drivers.ur.plausible import check
from drivers.ur.program import SEQUENCE_MASK, Command, ServoProgram
from drivers.ur.sample import INPUTS, OUTPUTS, Sample, fault
from drivers.ur.script_port import ScriptPort
from drivers.ur.tcp import insist

_BARE_FLANGE: Final = ServoProgram()
_OUTPUT_BITS: Final = 8
_NEVER: Final = -1  # before any controller time
REPLAY: Final = NS // 2
"""A package older than the last one by up to so many ns is late or repeated, and discarded; one
older still comes from a clock that began anew."""
STANDING: Final = 1e-3
"""m/s below which an arm has done with braking."""
_NOWHERE: Final[Vector6] = (0.0, 0.0, 0.0, 0.0, 0.0, 0.0)


Tap: TypeAlias = Callable[[int, bool, bytes], None]
"""(arm time in ns, whether it is sent, the whole package); must be quick and must not block.

A package is heard before it goes out: what is told of it is known before the arm acts on it.
"""


@dataclass(frozen=True, slots=True)
class UrPorts:
    """TCP ports of the control box; script is any of 30001 to 30003."""

    rtde: int = 30004
    dashboard: int = 29999
    script: int = 30002


class UrArm:
    """One arm at `host`. limit: wall-clock s of silence after which a link counts as dead.

    rate: Hz that the caller was built for, checked against the controller's; None takes that.
    tries: attempts at an RTDE link that is refused or cut, before anything moves.
    unanswered: controller s for which the program may leave commands unanswered.
    tap: hears every data package that is sent or read.
    """

    def __init__(
        self,
        host: str,
        ports: UrPorts = UrPorts(),
        *,
        program: ServoProgram = _BARE_FLANGE,
        rate: int | None = None,
        limit: float = 5.0,
        tries: int = 3,
        unanswered: float = 0.3,
        tap: Tap | None = None,
    ) -> None:
        self._rtde = RtdeConnection(host, ports.rtde, OUTPUTS, INPUTS, limit)
        self._dashboard = Dashboard(host, ports.dashboard, limit)
        self._script = ScriptPort(host, ports.script, limit)
        self._program = program
        self._expected_rate = rate
        self._rate = rate
        self._tries = tries
        self._unanswered = round(unanswered * NS)
        self._echo, self._answered = _NEVER, _NEVER  # newest echo, and when it came, ns
        self._braking = False  # the program hears nothing meanwhile
        self._tap = tap
        self._sequence = 0
        self._awaited = False  # a command is out whose package has not been read
        self._t = _NEVER
        self._last: Sample | None = None
        self.discarded = 0  # packages that were no newer than one read before
        self._cycle = 0  # of the motion program, as it was last heard
        self._actual: Vector6 = _NOWHERE
        self._set_point: Vector6 | None = None
        self._mask = 0
        self._outputs = 0

    def __enter__(self) -> Self:
        self.connect()
        return self

    def __exit__(
        self,
        kind: type[BaseException] | None,
        error: BaseException | None,
        trace: TracebackType | None,
    ) -> None:
        self.close()

    @property
    def period(self) -> int:
        """Control period, ns; LinkError while nobody has said which series this is."""
        if self._rate is None:
            raise LinkError("the control period is known once connected")
        return NS // self._rate

    def connect(self) -> ArmState:
        """Power, brakes, program: to where the arm follows set-points; raises DriverError."""
        self.abandon()
        return self._bring_up(lambda: None)

    def recover(self) -> ArmState:
        """Release a protective stop and bring the arm up again; raises DriverError.

        Call it only when a person or supervisor has removed the cause of the stop.
        """
        return self._bring_up(lambda: release_stop(self._exchange, self._dashboard))

    def close(self) -> None:
        """Let the program stop the arm and end; never raises for a dead link."""
        # A link that dies here is no loss: the program's own watchdog stops the arm.
        with suppress(DriverError):
            end_program(self._exchange)
        self.abandon()

    def read(self) -> ArmState:
        """Block for the next package and return the newest one.

        Raises LinkError, LinkTimeoutError, ProtectiveStopError, RobotStateError; LinkError also for
        a robot that no longer answers commands, which the dashboard is asked to stop.
        """
        sample = self._receive()
        if not sample.follows:
            self._set_point = None
            raise self._explained(sample)
        self._mind_echo(sample)
        return sample.state(self._t)

    def servo(self, pose: Vector6) -> Vector6:
        """Send one TCP set-point; returns the pose sent. Raises ValueError for a non-finite one."""
        if len(pose) != 6 or not all(map(isfinite, pose)):
            raise ValueError(f"a set-point is six finite numbers, found {pose}")
        self._send(Command.SERVO, pose)
        self._set_point = pose
        return pose

    def hold(self) -> Vector6:
        """Repeat the last set-point; without one the arm stands where it is."""
        if self._set_point is not None:
            return self.servo(self._set_point)
        self._send(Command.HOLD, self._actual)
        return self._actual

    def stop(self) -> None:
        """Ask for a controlled stop; the next `servo` starts from the actual pose."""
        self._set_point = None
        self._send(Command.STOP, self._actual)

    def set_output(self, bit: int, on: bool) -> None:
        """Set standard digital output 0..7 with the next command, and keep it so."""
        if not 0 <= bit < _OUTPUT_BITS:
            raise ValueError(f"standard digital output {bit}, allowed are 0..{_OUTPUT_BITS - 1}")
        self._mask |= 1 << bit
        self._outputs = self._outputs & ~(1 << bit) | on << bit

    def _bring_up(self, release: Callable[[], None]) -> ArmState:
        """From whatever state the robot is in to a running program and one command on the wire."""
        try:
            self._script.open()
            self._open_rtde()
            release()
            power_up(self._exchange, self._dashboard)
            end_program(self._exchange)
            sample = start_program(self._exchange, self._upload, self._sequence)
            self._send(Command.HOLD, self._actual)
        except BaseException:
            self.abandon()
            raise
        self._script.close()
        return sample.state(self._t)

    def _open_rtde(self) -> None:
        """Connect unless connected, and count on from the sequence an earlier program echoes."""
        if self._rtde.is_open:
            return
        agreement = insist(self._rtde.open, self._tries)
        if self._expected_rate not in (None, agreement.rate):
            raise RobotStateError(
                f"controller {agreement.version} runs at {agreement.rate} Hz, "
                f"the caller was built for {self._expected_rate} Hz"
            )
        self._rate = agreement.rate
        self._t, self._awaited, self._set_point, self._last = _NEVER, False, None, None
        self._sequence = self._exchange(Command.LEAVE).echo & SEQUENCE_MASK

    def _upload(self) -> None:
        self._script.upload(self._program.text(NS // self.period))

    def abandon(self) -> None:
        """Cut the links without a word, as a killed process does; the robot's watchdogs act."""
        self._script.close()
        self._dashboard.close()
        self._rtde.close()

    def _exchange(self, command: Command) -> Sample:
        """One command and the next package; a package already on its way comes first."""
        if not self._awaited:
            self._send(command, self._actual)
        return self._receive()

    def _send(self, command: Command, pose: Vector6) -> None:
        self._sequence = (self._sequence + 1) & SEQUENCE_MASK
        told = (command, self._sequence, *pose)
        check = sum(told) + self._cycle  # neither RTDE nor TCP's sum would tell a bent number
        package = self._rtde.pack((*told, self._mask, self._outputs, self._cycle, check))
        if self._tap is not None:
            self._tap(max(self._t, 0), True, package)
        self._rtde.put(package)
        self._awaited = True
        if command is not Command.HOLD:
            self._braking = command is Command.STOP

    def _receive(self) -> Sample:
        """The newest package, if it is newer than the last one; else the next that is.

        Raises ProtocolError for one that cannot be true.
        """
        t, sample, payload = self._newest()
        while t <= self._t:
            if t < self._t - REPLAY:
                raise LinkError(f"controller time went back from {self._t} to {t} ns; it restarted")
            t, sample, payload = self._newest()
        check(sample, self._last)
        self._awaited = False
        self._t, self._cycle, self._last = t, sample.cycle, sample
        self._actual = sample.pose
        if self._tap is not None:
            self._tap(t, False, encode(PackageType.DATA, payload))
        return sample

    def _newest(self) -> tuple[int, Sample, bytes]:
        """Time (ns), values and payload of the newest of the packages that wait."""
        samples = [Sample._make(values) for values in self._rtde.read()]
        times = [_time(sample) for sample in samples]
        newest = max(range(len(times)), key=times.__getitem__)
        self.discarded += sum(t <= self._t for t in times)
        return times[newest], samples[newest], self._rtde.received[newest]

    def _mind_echo(self, sample: Sample) -> None:
        """LinkError once the program no longer answers, though its states still come.

        Its own watchdog stops the arm then. The dashboard, another link, is asked to do it as well.
        """
        self._braking = self._braking and hypot(*sample.twist[:3]) > STANDING
        if sample.echo != self._echo or self._braking:
            self._echo, self._answered = sample.echo, self._t
        if self._t - self._answered <= self._unanswered:
            return
        self._set_point = None
        with suppress(DriverError):
            self._dashboard.stop()
        raise LinkError(
            f"the robot has answered no command for {self._unanswered / NS:g} s, though its states "
            "arrive: commands are lost on their way, or somebody else's are obeyed"
        )

    def _explained(self, sample: Sample) -> DriverError:
        """The fault, with what the controller last said as notes."""
        error = fault(sample)
        for text in self._rtde.texts:
            error.add_note(f"controller: {text.message}")
        return error


def _time(sample: Sample) -> int:
    """Controller time, ns."""
    try:
        return sample.t
    except (ValueError, OverflowError):
        raise ProtocolError(f"controller time is {sample.timestamp} s") from None
