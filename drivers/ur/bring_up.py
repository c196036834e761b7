"""From any state to a running motion program, step by step, in controller time.

Each step exchanges packages while it waits: the robot's clock is the only one that counts, and an
emulated cell in lockstep advances only when commands arrive.
"""

from collections.abc import Callable
from typing import Final, TypeAlias

from drivers.errors import RobotStateError
from drivers.interfaces import RobotMode, SafetyMode
from drivers.protocol.rtde_states import RuntimeState
from drivers.ur.dashboard import Dashboard
from drivers.ur.program import SEQUENCE_MASK, Command
from drivers.ur.sample import Sample, fault

NS: Final = 1_000_000_000
POWER_UP: Final = 60 * NS  # a cold CB3 takes some 20 s to boot its joints
PROGRAM_START: Final = 5 * NS  # 35 ms on an open connection, up to 0.6 s on a new one
PROGRAM_END: Final = 3 * NS  # the longest controlled stop plus a control cycle
UNLOCK: Final = 10 * NS  # the controller refuses for 5 s after the stop
RETRY: Final = NS // 2
QUIET: Final = NS // 10  # ten times a slow network's delay

Exchange: TypeAlias = Callable[[Command], Sample]
"""Sends one command, returns the next package."""


def wait_until(
    exchange: Exchange, command: Command, reached: Callable[[Sample], bool], limit: int
) -> Sample | None:
    """Repeat a command until a package satisfies `reached`; None after `limit` ns."""
    sample = exchange(command)
    end = sample.t + limit
    while not reached(sample):
        if sample.t >= end:
            return None
        sample = exchange(command)
    return sample


def power_up(exchange: Exchange, dashboard: Dashboard) -> None:
    """Power on and release the brakes, as far as needed; raises RobotStateError."""
    steps: dict[int, Callable[[], None]] = {
        RobotMode.POWER_OFF: dashboard.power_on,
        RobotMode.IDLE: dashboard.release_brakes,
    }

    def running(sample: Sample) -> bool:
        if not sample.safe:
            raise fault(sample)
        step = steps.pop(sample.robot_mode, None)  # each step once
        if step is not None:
            step()
        return sample.robot_mode == RobotMode.RUNNING

    if wait_until(exchange, Command.LEAVE, running, POWER_UP) is None:
        raise RobotStateError(f"robot mode is not RUNNING after {POWER_UP // NS} s")


def end_program(exchange: Exchange) -> None:
    """Let an earlier motion program leave; raises RobotStateError when a foreign one goes on."""
    ended = wait_until(exchange, Command.LEAVE, _stopped, PROGRAM_END)
    if ended is None:
        raise RobotStateError("another program holds the controller; stop it on the pendant first")


def start_program(exchange: Exchange, upload: Callable[[], None], sequence: int) -> Sample:
    """Upload the motion program; the first package in which it answers a command after `sequence`.

    Raises RobotStateError when it does not start.
    """

    def answers(sample: Sample) -> bool:
        if not sample.safe:
            raise fault(sample)
        return sample.follows and 0 < (sample.echo - sequence) & SEQUENCE_MASK < 1 << 30

    _hold(exchange, QUIET)
    upload()
    started = wait_until(exchange, Command.HOLD, answers, PROGRAM_START)
    if started is None:
        raise RobotStateError(
            f"the motion program did not start within {PROGRAM_START // NS} s; "
            "is the controller in remote control, and its log free of script errors?"
        )
    return started


def _hold(exchange: Exchange, duration: int) -> None:
    """Repeat HOLD for so many ns.

    A LEAVE still on its way when the program starts would end it: there is no program yet that
    could echo what has arrived.
    """
    end = exchange(Command.HOLD).t + duration
    while exchange(Command.HOLD).t < end:
        pass


def release_stop(exchange: Exchange, dashboard: Dashboard) -> None:
    """Release a protective stop, which the controller allows 5 s after it occurred."""
    sample = exchange(Command.LEAVE)
    end = sample.t + UNLOCK
    while sample.safety_mode == SafetyMode.PROTECTIVE_STOP:
        if sample.t >= end:
            raise fault(sample)
        dashboard.unlock_protective_stop()
        released = wait_until(exchange, Command.LEAVE, _released, RETRY)
        sample = released if released is not None else exchange(Command.LEAVE)
    if not _stopped(sample):  # a stop may leave the program paused, deaf to commands
        dashboard.stop()


def _stopped(sample: Sample) -> bool:
    return sample.runtime_state == RuntimeState.STOPPED


def _released(sample: Sample) -> bool:
    return sample.safety_mode != SafetyMode.PROTECTIVE_STOP
