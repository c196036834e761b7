"""Bringing arm and sensor to where a job can begin; nothing here blocks on the sensor."""

from collections.abc import Callable

from controller.self_test import Load, self_test
from drivers.errors import NotReadyError
from drivers.interfaces import Arm, ArmState, ForceTorqueSensor

PATIENCE = 10.0
"""s of arm time for the sensor to boot, and again to be zeroed."""


def bring_up(
    arm: Arm, sensor: ForceTorqueSensor, tare_samples: int = 1000, *, load: Load | None = None
) -> ArmState:
    """Connect both, test the sensor, zero it in free air; leaves one command in flight.

    load: what hangs below the sensor, by which its axes are tested: the arm shakes the tool by a
    millimetre, and holds its pose otherwise. None leaves them untested. Raises DriverError as the
    drivers do, and NotReadyError when the sensor does not follow within the limit.
    """
    sensor.connect()
    arm.connect()
    sensor.start()
    _hold_until(arm, sensor, lambda: sensor.ready, "samples")
    return _tested(arm, sensor, tare_samples, load)


def resume(
    arm: Arm,
    sensor: ForceTorqueSensor,
    clear: Callable[[], None],
    tare_samples: int = 1000,
    *,
    load: Load | None = None,
) -> ArmState:
    """The same after a stop, once a person or supervisor has removed its cause and permits it.

    A protective stop is released; handshake, program, self test and zero are all made anew. clear:
    takes the tool to free air, on a sensor that is not zeroed, with one command in flight.
    """
    sensor.connect()
    arm.recover()
    sensor.start()
    _hold_until(arm, sensor, lambda: sensor.ready, "samples")
    clear()
    return _tested(arm, sensor, tare_samples, load)


def _tested(arm: Arm, sensor: ForceTorqueSensor, tare_samples: int, load: Load | None) -> ArmState:
    if load is not None:
        self_test(arm, sensor, load)
    sensor.begin_tare(tare_samples)
    return _hold_until(arm, sensor, lambda: not sensor.tare_pending, "tare")


def _hold_until(
    arm: Arm, sensor: ForceTorqueSensor, done: Callable[[], bool], what: str
) -> ArmState:
    """Read, poll and hold in turn: an arm in lockstep moves on only when it is told something."""
    deadline: int | None = None
    while True:
        state = arm.read()
        sensor.poll(state.t)
        arm.hold()
        if done():
            return state
        deadline = deadline or state.t + round(PATIENCE * 1e9)
        if state.t > deadline:
            raise NotReadyError(f"the sensor gave no {what} within {PATIENCE} s of arm time")
