"""Words in which a channel describes its messages as JSON Schema, so that other tools plot them."""

from collections.abc import Mapping, Sequence
from typing import TypeAlias

Schema: TypeAlias = Mapping[str, object]
Fields: TypeAlias = dict[str, object]

AXES6 = ("x", "y", "z", "rx", "ry", "rz")
WRENCH_AXES = ("fx", "fy", "fz", "tx", "ty", "tz")
STAGE_AXES = ("x", "y", "z", "theta")


def message(title: str, **properties: Schema) -> Schema:
    return {"title": title, "type": "object", "properties": properties}


def number(description: str) -> Schema:
    return {"type": "number", "description": description}


def integer(description: str) -> Schema:
    return {"type": "integer", "description": description}


def text(description: str) -> Schema:
    return {"type": "string", "description": description}


def boolean(description: str) -> Schema:
    return {"type": "boolean", "description": description}


def array(items: Schema, description: str) -> Schema:
    return {"type": "array", "items": items, "description": description}


def axes(names: Sequence[str], description: str) -> Schema:
    """One number an axis, by name: a plot is then picked as `/ctrl.wrench.fz`."""
    properties = {name: {"type": "number"} for name in names}
    return {"type": "object", "properties": properties, "description": description}


def named(names: Sequence[str], values: Sequence[float]) -> dict[str, float]:
    return dict(zip(names, values, strict=True))


def rows(flat: Sequence[float], width: int) -> list[Sequence[float]]:
    """A flat row-major table cut into rows."""
    return [flat[at : at + width] for at in range(0, len(flat), width)]
