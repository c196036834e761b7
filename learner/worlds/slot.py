"""A world of one slot in a box of poses, after a model's numbers."""

from math import hypot

import numpy as np

from controller.action import Action, Observation
from controller.outcome import Kind
from learner.grid import Cell, Grid
from learner.worlds.interface import Met
from learner.worlds.model import STEP, TURN, Ends, Model

_TELLS = 3
"""Steps from the slot, along every axis, within which forces may show the way."""

Offset = tuple[float, float, float]


class SlotWorld:
    """The jaws are where they are told; the part is behind them by lag, slip and grip."""

    def __init__(self, model: Model) -> None:
        self.model = model
        self.grid = Grid(model.halves, (STEP, STEP, TURN))
        self.max_steps = model.max_steps
        self._over = True

    def reset(self, rng: np.random.Generator) -> None:
        """A cell of its own and its first grip."""
        self._rng = rng
        signs = rng.choice((-1.0, 1.0), 3) if self.model.mirrored else np.ones(3)
        off = rng.uniform(-1.0, 1.0, 3) * self.model.spread
        self.slot: Offset = _offset(signs * self.model.slot + off)
        self._grip: Offset = (0.0, 0.0, 0.0)
        self._over = True
        if self.model.first_grip_too:
            self.regrip()

    def regrip(self) -> None:
        """A grip anew, drawn again until the slot can be met inside the box."""
        while True:
            grip = self._rng.uniform(-1.0, 1.0, 3) * self.model.play
            if self.model.whole_steps:
                grip = np.round(grip)
            if np.all(np.abs(np.subtract(self.slot, grip)) <= self.model.halves):
                break
        self._grip = _offset(grip)
        self._over = True

    def place(self, slot: Offset, grip: Offset = (0.0, 0.0, 0.0)) -> None:
        """Put slot and part where they are wanted, instead of what was drawn."""
        self.slot, self._grip = slot, grip
        self._over = True

    def begin(self) -> Observation:
        """At the box's middle, or anywhere in it, with nothing lagging or slipped.

        A part that goes in there ends the episode with its first step, which is not taken.
        """
        self.jaws = Cell(0, 0, 0)
        if self.model.random_start:
            self.jaws = self.grid.at(int(self._rng.integers(self.grid.states)))
        self._behind, self._slipped = [0.0, 0.0], [0.0, 0.0]
        self._caught = self._meets_mouth()
        self._rest = self.jaws
        self._fell_in = self._goes_in()
        self._steps, self._over = 0, False
        return self._seen()

    def step(self, action: Action) -> Met:
        if self._over:
            raise ValueError("the episode is over: begin another one")
        self._steps += 1
        ending = Kind.INSERTED if self._fell_in else self._happens(action)
        if ending is None and self._steps >= self.model.max_steps:
            ending = Kind.LIMIT
        self._over = ending is not None
        return Met(self._seen(), ending)

    @property
    def error(self) -> Offset:
        """From the slot to the tip."""
        x, y, turn = (
            jaws + grip - slot
            for jaws, grip, slot in zip(self.jaws, self._grip, self.slot, strict=True)
        )
        (bx, by), (sx, sy) = self._behind, self._slipped
        return x + bx + sx, y + by + sy, turn

    def _happens(self, action: Action) -> Kind | None:
        """Eq. 4's cases in their order: a danger on the way comes before the slot."""
        if self._caught:
            return self._slides(action)
        model, before = self.model, self.jaws
        overstrained, stopped = self._move(action)
        edge = stopped and self._chance(model.edge_hazard)
        if overstrained or edge or self._chance(model.hazard):
            return Kind.DANGER
        if self._chance(model.slip):
            self._slip()
        if self._goes_in():
            return Kind.INSERTED
        if self._meets_mouth():
            self._catch(before)
            return None
        mouth = _offset(np.add(model.capture, model.mouth))
        if self._within(mouth) and self._chance(model.jam_hazard):
            return Kind.DANGER
        return None

    def _goes_in(self) -> bool:
        return self._within(self.model.capture) and self._chance(self.model.insertion)

    def _catch(self, before: Cell) -> None:
        """The walls take the tip; the jaws give way to them, back to where they were if nearer."""
        self._caught, self._behind = True, [0.0, 0.0]
        aligned = self.slot[1] - self._grip[1]
        if abs(before.y - aligned) < abs(self.jaws.y - aligned):
            self.jaws = before
        self._rest = self.jaws

    def _slides(self, action: Action) -> Kind | None:
        """In the mouth: nothing but a step along x leads on, until the part is in line.

        The walls hold the part, not the jaws: these turn, and go along y until the next step.
        """
        before, line = abs(self.error[0]), self.model.capture[0]
        self.jaws = self.grid.moved(self._rest, action)
        if action.axis != 1:
            self._rest = self.jaws
        if action.axis != 0:
            return None
        after = abs(self.error[0])
        if min(before, after) <= line and self._chance(self.model.wrenched):
            return Kind.DANGER
        return Kind.INSERTED if after <= line and self._chance(self.model.insertion) else None

    def _move(self, action: Action) -> tuple[bool, bool]:
        """Whether the part was held and the jaws went too far, and whether the box's edge stopped
        the step.
        """
        before, held = self.jaws, self._held(action)
        self.jaws = self.grid.moved(before, action)
        stopped = self.jaws == before
        if action.axis < 2 and not stopped:
            self._behind[action.axis] -= action.sign
            if held:
                return abs(self._behind[0]) > held.strain, False
            self._drag()
        return False, stopped

    def _held(self, action: Action) -> Ends | None:
        """The ends of the slot, when one of them holds the part against this step."""
        ends = self.model.ends
        if ends is None or action.axis != 0:
            return None
        met = ends.meets(self.error, action.sign, self.model.capture[0])
        return ends if met and self._chance(ends.held) else None

    def _drag(self) -> None:
        """Friction lets the part lag no further than it can."""
        (bx, by), (lx, ly) = self._behind, self.model.lag
        if self.model.friction_circle:
            beyond = max(1.0, hypot(bx / lx, by / ly))
            self._behind = [bx / beyond, by / beyond]
        else:
            self._behind = [max(-lx, min(lx, bx)), max(-ly, min(ly, by))]

    def _slip(self) -> None:
        axis = int(self._rng.integers(2))
        if self.model.lag[axis] > 0.0:
            self._behind[axis] = 0.0
        elif self._slipped[axis]:
            self._slipped[axis] = 0.0
        else:
            self._slipped[axis] = float(self._rng.choice((-1.0, 1.0)))

    def _meets_mouth(self) -> bool:
        caught = self.model.caught
        return caught > 0 and self._within(_offset(np.add(self.model.capture, (caught, 0, 0))))

    def _within(self, halves: Offset) -> bool:
        x, y, turn = map(abs, self.error)
        # A whole step off by floating point is still a whole step.
        room = np.add(halves, 1e-9)
        return bool(x <= room[0] and y + self.model.skew * turn <= room[1] and turn <= room[2])

    def _chance(self, probability: float) -> bool:
        return probability > 0.0 and bool(self._rng.random() < probability)

    def _seen(self) -> Observation:
        """Eq. 1, the forces reduced to signs of 1 N and 1 N·m: no force law runs here."""
        fx, fy, tau = self._signs() if self.model.side != 0.5 else (0.0, 0.0, 0.0)
        x, y, turn = self.jaws
        return Observation(fx, fy, 5.0, tau, x * STEP, y * STEP, -self._depth, turn * TURN)

    @property
    def _depth(self) -> float:
        """Of a caught part, m: the nearer to the slot's middle, the deeper hangs its corner."""
        return 0.75e-3 - 0.02e-3 * abs(self.error[0]) if self._caught else 0.0

    def _signs(self) -> Offset:
        near = all(abs(error) <= _TELLS for error in self.error)
        right = self._rng.random(3) < (self.model.side if near else 0.5)
        return _offset(np.where(right, 1.0, -1.0) * np.where(np.array(self.error) > 0, -1.0, 1.0))


def _offset(values: "np.ndarray[tuple[int, ...], np.dtype[np.float64]]") -> Offset:
    x, y, turn = (float(value) for value in values)
    return x, y, turn
