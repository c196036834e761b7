"""What a row of the catalogue says: a fault's place, its numbers, and what a safe system does."""

from enum import StrEnum
from math import inf
from typing import Final, NamedTuple, TypeAlias

Value: TypeAlias = float | str
"""A parameter's value: SI number, or one of its words."""


UNITS: Final = {"B": "byte", "B/s": "byte/s"}
"""Units that are spelt otherwise in files."""


class Place(StrEnum):
    """Where a fault is injected."""

    RTDE = "RTDE link"
    ROBOT = "robot controller"
    BUS = "CAN bus"
    SENSOR = "force/torque sensor"
    GRIPPER = "gripper"
    PLANT = "plant"
    HOST = "controller's process"
    POLICY = "policy or learner"
    AGENTS = "parallel learner"


class Phase(StrEnum):
    """Where a job stands, as coverage counts it."""

    FREE = "free"
    APPROACH = "approach"
    CONTACT = "contact"
    SEARCH = "search"
    INSERT = "insert"
    RETRACT = "retract"


_OF_JOB: Final = {
    "approach": Phase.APPROACH,
    "lower": Phase.APPROACH,
    "contact": Phase.CONTACT,
    "track": Phase.CONTACT,
    "search": Phase.SEARCH,
    "insert": Phase.INSERT,
    "draw out": Phase.INSERT,
    "release": Phase.INSERT,
    "retract": Phase.RETRACT,
    "withdraw": Phase.RETRACT,
}


def phase_of(name: str) -> Phase:
    """The phase that a job's own name for it belongs to; every other one is in free air."""
    return _OF_JOB.get(name, Phase.FREE)


EVERYWHERE: Final = tuple(Phase)
TOUCHING: Final = (Phase.CONTACT, Phase.SEARCH, Phase.INSERT)
HOLDING: Final = (Phase.APPROACH, *TOUCHING)
"""Phases in which the jaws hold the part and may lose it."""


class Parameter(NamedTuple):
    """One number or word of a fault.

    unit: SI; "" for a plain number. low, high: allowed range. choices: allowed words, if it is one.
    """

    name: str
    default: Value
    unit: str = ""
    low: float = -inf
    high: float = inf
    choices: tuple[str, ...] = ()
    whole: bool = False

    @property
    def allowed(self) -> str:
        """The range or the words, for people."""
        if self.choices:
            return ", ".join(self.choices)
        unit = f" {self.unit}" if self.unit else ""
        kind = "whole numbers " if self.whole else ""
        if self.high == inf:
            return f"{kind}>= {self.low:g}{unit}" if self.low > -inf else f"any{unit}"
        return f"{kind}{self.low:g} .. {self.high:g}{unit}"


class Row(NamedTuple):
    """One fault that the testbed can inject.

    lasting: whether it goes on for a duration; else it happens in one moment.
    safe: what a safe system must do. proof: the observable that shows it. phases: where it makes
    sense. start: it only exists at power-up.
    """

    id: str
    name: str
    title: str
    place: Place
    parameters: tuple[Parameter, ...]
    safe: str
    proof: str
    phases: tuple[Phase, ...] = EVERYWHERE
    lasting: bool = True
    start: bool = False


def word(name: str, *choices: str) -> Parameter:
    """A parameter that is one of these words, the first one unless told otherwise."""
    return Parameter(name, choices[0], choices=choices)
