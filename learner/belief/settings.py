"""The numbers of the belief learner."""

from dataclasses import dataclass, field

from learner.belief.mouth import Mouth
from learner.belief.sides import Sides


@dataclass(frozen=True, slots=True)
class Belief:
    """What is assumed of the slot, of dangers and of the grip, and how far the plan looks.

    at_slot, beside_slot: chance an axis that the part goes in when the pose meets the slot, or is
    one step off; at_slot is only where the estimate begins. A wider kernel loses slots of one cell.
    clearance: steps by which a new grip may move the slot. drift: chance an axis of one step
    between episodes. floor: share of the belief that is spread over all poses in between, so that
    no pose is ever ruled out; new_grip_floor: the same at a grip change.
    gamma: discount a step. danger: cost of a danger against one insertion. base_hazard: of a step
    anywhere. sides: what the force tells, or None where it tells nothing.
    """

    at_slot: float = 0.95
    beside_slot: float = 0.3
    clearance: tuple[int, int, int] = (3, 3, 1)
    drift: float = 0.02
    floor: float = 1e-4
    new_grip_floor: float = 0.02
    gamma: float = 0.9
    danger: float = 3.0
    base_hazard: float = 1e-3
    sweeps: int = 12
    sides: Sides | None = None
    mouth: Mouth = field(default_factory=Mouth)

    def __post_init__(self) -> None:
        for name in ("at_slot", "beside_slot", "drift", "gamma", "base_hazard"):
            value = getattr(self, name)
            if not 0.0 <= value < 1.0:
                raise ValueError(f"{name} must be in [0, 1), found {value}")
        for name in ("floor", "new_grip_floor"):
            if not 0.0 < getattr(self, name) <= 1.0:
                raise ValueError(f"{name} must be in (0, 1], found {getattr(self, name)}")
        if self.at_slot == 0.0:
            raise ValueError("at_slot must be above 0: a part that never goes in has no slot")
        if min(self.clearance) < 0 or self.sweeps < 1 or not self.danger >= 0.0:
            raise ValueError(
                f"clearance and danger cannot be negative, sweeps must be 1 or more; found {self}"
            )
