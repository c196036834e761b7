"""From a law's name and its parameters to a governed axis."""

from collections.abc import Mapping
from dataclasses import fields
from difflib import get_close_matches
from importlib import import_module
from typing import TypeAlias

from controller.laws.bounds import Bounds
from controller.laws.constant import Constant
from controller.laws.duan import Duan
from controller.laws.governor import Governor
from controller.laws.interface import ForceLaw
from controller.laws.paper_aic import PaperAic
from controller.laws.soft import Soft

Parameters: TypeAlias = Mapping[str, "float | bool | Parameters"]


def laws() -> dict[str, type]:
    """The laws that come with the controller, by name."""
    return {"constant": Constant, "duan": Duan, "paper": PaperAic, "soft": Soft}


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


def settings_of(name: str, parameters: Parameters) -> object:
    """The law's settings from named numbers, groups nested; ValueError for a name it lacks."""
    return _filled(name, _settings(law_class(name)), parameters)


def build(name: str, settings: object | None, bounds: Bounds, period: int) -> Governor:
    """A force-controlled axis under this law; the law's defaults for None. period: ns."""
    found = law_class(name)
    kind = _settings(found)
    settings = kind() if settings is None else settings
    if not isinstance(settings, kind):
        raise ValueError(f"the law {name!r} takes {kind.__name__}, found {type(settings).__name__}")
    law: ForceLaw = found(settings, bounds, period * 1e-9)
    return Governor(law, bounds, period)


def _filled(name: str, kind: type, parameters: Parameters) -> object:
    known = [field.name for field in fields(kind)]
    for parameter in parameters:
        if parameter not in known:
            close = get_close_matches(parameter, known, 1)
            hint = f"did you mean {close[0]!r}?" if close else f"it has {', '.join(known)}"
            raise ValueError(f"the law {name!r} has no parameter {parameter!r}; {hint}")
    made: object = kind(**{key: _value(name, kind, key, parameters[key]) for key in parameters})
    return made


def _value(name: str, kind: type, key: str, value: float | bool | Parameters) -> object:
    """A number as it is, a nested group as the settings it fills."""
    if not isinstance(value, Mapping):
        return value
    return _filled(name, type(getattr(kind(), key)), value)


def _settings(found: type) -> type:
    kind: type = getattr(found, "Settings")  # noqa: B009  unknown to the type `type`
    return kind
