"""The FMEA file: what each fault does, how it is noticed, what is owed then and by when."""

from collections.abc import Mapping
from importlib.resources import files
from pathlib import Path
from typing import Literal

import yaml
from pydantic import BaseModel, ConfigDict, Field, ValidationError

from hil.cell.errors import FaultError
from hil.cell.faults.catalogue import CATALOGUE, row
from hil.cell.faults.schedule import Fault

Reaction = Literal["stop", "bounded", "ride", "blocked"]


class Entry(BaseModel):
    """One fault's line; see the head of the file for what the words mean."""

    model_config = ConfigDict(extra="forbid", frozen=True)

    effect: str
    detection: str
    reaction: Reaction
    when: Mapping[str, tuple[float, float] | tuple[str, ...]] = {}
    budget_ms: float = Field(ge=0)
    recovery_ms: float = Field(default=0.0, ge=0)
    back_when: Mapping[str, tuple[str, ...]] = {}
    requirement: str
    test: str

    def comes_back(self, fault: Fault) -> bool:
        """Whether the near side is brought up again once this very fault is over."""
        owed = self.reaction == "stop" and self.recovery_ms > 0.0
        return owed and _all_met(fault, self.back_when)

    def stops(self, fault: Fault) -> bool:
        """Whether this very fault has to stop the arm."""
        return self.reaction == "stop" and _all_met(fault, self.when)


def _all_met(fault: Fault, wanted: Mapping[str, tuple[float, float] | tuple[str, ...]]) -> bool:
    return all(_meets(fault.parameters[name], allowed) for name, allowed in wanted.items())


def _meets(value: float | str, allowed: tuple[float, float] | tuple[str, ...]) -> bool:
    if isinstance(value, str):
        return value in allowed
    low, high = (float(bound) for bound in allowed)
    return low <= value <= high


def load(path: Path | None = None) -> dict[str, Entry]:
    """The entries by id, every row of the catalogue once; FaultError is one line."""
    if path is None:
        text = files("hil_fixtures").joinpath("faults.yaml").read_text(encoding="utf-8")
        return parse(text, "faults.yaml")
    return parse(path.read_text(encoding="utf-8"), str(path))


def parse(text: str, name: str) -> dict[str, Entry]:
    """The entries in a YAML text; FaultError says which row lacks what."""
    content = yaml.safe_load(text)
    rows = content.get("faults") if isinstance(content, dict) else None
    if not isinstance(rows, dict):
        raise FaultError(f"{name}: no mapping 'faults' of ids to entries")
    found = {row(str(id)).id: _entry(name, str(id), entry) for id, entry in rows.items()}
    missing = [known.id for known in CATALOGUE if known.id not in found]
    if missing:
        raise FaultError(f"{name}: no entry for {', '.join(missing)}")
    return found


def _entry(name: str, id: str, content: object) -> Entry:
    try:
        entry = Entry.model_validate(content)
    except ValidationError as error:
        first = error.errors()[0]
        where = ".".join(map(str, first["loc"]))
        raise FaultError(f"{name}: {id}.{where}: {first['msg']}") from None
    known = {parameter.name for parameter in row(id).parameters}
    for key, conditions in (("when", entry.when), ("back_when", entry.back_when)):
        for parameter in conditions:
            if parameter not in known:
                raise FaultError(f"{name}: {id}.{key}.{parameter}: {id} has {sorted(known)}")
    return entry
