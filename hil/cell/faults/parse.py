"""Reads a schedule of faults: every mistake in it is one line that names key, value and remedy."""

from collections.abc import Mapping, Sequence
from difflib import get_close_matches
from math import isfinite
from pathlib import Path
from typing import Final

import yaml

from hil.cell.errors import FaultError
from hil.cell.faults.catalogue import row
from hil.cell.faults.row import UNITS, Parameter, Row, Value
from hil.cell.faults.schedule import Fault, Schedule
from hil.cell.faults.span import NOW, Span, span
from hil.cell.faults.trigger import AT_ONCE, trigger
from hil.cell.rig import quantity

_KEYS: Final = ("kind", "trigger", "cycles", "duration", "params")
_TOP: Final = ("faults", "pick")


def load(path: Path) -> Schedule:
    """The schedule in a YAML file; FaultError is one line."""
    try:
        text = path.read_text(encoding="utf-8")
    except (OSError, UnicodeDecodeError) as error:
        reason = getattr(error, "strerror", None) or "is not UTF-8 text"
        raise FaultError(f"{path}: cannot be read: {reason}") from None
    try:
        return parse(text)
    except FaultError as error:
        raise FaultError(f"{path}: {error}") from None


def parse(text: str) -> Schedule:
    """The schedule in a YAML text; FaultError says which key, what was found, what is allowed."""
    try:
        content = yaml.safe_load(text)
    except (yaml.YAMLError, ValueError) as error:
        raise FaultError(f"not YAML: {' '.join(str(error).split())}") from None
    except RecursionError:
        raise FaultError("not a schedule: it nests too deeply") from None
    return schedule(content)


def schedule(content: object) -> Schedule:
    """The schedule in parsed content: a mapping with `faults`, or a list of faults."""
    entries, pick = content, None
    if isinstance(content, Mapping):
        _only("", content, _TOP)
        entries, pick = content.get("faults"), content.get("pick")
    if not isinstance(entries, Sequence) or isinstance(entries, str) or not entries:
        raise FaultError(f"faults: a list of at least one fault is wanted, found {entries!r}")
    faults = tuple(fault(f"faults[{index}]", entry) for index, entry in enumerate(entries))
    if pick is not None and (type(pick) is not int or not 1 <= pick <= len(faults)):
        raise FaultError(f"pick: {pick!r} is not a whole number in 1 .. {len(faults)}")
    return Schedule(faults, pick)


def fault(key: str, content: object) -> Fault:
    """One fault; a bare text is its kind."""
    if isinstance(content, str):
        content = {"kind": content}
    if not isinstance(content, Mapping):
        raise FaultError(f"{key}: {content!r} is no fault; write kind, trigger, params")
    _only(f"{key}.", content, _KEYS)
    if not isinstance(content.get("kind"), str):
        raise FaultError(f"{key}.kind: {content.get('kind')!r} is not an id such as C1")
    try:
        known = row(content["kind"])
    except FaultError as error:
        raise FaultError(f"{key}.kind: {error}") from None
    begins = trigger(f"{key}.trigger", content.get("trigger", {}))
    if known.start and begins != AT_ONCE:
        raise FaultError(f"{key}.trigger: {known.id} {known.name} exists at power-up only")
    given = content.get("params", {})
    if not isinstance(given, Mapping):
        raise FaultError(f"{key}.params: {given!r} is not a mapping of names to values")
    return Fault(
        known.id, _parameters(f"{key}.params", known, given), begins, _duration(key, known, content)
    )


def _duration(key: str, known: Row, content: Mapping[str, object]) -> Span | None:
    given = [name for name in ("cycles", "duration") if name in content]
    if not given:
        return None
    if not known.lasting:
        raise FaultError(f"{key}.{given[0]}: {known.id} {known.name} happens in one moment")
    if len(given) > 1:
        raise FaultError(f"{key}: cycles and duration are two lengths; take one of them")
    found = span(f"{key}.{given[0]}", content[given[0]])
    if found == NOW:
        raise FaultError(f"{key}.{given[0]}: {content[given[0]]!r} is no time at all")
    if given[0] == "cycles" and found.ns:
        raise FaultError(f"{key}.cycles: {content['cycles']!r} is a time; write it as duration")
    return found


def _parameters(key: str, known: Row, given: Mapping[object, object]) -> dict[str, Value]:
    table = {parameter.name: parameter for parameter in known.parameters}
    found: dict[str, Value] = {}
    for name, value in given.items():
        parameter = table.get(str(name))
        if parameter is None:
            raise FaultError(f"{key}.{name}: {_unknown(known, str(name), list(table))}")
        found[parameter.name] = parameter_value(f"{key}.{name}", parameter, value)
    return found


def _unknown(known: Row, name: str, names: list[str]) -> str:
    if not names:
        return f"{known.id} {known.name} has no parameters"
    near = get_close_matches(name, names, n=1, cutoff=0.0)
    return f"{known.id} has no such parameter; did you mean '{near[0]}'?"


def parameter_value(key: str, parameter: Parameter, value: object) -> Value:
    """A value in SI or one of the words; FaultError says what was found and what is allowed."""
    if parameter.choices:
        if str(value) not in parameter.choices:
            near = get_close_matches(str(value), parameter.choices, n=1, cutoff=0.3)
            hint = f"; did you mean '{near[0]}'?" if near else ""
            raise FaultError(f"{key}: {value!r} is not one of {parameter.allowed}{hint}")
        return str(value)
    number = _number(key, parameter, value)
    whole = not parameter.whole or number == int(number)
    if not (whole and parameter.low <= number <= parameter.high):
        raise FaultError(f"{key}: {value!r} is out of range, allowed is {parameter.allowed}")
    return int(number) if parameter.whole else number


def _number(key: str, parameter: Parameter, value: object) -> float:
    if isinstance(value, int | float) and not isinstance(value, bool):
        bare = isfinite(value) and parameter.unit not in ("", "ppm")
        if bare and not (parameter.whole and parameter.unit == "B"):
            raise FaultError(f"{key}: {value!r} has no unit; write '{value} {parameter.unit}'")
        number = float(value)
    else:
        number = _quantity(key, parameter, value)
    if not isfinite(number):
        raise FaultError(f"{key}: {value!r} is not finite, allowed is {parameter.allowed}")
    return number


def _quantity(key: str, parameter: Parameter, value: object) -> float:
    if not parameter.unit:
        raise FaultError(f"{key}: {value!r} is not a number, allowed is {parameter.allowed}")
    unit = UNITS.get(parameter.unit, parameter.unit)
    try:
        return quantity.parse(value, unit)
    except ValueError as error:
        raise FaultError(f"{key}: {error}") from None


def _only(key: str, content: Mapping[object, object], allowed: tuple[str, ...]) -> None:
    for name in content:
        if name not in allowed:
            near = get_close_matches(str(name), allowed, n=1, cutoff=0.0)
            raise FaultError(f"{key}{name}: no such key; did you mean '{near[0]}'?")
