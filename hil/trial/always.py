"""The monitors of every run: what must hold whatever is broken."""

from typing import Final, NamedTuple

from hil.cell.rig import Rig

NS: Final = 1_000_000_000
REST_SPEED: Final = 2e-3
"""m/s below which the arm stands: what a control period's noise of the plant may look like."""
REST_TURN: Final = 2e-2
"""rad/s."""


class Always(NamedTuple):
    """One monitor: its name, the formula over the run's signals, and what it says in words."""

    name: str
    formula: str
    meaning: str


def monitors(rig: Rig) -> tuple[Always, ...]:
    """Of a rig, with its own limits."""
    limits = rig.limits
    cycles = -(-round(limits.standstill * NS) // rig.robot.period)
    still = f"(speed <= {REST_SPEED} and turning <= {REST_TURN})"
    return (
        Always(
            "F1",
            "not historically[0:1] (measured_force > 1 and running > 0.5 and stopping < 0.5)",
            "no measured force above f_b for more than one cycle before the stop",
        ),
        Always(
            "F1.true",
            f"not historically[0:{_cycles(rig)}] (force > {1 + limits.force_error:g} "
            "and running > 0.5 and stopping < 0.5)",
            "no true force above f_b, sensor error added, for longer than a sample travels",
        ),
        Always(
            "F2",
            f"command_age <= {limits.command_age:.6g} or {still}",
            "no motion on a command older than X",
        ),
        Always(
            "F3",
            f"historically[0:{cycles}] (owed > 0.5) -> {still}",
            "standstill within N cycles of a fault that has to stop the arm",
        ),
        Always(
            "stopped",
            f"historically[0:{cycles}] (running > 0.5 and stopping > 0.5) -> {still}",
            "standstill within N cycles of a stop",
        ),
        *_of_commands(rig),
    )


def _of_commands(rig: Rig) -> tuple[Always, ...]:
    limits, period = rig.limits, rig.robot.period * 1e-9
    return (
        Always("finite", "finite > 0.5", "no set-point that is not a number"),
        Always("step", f"step <= {limits.step * 1.001:.6g}", "step of the target within limits"),
        Always(
            "speed",
            f"step <= {limits.speed * period * 1.05:.6g}",
            "speed of the target within limits",
        ),
        Always(
            "turn", f"turn <= {limits.step_rotation * 1.05:.6g}", "turn of the target in limits"
        ),
        Always("commands", "commands <= 1", "at most one command a cycle"),
        Always("order", "order >= 0", "no command followed after a newer one"),
    )


def _cycles(rig: Rig) -> int:
    """Control periods from a sample's end to the stop that it calls for, at the rig's latency."""
    rtde, can = rig.latency.rtde, rig.latency.can
    way = sum(law.mean + 4 * law.jitter for law in (can.from_cell, rtde.from_cell, rtde.to_cell))
    return -(-round(way * NS) // rig.robot.period) + 1
