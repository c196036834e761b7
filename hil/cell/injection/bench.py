"""A bench whose injection looks at the situation before each period."""

from math import hypot

from hil.cell.bench import Bench, Parts
from hil.cell.faults.situation import Situation
from hil.cell.injection.injection import Injection
from hil.cell.plant.interface import Contact, PlantStep


class InjectedBench(Bench):
    """Contact and force are the plant's own: what triggers a fault is not what is measured."""

    def __init__(self, injection: Injection, parts: Parts) -> None:
        super().__init__(**parts)
        self.injection = injection

    def begin(self) -> None:
        """What is due comes into force before anything else happens in the period."""
        self.injection.before(self.situation)
        super().begin()

    def finish(self) -> PlantStep:
        step = super().finish()
        self.injection.after(self.t)
        return step

    @property
    def situation(self) -> Situation:
        """What triggers may look at; phase and episode are not the cell's to know."""
        box = self.arm.box
        return Situation(
            self.t,
            self.t // self.period,
            contact=self.truth.part.contact is not Contact.FREE,
            force=hypot(*box.measured.force[:3]),
            safety=box.modes.safety.name.lower(),
        )
