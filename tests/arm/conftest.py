"""An arm on an ideal plant: it goes where it is told, at once, and feels nothing."""

from collections.abc import Callable

import numpy as np
import pytest

from drivers.protocol.rtde_states import RobotMode
from hil.cell.arm.controller import ArmController, ArmTarget
from hil.cell.arm.modes import Event
from hil.cell.rig.robot import Robot

ZERO6 = (0.0,) * 6


class Cell:
    """One arm and its bench time."""

    def __init__(self, robot: Robot, seed: int = 1) -> None:
        self.arm = ArmController(robot, np.random.default_rng(seed))
        self.box = self.arm.box
        self.t = 0
        self.part_held = False

    def run(self, cycles: int = 1) -> ArmTarget:
        """Pass so many periods; the last one's target."""
        for _ in range(cycles):
            target = self.arm.frame(self.t)
            self.t += self.box.period
            self.arm.observe(self.t, target.flange, ZERO6, ZERO6, self.part_held)
        return target

    def seconds(self, seconds: float) -> ArmTarget:
        return self.run(round(seconds * 1e9) // self.box.period)

    def release_brakes(self) -> None:
        self.arm.box.post(Event.BRAKE_RELEASE)
        self.seconds(2.0)
        assert self.box.modes.robot is RobotMode.RUNNING

    @property
    def log(self) -> str:
        return "\n".join(text for _, text in self.arm.log)


@pytest.fixture
def make_cell() -> Callable[..., Cell]:
    return lambda seed=1, **changes: Cell(Robot(**changes), seed)


@pytest.fixture
def cell(make_cell: Callable[..., Cell]) -> Cell:
    """A CB3 arm as a box wakes up: without power."""
    return make_cell()


@pytest.fixture
def running(cell: Cell) -> Cell:
    """The same with its brakes open."""
    cell.release_brakes()
    return cell
