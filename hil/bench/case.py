"""The cases that are measured: rate, physics step, in contact or in free air."""

from dataclasses import dataclass
from difflib import get_close_matches

from hil.cell.errors import RigError
from hil.cell.rig import Rig
from hil.cell.rig.robot import FREE_PORTS


@dataclass(frozen=True, slots=True)
class Case:
    """series: of the arm, which sets the control rate. step: of physics, s. clock: as in a rig."""

    name: str
    series: str
    step: float
    contact: bool
    clock: str = "lockstep"

    def rig(self, rig: Rig) -> Rig:
        """The rig with this case's rate, step and clock."""
        version = "3.15.8.106339" if self.series == "cb3" else "5.11.0.108249"
        robot = {"series": self.series, "version": version, "ports": FREE_PORTS}
        return rig.model_copy(
            update={
                "robot": rig.robot.model_copy(update=robot),
                "physics": rig.physics.model_copy(update={"step": self.step}),
                "clock": self.clock,
            }
        )


CASES = (
    Case("contact_125hz_0.5ms", "cb3", 0.5e-3, contact=True),
    Case("contact_125hz_1ms", "cb3", 1e-3, contact=True),
    Case("free_125hz_1ms", "cb3", 1e-3, contact=False),
    Case("contact_500hz_0.5ms", "e-series", 0.5e-3, contact=True),
)
"""What `hil bench` runs unless told otherwise."""

WALL_CASES = (
    Case("wall_125hz", "cb3", 0.5e-3, contact=True, clock="wall"),
    Case("wall_500hz", "e-series", 0.5e-3, contact=True, clock="wall"),
)
"""Paced by the wall clock: they last as long as they say, so only when asked for."""


def chosen(names: tuple[str, ...]) -> tuple[Case, ...]:
    """The cases of these names, the usual ones for none; RigError names the nearest."""
    known = {case.name: case for case in (*CASES, *WALL_CASES)}
    for name in names:
        if name not in known:
            near = get_close_matches(name, known, n=1, cutoff=0.0)[0]
            raise RigError(f"no case '{name}', did you mean '{near}'? Cases: {', '.join(known)}")
    return tuple(known[name] for name in names) or CASES
