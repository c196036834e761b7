"""From a law's name and its parameters to a governed axis."""

from collections.abc import Mapping
from dataclasses import fields
from difflib import get_close_matches
from importlib import import_module
from typing import TypeAlias

from controller.laws.bounds import Bounds
from controller.laws.constant import Constant
from controller.laws.governor import Governor
from controller.laws.interface import ForceLaw

Parameter: TypeAlias = float | bool


def laws() -> dict[str, type]:
    """The laws that come with the controller, by name."""
    return {"constant": Constant}


def law_class(name: str) -> type:
    """A law by its name, or by import path (`package.module:Class`) for one of your own.

    Such a class has a dataclass `Settings` and is made from (settings, bounds, period in s).
    """
    known = laws()
    if name in known:
        return known[name]
    if ":" not in name:
        allowed = ", ".join(sorted(known))
        raise ValueError(f"no law is called {name!r}; there are {allowed}, or package.module:Class")
    module, _, attribute = name.partition(":")
    try:
        found: type = getattr(import_module(module), attribute)
    except (ImportError, AttributeError, ValueError) as error:
        raise ValueError(f"the law {name!r} cannot be imported: {error}") from error
    if not isinstance(getattr(found, "Settings", None), type):
        raise ValueError(f"the law {name!r} has no class attribute Settings (a dataclass)")
    return found


def settings_of(name: str, parameters: Mapping[str, Parameter]) -> object:
    """The law's settings from named numbers; ValueError for a name it does not have."""
    kind = _settings(law_class(name))
    names = [field.name for field in fields(kind)]
    for parameter in parameters:
        if parameter not in names:
            close = get_close_matches(parameter, names, 1)
            hint = f"did you mean {close[0]!r}?" if close else f"it has {', '.join(names)}"
            raise ValueError(f"the law {name!r} has no parameter {parameter!r}; {hint}")
    made: object = kind(**parameters)
    return made


def build(name: str, settings: object | None, bounds: Bounds, period: int) -> Governor:
    """A force-controlled axis under this law; the law's defaults for None. period: ns."""
    found = law_class(name)
    kind = _settings(found)
    settings = kind() if settings is None else settings
    if not isinstance(settings, kind):
        raise ValueError(f"the law {name!r} takes {kind.__name__}, found {type(settings).__name__}")
    law: ForceLaw = found(settings, bounds, period * 1e-9)
    return Governor(law, bounds, period)


def _settings(found: type) -> type:
    kind: type = getattr(found, "Settings")  # noqa: B009  unknown to the type `type`
    return kind
