"""The signals of a run: what each is, and what counts as one unit of it."""

from collections.abc import Mapping
from typing import Final, NamedTuple


class Signal(NamedTuple):
    """scale: what robustness counts in, positive, in the signal's unit ("" is a plain number)."""

    name: str
    unit: str
    scale: float
    meaning: str


SIGNALS: Final = (
    Signal("t", "s", 1.0, "bench time at the period's end"),
    Signal("episode", "", 1.0, "number of the job, from 1; 0 before the first"),
    Signal("running", "", 1.0, "1 while the near side's control loop runs a job"),
    Signal("contact", "", 1.0, "1 while the part, or the tool, touches"),
    Signal("fx", "N", 0.1, "true push on the tool, task frame, mean of the last 8 ms"),
    Signal("fy", "N", 0.1, "likewise"),
    Signal("fz", "N", 0.1, "likewise; + when pressing"),
    Signal("tau_z", "N*m", 0.01, "likewise, about the tool's axis"),
    Signal("measured_fx", "N", 0.1, "the same as the near side last knew it"),
    Signal("measured_fy", "N", 0.1, "likewise"),
    Signal("measured_fz", "N", 0.1, "likewise"),
    Signal("measured_tau_z", "N*m", 0.01, "likewise"),
    Signal("force", "", 0.1, "largest true |f| / f_b of the four"),
    Signal("measured_force", "", 0.1, "largest measured |f| / f_b, 0 before the first"),
    Signal("sample_age", "s", 1e-3, "age of the sample that the near side last controlled on"),
    Signal("command_age", "s", 1e-2, "how old the state is that the applied command answers"),
    Signal("commands", "", 1.0, "set-points that the near side sent upon one package of the robot"),
    Signal("order", "", 1.0, "commands by which the one followed is newer than the last one"),
    Signal("servoing", "", 1.0, "1 while the robot is told to follow set-points and does"),
    Signal("stopping", "", 1.0, "1 from the near side's stop on, or while the robot cannot move"),
    Signal("step", "m", 1e-3, "way of the TCP target in this period"),
    Signal("turn", "rad", 1e-2, "turn of the tool's target in this period"),
    Signal("speed", "m/s", 1e-2, "true speed of the TCP"),
    Signal("turning", "rad/s", 1e-1, "true rate of turn of the TCP"),
    Signal("finite", "", 1.0, "1 while the near side sends finite set-points"),
    Signal("safe", "", 1.0, "1 while the robot's safety mode is normal or reduced"),
    Signal("fault", "", 1.0, "faults in force"),
    Signal("owed", "", 1.0, "1 while a fault is in force that has to stop the arm"),
    Signal("steps", "", 1.0, "search steps taken"),
)

NAMES: Final = tuple(signal.name for signal in SIGNALS)
SCALES: Final[Mapping[str, float]] = {signal.name: signal.scale for signal in SIGNALS}
