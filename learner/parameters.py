"""A learner's settings as flat parameters by dotted name, and back."""

from collections.abc import Mapping
from dataclasses import fields, is_dataclass, replace
from difflib import get_close_matches
from enum import Enum
from typing import TypeAlias, TypeVar

from learner.errors import LearnerParameterError

Value: TypeAlias = bool | int | float | str
Settings = TypeVar("Settings")


def parameters(settings: object) -> dict[str, Value]:
    """Every one that can be set, "tabular.psi" for a field of a part; choices by their word."""
    found: dict[str, Value] = {}
    for name, value in _fields(settings).items():
        if is_dataclass(value):
            found |= {f"{name}.{inner}": each for inner, each in parameters(value).items()}
        elif isinstance(value, Enum):
            found[name] = _word(value)
        elif isinstance(value, bool | int | float | str):
            found[name] = value
    return found


def with_parameters(settings: Settings, values: Mapping[str, Value]) -> Settings:
    """The settings with these parameters; LearnerParameterError for a name or value they refuse."""
    for name, value in values.items():
        if name not in parameters(settings):
            raise LearnerParameterError(_unknown(settings, name))
        settings = _with(settings, name, name, value)
    return settings


def _with(settings: Settings, path: str, name: str, value: Value) -> Settings:
    head, _, rest = path.partition(".")
    old = _fields(settings)[head]
    new = _with(old, rest, name, value) if rest else _like(old, name, value)
    try:
        return replace(settings, **{head: new})  # type: ignore[type-var]  # checked by _fields
    except ValueError as error:
        raise LearnerParameterError(f"parameter {name}: {error}") from None


def _like(old: object, name: str, value: Value) -> Value | Enum:
    """The value in the old one's type; a whole number does where a fraction is meant."""
    if isinstance(old, Enum):
        words = {_word(member): member for member in type(old)}
        if str(value) in words:
            return words[str(value)]
        raise LearnerParameterError(f"parameter {name} is one of {', '.join(words)}; found {value}")
    if isinstance(old, bool) is isinstance(value, bool):
        if isinstance(old, float) and isinstance(value, int | float):
            return float(value)
        if isinstance(value, type(old)):
            return value
    kind = "true or false" if isinstance(old, bool) else f"a number like {old}"
    raise LearnerParameterError(f"parameter {name} is {kind}; found {value!r}")


def _unknown(settings: object, name: str) -> str:
    known = parameters(settings)
    near = get_close_matches(name, known, 1)
    hint = f"did you mean '{near[0]}'? " if near else ""
    return f"no parameter '{name}'; {hint}there are {', '.join(known) or 'none'}"


def _fields(settings: object) -> dict[str, object]:
    if not is_dataclass(settings):
        return {}
    return {field.name: getattr(settings, field.name) for field in fields(settings)}


def _word(member: Enum) -> str:
    return member.value if isinstance(member.value, str) else member.name.lower()
