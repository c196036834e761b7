"""Functions by import path, `module:function`: how a campaign names what its workers call."""

from collections.abc import Callable
from difflib import get_close_matches
from importlib import import_module
from types import ModuleType

from hil.campaign.errors import CampaignError


def named(path: str) -> Callable[..., object]:
    """The function that `path` names; CampaignError when there is none."""
    module, colon, name = path.partition(":")
    if not (module and colon and name):
        raise CampaignError(f"'{path}' names no function; write module:function")
    found = getattr(_module(module, path), name, None)
    if not callable(found):
        raise CampaignError(f"'{path}': {_missing(_module(module, path), name)}")
    function: Callable[..., object] = found
    return function


def _module(name: str, path: str) -> ModuleType:
    try:
        return import_module(name)
    except ModuleNotFoundError as error:
        raise CampaignError(f"'{path}': there is no module '{error.name}'") from error


def _missing(module: ModuleType, name: str) -> str:
    own = [key for key, value in vars(module).items() if callable(value) and key[0] != "_"]
    near = get_close_matches(name, own, n=1)
    hint = f"; did you mean '{near[0]}'?" if near else ""
    return f"module '{module.__name__}' has no function '{name}'{hint}"
