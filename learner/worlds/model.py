"""The numbers of a world: everything the outcome of a step depends on, lengths in steps."""

from dataclasses import dataclass

import numpy as np

STEP = 0.3e-3
"""m, and rad below: the steps of Eq. 2, which the box counts in."""
TURN = 0.0174532925199433


@dataclass(frozen=True, slots=True)
class Ends:
    """Both ends of the slot, where a chamfer holds a corner of the part that hangs over the mouth.

    corner: how far a step of theta moves a corner along y. mouth: half width along y within which
    it hangs over the slot. held: chance that a step along x, away from the slot's middle, then
    leaves the part where it is. strain: how far the jaws can get ahead before the force bound.
    """

    corner: float
    mouth: float
    held: float
    strain: float

    def __post_init__(self) -> None:
        if not 0.0 <= self.held <= 1.0:
            raise ValueError(f"held is a probability, found {self.held}")

    def meets(self, error: tuple[float, float, float], sign: int, reach: float) -> bool:
        """Whether a step along x pushes a corner against an end; reach: of the chamfer."""
        x, y, turn = error
        return 0.0 < sign * x <= reach and abs(y + sign * self.corner * turn) < self.mouth


@dataclass(frozen=True, slots=True)
class Model:
    """halves: of the search box. slot: where the tip meets it, from the box's middle. capture:
    half widths around it within which the part goes in; insertion: chance that it then does.

    mouth: how far beyond the capture the slot's mouth reaches, where a step is a danger with
    `jam_hazard`; `hazard` is that of a step anywhere, `edge_hazard` of one against the box's edge.

    lag: the tip stays behind the jaws by up to so much along x and along y (friction against the
    cable's bending); friction_circle: what it does along one leaves less for the other. slip:
    chance a step that the part slips: a lagging tip springs back under the jaws, one that does not
    lag goes one step off or back.

    play: half widths within which a grip lies off its middle, by whole_steps only or by any
    amount; the first grip is at the middle unless first_grip_too. spread: half widths within
    which the slot is off `slot`, drawn once a cell; mirrored: its side of the start is drawn too.
    random_start: of each episode.

    caught: beyond the capture along x, within which the mouth takes the part with one corner and
    keeps it: only steps along x then lead on, and z shows it; 0 is no such mouth. There one that
    comes into line or leaves it is a danger with `wrenched`. skew: how much of the capture along y
    a step of theta takes. ends: of the slot, None where they hold nothing.

    side: chance that the sign of fx, fy, tau_z shows the way to the slot, within 3 steps of it.
    """

    halves: tuple[int, int, int]
    slot: tuple[float, float, float] = (0.0, 0.0, 0.0)
    capture: tuple[float, float, float] = (0.0, 0.0, 0.0)
    insertion: float = 1.0
    mouth: tuple[float, float, float] = (2.0, 2.0, 2.0)
    jam_hazard: float = 0.0
    hazard: float = 0.0
    edge_hazard: float = 0.0
    lag: tuple[float, float] = (0.0, 0.0)
    friction_circle: bool = False
    slip: float = 0.0
    play: tuple[float, float, float] = (8 / 3, 8 / 3, 0.0)
    whole_steps: bool = True
    first_grip_too: bool = False
    spread: tuple[float, float, float] = (0.0, 0.0, 0.0)
    mirrored: bool = True
    random_start: bool = False
    caught: float = 0.0
    skew: float = 0.0
    ends: Ends | None = None
    wrenched: float = 0.0
    side: float = 0.5
    max_steps: int = 500

    def __post_init__(self) -> None:
        for name in (
            "insertion",
            "jam_hazard",
            "hazard",
            "edge_hazard",
            "slip",
            "side",
            "wrenched",
        ):
            if not 0.0 <= getattr(self, name) <= 1.0:
                raise ValueError(f"{name} is a probability, found {getattr(self, name)}")
        for name in ("halves", "capture", "mouth", "play", "spread", "lag", "caught"):
            if not all(value >= 0 for value in np.atleast_1d(getattr(self, name))):
                raise ValueError(f"{name} cannot be negative, found {getattr(self, name)}")
        if self.friction_circle and not all(self.lag):
            raise ValueError(f"friction_circle needs a lag along x and y, found {self.lag}")
        if self.max_steps < 1:
            raise ValueError(f"max_steps must be at least 1, found {self.max_steps}")
        slack = zip(self.halves, self.slot, self.spread, strict=True)
        if any(abs(slot) + spread > half for half, slot, spread in slack):
            raise ValueError(f"slot {self.slot} off by {self.spread} leaves the box {self.halves}")
