"""A rig as text: the file that would give it, every default written out with its unit."""

from typing import Annotated, get_args, get_origin

import orjson
import yaml

from hil.cell.rig import Rig, quantity
from hil.cell.rig.section import Section

UNITS = {
    get_args(kind)[1]: unit
    for kind, unit in (
        (quantity.Metres, "m"),
        (quantity.Radians, "rad"),
        (quantity.Seconds, "s"),
        (quantity.Newtons, "N"),
        (quantity.NewtonMetres, "N*m"),
        (quantity.Hertz, "Hz"),
        (quantity.Kilograms, "kg"),
        (quantity.Pascals, "Pa"),
        (quantity.MetresPerSecond, "m/s"),
        (quantity.RadiansPerSecond, "rad/s"),
        (quantity.NewtonsPerMetre, "N/m"),
        (quantity.NewtonMetresPerRadian, "N*m/rad"),
        (quantity.BitsPerSecond, "bit/s"),
    )
}
"""Unit by the validator that a quantity's type carries."""


def as_yaml(rig: Rig) -> str:
    """A rig file that parses to the same rig."""
    return yaml.safe_dump(_section(rig), sort_keys=False, allow_unicode=True)


def as_json(rig: Rig) -> str:
    """The same content as one JSON object; quantities are text with their unit."""
    return orjson.dumps(_section(rig), option=orjson.OPT_INDENT_2).decode() + "\n"


def _section(section: Section) -> dict[str, object]:
    return {
        name: _value(getattr(section, name), field.annotation, field.metadata)
        for name, field in type(section).model_fields.items()
    }


def _value(value: object, annotation: object, metadata: list[object]) -> object:
    """One key's value as a rig file writes it."""
    unit = next((UNITS[mark] for mark in metadata if mark in UNITS), None)
    if isinstance(value, Section):
        return _section(value)
    if isinstance(value, tuple):
        inner = get_args(annotation)
        kinds = [inner[0]] * len(value) if inner[-1:] == (Ellipsis,) else inner
        return [_element(item, kind) for item, kind in zip(value, kinds, strict=True)]
    return f"{value!r} {unit}" if unit else value


def _element(value: object, kind: object) -> object:
    if get_origin(kind) is Annotated:
        bare, *marks = get_args(kind)
        return _value(value, bare, marks)
    return _value(value, kind, [])
