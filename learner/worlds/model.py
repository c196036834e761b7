"""The numbers of a world: everything the outcome of a step depends on, lengths in steps."""

from dataclasses import dataclass

import numpy as np

STEP = 0.3e-3
"""m, and rad below: the steps of Eq. 2, which the box counts in."""
TURN = 0.0174532925199433


@dataclass(frozen=True, slots=True)
class Model:
    """halves: of the search box. slot: where the tip meets it, from the box's middle. capture:
    half widths around it within which the part goes in; insertion: chance that it then does.

    mouth: how far beyond the capture the slot's mouth reaches, where a step is a danger with
    `jam_hazard`; `hazard` is that of a step anywhere, `edge_hazard` of one against the box's edge.

    lag: the tip stays behind the jaws by up to so much along x and along y (friction against the
    cable's bending). slip: chance a step that the part slips: a lagging tip springs back under the
    jaws, one that does not lag goes one step off or back.

    play: half widths within which a grip lies off its middle, by whole_steps only or by any
    amount; the first grip is at the middle unless first_grip_too. spread: half widths within
    which the slot is off `slot`, drawn once a cell; mirrored: its side of the start is drawn too.
    random_start: of each episode.

    caught: beyond the capture along x, within which the mouth takes the part with one corner and
    keeps it: only steps along x then lead on, and z shows it; 0 is no such mouth. skew: how much
    of the capture along y a step of theta takes. A step along x
    that has more than `strain` of the lag against it is a danger with `strained`; one away from the
    slot, from within a step of being in line, with `wrenched`.

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
    slip: float = 0.0
    play: tuple[float, float, float] = (8 / 3, 8 / 3, 0.0)
    whole_steps: bool = True
    first_grip_too: bool = False
    spread: tuple[float, float, float] = (0.0, 0.0, 0.0)
    mirrored: bool = True
    random_start: bool = False
    caught: float = 0.0
    skew: float = 0.0
    strain: float = 0.6
    strained: float = 0.0
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
            "strained",
            "wrenched",
        ):
            if not 0.0 <= getattr(self, name) <= 1.0:
                raise ValueError(f"{name} is a probability, found {getattr(self, name)}")
        for name in ("halves", "capture", "mouth", "play", "spread", "lag", "caught"):
            if not all(value >= 0 for value in np.atleast_1d(getattr(self, name))):
                raise ValueError(f"{name} cannot be negative, found {getattr(self, name)}")
        if self.max_steps < 1:
            raise ValueError(f"max_steps must be at least 1, found {self.max_steps}")
        slack = zip(self.halves, self.slot, self.spread, strict=True)
        if any(abs(slot) + spread > half for half, slot, spread in slack):
            raise ValueError(f"slot {self.slot} off by {self.spread} leaves the box {self.halves}")
