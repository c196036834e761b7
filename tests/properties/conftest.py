"""A cell whose near side does one piece of a job at a time, and whoever sets it right again."""

from dataclasses import dataclass

import pytest

from controller.job import leave
from controller.loop import Loop
from controller.start import bring_up
from hil.app.faulty import events
from hil.app.inline import InlineCell
from hil.app.near import limits, near_side, plan, task_frame
from hil.cell.arm.modes import Event as Button
from hil.cell.faults.catalogue import row
from hil.cell.faults.schedule import Schedule
from hil.trial.drive import Driver
from hil.trial.fmea import load
from hil.trial.owed import Owed
from hil.trial.sampler import Sampler
from hil.trial.trial import NS, PATIENCE
from hil_fixtures.testbed import shipped

LONGEST = 600 * NS
TARE = 100


class Workplace:
    """said: told to the cell in the next cycle instead of the job's phase."""

    def __init__(self, rig, faults, stack):
        self.rig, self._stack = rig, stack
        self.plan = plan(rig, rig.fixture.parts[0], (2, -2, 0))
        self.said = []
        self.sampler = Sampler(rig)
        self._driver = Driver(rig, self.sampler, LONGEST)
        self._driver.attend = self._attend
        self._faults = Schedule(tuple(faults)).numbered(1)
        cell = InlineCell(rig, 1, "lockstep", faults=self._faults, observe=self.sampler.tick)
        self.cell = stack.enter_context(cell)
        self.sampler.bench = cell.served.bench
        self._enter()
        bring_up(self.near.arm, self.near.sensor, TARE)
        self._settle()

    def work(self, piece):
        """A piece of the job, watched by the monitors; its outcome."""
        outcome = self._driver.piece(self.near, piece)
        self.sampler.running = False  # a stop ends it too
        return outcome

    def back_off(self):
        """Up from wherever a stop left the tool; there the forces are no verdict."""
        loop = Loop(self.near.arm, self.near.sensor, task_frame(self.rig))
        return loop.run(lambda course: leave(course, self.plan), limits(self.rig).relaxed())

    def recover(self):
        """What a person does who has removed the cause, and the near side goes on; DriverError.

        Whether the jaws hold the part.
        """
        state = self._released()
        self._settle()
        return self.near.gripper.holds(state)

    def restart(self):
        """The same with a new near side; DriverError."""
        self.near.arm.close()
        self.near.sensor.close()
        self._enter()
        self._released()
        state = bring_up(self.near.arm, self.near.sensor, TARE)
        self._settle()
        return self.near.gripper.holds(state)

    def _attend(self, _cycle, course, _arm):
        self.cell.note(self.said.pop() if self.said else course.name, 1)

    def _released(self):
        self.cell.served.bench.arm.box.post(Button.EMERGENCY_RESET)
        return self.near.arm.recover()

    def _settle(self):
        """From here on a stop is owed for what happens from here on, and for what still lasts."""
        paid, served = len(events(self.cell.served)), self.cell.served

        def owing():
            numbered = enumerate(events(served))
            return [one for n, one in numbered if n >= paid or row(one.kind).lasting]

        self.sampler.faults = Owed(self._faults, load(), owing)

    def _enter(self):
        near = near_side(self.rig, self.cell.doors, self._driver.heard, PATIENCE)
        self.near = self._stack.enter_context(near)


@dataclass
class Opening:
    """Opens a workplace: a class that hypothesis makes has no fixtures."""

    rig: object

    def __call__(self, faults, stack):
        return Workplace(self.rig, faults, stack)


@pytest.fixture(scope="session")
def workplace():
    return Opening(shipped("ffc_short"))
