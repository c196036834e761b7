"""Worlds by name: the paper's gridworld, four stand-ins for its cable task, and a fast cell.

K1, K2, K3 were fitted, out of 2,680 random worlds, to two rows of the paper's results (Q-learning
74/20/6 %, the proposed method 92/6/2 %) and its 20 steps; all else about them is invention. R1 was
fitted to nothing: a part that lags and slips and goes in at the right pose in 60 % only.
ffc is the shipped cell's task: its box, offsets and play, and a cable whose lag, mouth and hazards
were read off 9,700 random steps on the contact plant; `hil experiment fast-model` compares both.
"""

from collections.abc import Mapping
from difflib import get_close_matches

from learner.errors import UnknownWorldError
from learner.worlds.model import Ends, Model


def models() -> Mapping[str, Model]:
    """G0: Section 2 of the paper, 3,757 poses and one goal, nothing dangerous."""
    return {
        "G0": Model((8, 8, 6), (4, 4, 5)),
        "K1": Model(
            (5, 5, 3), (4, 2, 3), (2, 1, 0),
            hazard=0.0005, edge_hazard=0.002, jam_hazard=0.002, slip=0.02,
        ),
        "K2": Model(
            (4, 4, 5), (2, 2, 5), (2, 2, 1),
            hazard=0.0001, edge_hazard=0.002, jam_hazard=0.01, slip=0.05,
        ),
        "K3": Model(
            (4, 4, 4), (3, 3, 4), (1, 2, 1),
            hazard=0.00016, edge_hazard=0.01, jam_hazard=0.002, lag=(1.0, 1.0),
        ),
        "ffc": Model(
            (5, 5, 3), capture=(0.9, 0.95, 2.2), lag=(0.7, 1.8), friction_circle=True,
            caught=6.0, skew=0.3, ends=Ends(0.54, 1.5, 0.6, 1.05), wrenched=0.03,
            play=(4 / 3, 4 / 3, 0.5), whole_steps=False, first_grip_too=True,
            spread=(3.5, 3.5, 2.0), mirrored=False,
        ),
        "R1": Model(
            (5, 5, 4), (3, 3, 3), (1, 0, 1), insertion=0.6,
            hazard=0.0005, edge_hazard=0.005, jam_hazard=0.005, lag=(1.0, 1.0), slip=0.05,
        ),
    }  # fmt: skip


def model(name: str) -> Model:
    """The world of this name; UnknownWorldError when there is none."""
    known = models()
    if name in known:
        return known[name]
    near = get_close_matches(name, known, 1)
    hint = f"did you mean '{near[0]}'? " if near else ""
    raise UnknownWorldError(f"no world '{name}'; {hint}there are {', '.join(known)}")
