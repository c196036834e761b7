"""One RTDE package as the arm driver asks for it, and what it says about the robot's health."""

from enum import IntEnum
from typing import Final, NamedTuple

from drivers.errors import ProtectiveStopError, RobotStateError
from drivers.interfaces import ArmState, RobotMode, SafetyMode, Vector6
from drivers.protocol.rtde_states import RuntimeState
from drivers.ur.program import ProgramState

OUTPUTS: Final = (
    "timestamp",
    "actual_q",
    "actual_TCP_pose",
    "target_TCP_pose",
    "actual_TCP_speed",
    "robot_mode",
    "safety_mode",
    "runtime_state",
    "actual_digital_input_bits",
    "actual_digital_output_bits",
    "output_int_register_24",
    "output_int_register_25",
    "output_int_register_26",
)

INPUTS: Final = (
    "input_int_register_24",
    "input_int_register_25",
    *(f"input_double_register_{n}" for n in range(24, 30)),
    "standard_digital_output_mask",
    "standard_digital_output",
    "input_int_register_26",
    "input_double_register_30",
)


class Sample(NamedTuple):
    """The values of OUTPUTS in their order; timestamp in s.

    echo, program, cycle: what the motion program says: sequence heard, state, cycles run.
    """

    timestamp: float
    q: Vector6
    pose: Vector6
    target_pose: Vector6
    twist: Vector6
    robot_mode: int
    safety_mode: int
    runtime_state: int
    inputs: int
    outputs: int
    echo: int
    program: int
    cycle: int

    @property
    def t(self) -> int:
        """Controller time, ns."""
        return round(self.timestamp * 1e9)

    @property
    def safe(self) -> bool:
        return self.safety_mode in _SAFE

    @property
    def playing(self) -> bool:
        """Whether our program runs, given that it has been seen to start."""
        return self.runtime_state == RuntimeState.PLAYING and self.program in _RUNNING

    @property
    def follows(self) -> bool:
        """Whether the arm follows set-points."""
        return self.safe and self.robot_mode == RobotMode.RUNNING and self.playing

    def state(self, t: int) -> ArmState:
        """The sample of a robot that follows, in the interface's words."""
        return ArmState(
            t,
            self.q,
            self.pose,
            self.target_pose,
            self.twist,
            RobotMode.RUNNING,
            _SAFE[self.safety_mode],
            True,
            self.inputs,
            self.outputs,
        )


_SAFE: Final = {int(mode): mode for mode in (SafetyMode.NORMAL, SafetyMode.REDUCED)}
_RUNNING: Final = frozenset((int(ProgramState.STANDING), int(ProgramState.SERVOING)))


def fault(sample: Sample) -> RobotStateError:
    """Why the arm does not follow, the gravest reason first."""
    if sample.safety_mode == SafetyMode.PROTECTIVE_STOP:
        return ProtectiveStopError("protective stop: inspect its cause, then call recover()")
    if not sample.safe:
        return RobotStateError(f"safety mode is {_name(SafetyMode, sample.safety_mode)}")
    if sample.robot_mode != RobotMode.RUNNING:
        return RobotStateError(f"robot mode is {_name(RobotMode, sample.robot_mode)}, not RUNNING")
    if sample.program == ProgramState.SILENCE:
        return RobotStateError("the motion program ended itself: commands fell silent or late")
    state = _name(RuntimeState, sample.runtime_state)
    return RobotStateError(f"the motion program does not run (runtime state {state})")


def _name(numbers: type[IntEnum], value: int) -> str:
    """The mode's name, or its number when this driver has no name for it."""
    return numbers(value).name if value in set(numbers) else str(value)
