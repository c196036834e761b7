"""The rig file: one YAML that describes the cell; this is its schema and the way it is read."""

from difflib import get_close_matches
from pathlib import Path
from typing import Literal

import numpy as np
import yaml
from pydantic import Field, ValidationError, model_validator
from pydantic_core import ErrorDetails

from hil.cell.errors import RigError
from hil.cell.rig.parts import Cable, Connector, Fixture, Pad, Physics, Tool
from hil.cell.rig.randomisation import Axis, Randomisation
from hil.cell.rig.real import unnamed
from hil.cell.rig.robot import FREE_PORTS, Robot
from hil.cell.rig.section import Section
from hil.cell.rig.sensor import CanBus, Sensor
from hil.cell.rig.surface import Surface
from hil.cell.rig.task import Latency, Limits, Task


class Rig(Section):
    """Everything that distinguishes one cell from another; with a seed, one run."""

    name: str
    rig: Literal["emulated", "real"] = "emulated"
    """Whether the addresses are served by an emulated cell or are those of real devices."""
    seed: int = Field(default=1, ge=0)
    clock: Literal["lockstep", "wall"] = "lockstep"
    features: tuple[str, ...] = ()
    """What else a test may need of it (`@pytest.mark.needs`): words of the rig's owner."""
    robot: Robot = Robot()
    sensor: Sensor = Sensor()
    can: CanBus = CanBus()
    tool: Tool = Tool()
    cable: Cable = Cable()
    pad: Pad = Pad()
    connector: Connector = Connector()
    fixture: Fixture = Fixture()
    surface: Surface = Surface()
    physics: Physics = Physics()
    latency: Latency = Latency()
    limits: Limits = Limits()
    task: Task = Task()
    randomisation: Randomisation = Randomisation()

    def on_free_ports(self) -> "Rig":
        """The rig with every port 0: cells beside each other never meet. Real ones stay real."""
        if self.rig == "real":
            return self
        robot = self.robot.model_copy(update={"ports": FREE_PORTS})
        return self.model_copy(update={"robot": robot, "sensor": self.sensor.on_free_port()})

    @property
    def first_part(self) -> str:
        """The part that a run takes unless told otherwise; "" in a rig without parts."""
        return self.fixture.parts[0].name if self.fixture.parts else ""

    @model_validator(mode="after")
    def _consistent(self) -> "Rig":
        names = [part.name for part in self.fixture.parts]
        if len(names) != len(set(names)):
            raise ValueError(f"fixture.parts: names must differ, found {names}")
        misfit = _misfit(self) or (unnamed(self) if self.rig == "real" else "")
        if misfit:
            raise ValueError(misfit)
        for axis in self.randomisation.axes:
            bounds(self, axis)
        return self


def _misfit(rig: Rig) -> str:
    """Why the part cannot go into the slot as deep as the job wants; "" when it can."""
    if rig.cable.thickness >= rig.connector.height:
        return "connector.height must exceed cable.thickness, or nothing can enter"
    if rig.cable.width >= rig.connector.width:
        return "connector.width must exceed cable.width, or nothing can enter"
    if rig.task.goal_depth > rig.connector.depth:
        return "task.goal_depth lies below the slot's floor (connector.depth)"
    return ""


def load(path: Path) -> Rig:
    """The rig in a YAML file; RigError is one line: which key, what was found, what is allowed."""
    try:
        text = path.read_text(encoding="utf-8")
    except OSError as error:
        raise RigError(f"{path}: cannot be read: {error.strerror}") from None
    except UnicodeDecodeError:
        raise RigError(f"{path}: is not UTF-8 text") from None
    return _named(path, text)


def _named(path: Path, text: str) -> Rig:
    try:
        return parse(text)
    except RigError as error:
        raise RigError(f"{path}: {error}") from None


def parse(text: str) -> Rig:
    """The rig in a YAML text; raises RigError."""
    try:
        content = yaml.safe_load(text)
    except (yaml.YAMLError, ValueError) as error:  # ValueError: a date or number that is none
        raise RigError(f"not YAML: {' '.join(str(error).split())}") from None
    except RecursionError:
        raise RigError("not a rig file: its sections nest too deeply") from None
    if not isinstance(content, dict):
        raise RigError(f"a rig file is a mapping of sections, found {type(content).__name__}")
    try:
        return Rig.model_validate(content)
    except ValidationError as error:
        raise RigError("; ".join(_explain(entry) for entry in error.errors()[:5])) from None


def _explain(entry: ErrorDetails) -> str:
    """One validation error as `key: what was found, what is allowed`."""
    path = ".".join(str(step) for step in entry["loc"])
    if entry["type"] == "extra_forbidden":
        allowed = keys_at(entry["loc"][:-1])
        near = get_close_matches(str(entry["loc"][-1]), allowed, n=1, cutoff=0.0)
        hint = f"; did you mean '{near[0]}'?" if near else ""
        return f"{path}: no such key{hint}"
    message = entry["msg"].removeprefix("Value error, ")
    found = "" if entry["type"] == "missing" else f" (found {entry['input']!r})"
    return f"{path}: {message}{found}" if path else message


def bounds(rig: Rig, axis: Axis) -> tuple[float, float]:
    """An axis' two ends in SI; ValueError when its key or a value is not the rig's."""
    head, _, field = axis.key.partition(".")
    section = getattr(rig, head, None)
    if not isinstance(section, Section) or not isinstance(getattr(section, field, None), float):
        raise ValueError(f"randomisation: '{axis.key}' is not a number of this rig")
    low, high = (_in_si(type(section), axis.key, field, end) for end in (axis.low, axis.high))
    if low > high:
        raise ValueError(f"randomisation: {axis.key} goes from {axis.low} down to {axis.high}")
    return low, high


def _in_si(section: type[Section], key: str, field: str, end: str | float) -> float:
    try:
        return float(getattr(section.model_validate({field: end}), field))
    except ValidationError as error:
        reason = error.errors()[0]["msg"].removeprefix("Value error, ")
        raise ValueError(f"randomisation: {key}: {reason}") from None


def drawn(rig: Rig, rng: np.random.Generator) -> Rig:
    """The rig with every enabled axis drawn uniformly; RigError for a draw that fits nowhere."""
    for axis in rig.randomisation.axes if rig.randomisation.enabled else ():
        head, _, field = axis.key.partition(".")
        value = float(rng.uniform(*bounds(rig, axis)))
        section = getattr(rig, head).model_copy(update={field: value})
        rig = rig.model_copy(update={head: section})
    misfit = _misfit(rig)
    if misfit:
        raise RigError(f"randomisation drew a cell that cannot be built: {misfit}")
    return rig


def keys_at(loc: tuple[int | str, ...]) -> list[str]:
    """The keys that a rig file allows at a place, [] where it allows none."""
    section: type[Section] | None = Rig
    for step in loc:
        if isinstance(step, int) or section is None:
            continue
        field = section.model_fields.get(step)
        section = _section_in(field.annotation) if field else None
    return list(section.model_fields) if section else []


def _section_in(annotation: object) -> type[Section] | None:
    """The section that an annotation is, or holds as tuple[Part, ...]."""
    candidates = (annotation, *getattr(annotation, "__args__", ()))
    return next((c for c in candidates if isinstance(c, type) and issubclass(c, Section)), None)
