"""Any plant with parts, seen from a cell whose connector moved and whose jaws let go."""

from dataclasses import replace
from math import cos, hypot, sin
from typing import Final, NamedTuple, Protocol, TypeGuard

from hil.cell.faults.injector import Running
from hil.cell.injection.injection import Injection
from hil.cell.plant.grip import Jaws, Stage
from hil.cell.plant.interface import Plant, PlantStep, StageTarget

NS: Final = 1_000_000_000
TURN_RADIUS: Final = 0.01
"""m: a connector's half width; how far its ends go when it turns."""


class PlantWithJaws(Plant, Protocol):
    """A plant that grips parts."""

    jaws: Jaws


def has_jaws(plant: Plant) -> TypeGuard[PlantWithJaws]:
    return isinstance(getattr(plant, "jaws", None), Jaws)


class Shift(NamedTuple):
    """Where the connector truly stands off its place: m, m, rad about z, along the task's axes."""

    x: float = 0.0
    y: float = 0.0
    theta: float = 0.0

    def inwards(self, stage: Stage) -> Stage:
        """A stage of the believed frame in the true one."""
        x, y, c, s = stage[0] - self.x, stage[1] - self.y, cos(self.theta), sin(self.theta)
        return c * x + s * y, c * y - s * x, stage[2], stage[3] - self.theta

    def outwards(self, stage: Stage) -> Stage:
        """The way back."""
        x, y, c, s = stage[0], stage[1], cos(self.theta), sin(self.theta)
        return c * x - s * y + self.x, s * x + c * y + self.y, stage[2], stage[3] + self.theta

    def turned(self, v: Stage) -> Stage:
        """A velocity of the true frame in the believed one."""
        c, s = cos(self.theta), sin(self.theta)
        return c * v[0] - s * v[1], s * v[0] + c * v[1], v[2], v[3]

    def towards(self, goal: "Shift", way: float) -> "Shift":
        """Nearer to `goal` by at most `way`, m, turning included."""
        dx, dy, dtheta = goal.x - self.x, goal.y - self.y, goal.theta - self.theta
        far = hypot(dx, dy, TURN_RADIUS * dtheta)
        if far <= way:
            return goal
        part = way / far
        return Shift(self.x + part * dx, self.y + part * dy, self.theta + part * dtheta)


STRAIGHT: Final = Shift()


class InjectedPlant:
    """P1 moves the connector, not the parts' fixtures; G1 opens the jaws for one period."""

    def __init__(self, plant: PlantWithJaws, injection: Injection) -> None:
        self._plant, self._injection = plant, injection
        self._shift = STRAIGHT
        self._fixtures = {name: STRAIGHT.outwards(at) for name, at in plant.jaws.places.items()}
        self._held = False
        self._t = 0
        injection.add(self)

    def before(self, t: int) -> None:
        self._t = t

    def after(self, t: int) -> None:
        """Nothing: a plant is stepped."""

    def reset(self, stage: StageTarget) -> PlantStep:
        """Start at rest; a connector that is off from the start is off at once."""
        self._move_to(self._goal())
        return self._outside(self._plant.reset(self._inside(stage)))

    def step(self, target: StageTarget, duration: int) -> PlantStep:
        """Advance by `duration` ns."""
        speeds = [one.fault.number("speed") for one in self._injection.of("P1")]
        goal = self._goal()
        if goal != self._shift:
            self._move_to(self._shift.towards(goal, min(speeds, default=0.02) * duration / NS))
        if self._shift != STRAIGHT:
            for one in self._injection.of("P1"):
                one.felt(self._t, "the connector has moved")
        dropping = self._drops() if self._held else []
        if dropping:
            target = target._replace(jaws_closed=False)
        step = self._outside(self._plant.step(self._inside(target), duration))
        self._held = step.part.name is not None
        for one in dropping if not self._held else ():
            one.done(self._t, "part dropped")
        return step

    def _drops(self) -> list[Running]:
        return [one for one in self._injection.of("G1") if one.fault.word("what") == "drop"]

    def _goal(self) -> Shift:
        faults = [one.fault for one in self._injection.of("P1")]
        x, y, theta = (
            sum(fault.number(name) for fault in faults) for name in ("dx", "dy", "rotation")
        )
        return Shift(x, y, theta)

    def _move_to(self, shift: Shift) -> None:
        self._shift = shift
        places = self._plant.jaws.places
        places.update({name: shift.inwards(at) for name, at in self._fixtures.items()})

    def _inside(self, target: StageTarget) -> StageTarget:
        return StageTarget(*self._shift.inwards(target[:4]), target.jaws_closed)

    def _outside(self, step: PlantStep) -> PlantStep:
        if self._shift == STRAIGHT:
            return step
        stage, velocity = self._shift.outwards(step.stage), self._shift.turned(step.velocity)
        return replace(step, stage=stage, velocity=velocity)
