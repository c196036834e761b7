"""Parameters of the laws by preset: a file of named sets, each with the command that made it."""

from collections.abc import Mapping
from difflib import get_close_matches
from importlib.resources import files
from pathlib import Path

import yaml

from controller.laws.build import Parameters, law_class, settings_of

TUNED = "tuned"


def shipped() -> tuple[str, ...]:
    """Names of the presets that came with the package."""
    entries = files(__package__).joinpath("presets").iterdir()
    return tuple(sorted(e.name.removesuffix(".yaml") for e in entries if e.name.endswith(".yaml")))


def preset(name: str) -> Mapping[str, Parameters]:
    """A shipped preset, or a YAML file of your own; ValueError says what there is."""
    if name in shipped():
        source = files(__package__).joinpath("presets", f"{name}.yaml")
        return _checked(name, source.read_text(encoding="utf-8"))
    if not name.endswith((".yaml", ".yml")):
        near = get_close_matches(name, shipped(), n=1)
        hint = f"did you mean '{near[0]}'? " if near else ""
        raise ValueError(f"no preset '{name}'; {hint}there are {', '.join(shipped())}, or a file")
    try:
        return _checked(name, Path(name).read_text(encoding="utf-8"))
    except (OSError, UnicodeDecodeError) as error:
        raise ValueError(f"{name}: cannot be read: {error}") from None


def parameters(name: str, law: str) -> Parameters:
    """A law's parameters in a preset; a law that the preset does not name keeps its defaults."""
    found = preset(name).get(law, {})
    settings_of(law, found)
    return found


def _checked(name: str, text: str) -> Mapping[str, Parameters]:
    try:
        content = yaml.safe_load(text)
    except yaml.YAMLError as error:
        raise ValueError(f"{name}: not YAML: {' '.join(str(error).split())}") from None
    if not isinstance(content, dict) or not all(isinstance(v, dict) for v in content.values()):
        raise ValueError(f"{name}: a preset is a mapping of laws to their parameters")
    for law in content:
        law_class(law)
    return content
