"""Rigs by name: a path as it stands, or one of those that came with the package."""

from difflib import get_close_matches
from importlib.resources import files
from importlib.resources.abc import Traversable
from pathlib import Path

from hil.cell.errors import RigError
from hil.cell.rig import Rig, parse

HOMES = ("hil_fixtures", "fixtures")
"""Where rigs lie: the installed name, and the folder's own name in a checkout."""


def read(name: str) -> tuple[Rig, bytes]:
    """The rig and its file's bytes; RigError when there is none or it is wrong."""
    source = find(name)
    try:
        content = source.read_bytes()
    except OSError as error:
        raise RigError(f"{name}: cannot be read: {error.strerror}") from None
    try:
        return parse(content.decode()), content
    except UnicodeDecodeError:
        raise RigError(f"{name}: is not UTF-8 text") from None
    except RigError as error:
        raise RigError(f"{name}: {error}") from None


def find(name: str) -> Traversable:
    """The file meant by a path or a shipped name; RigError lists what there is."""
    path = Path(name)
    if path.suffix in {".yaml", ".yml"} or (path.exists() and not path.is_dir()):
        return path
    rigs = shipped()
    if name in rigs:
        return rigs[name]
    near = get_close_matches(name, rigs, n=1)
    hint = f"did you mean '{near[0]}'? " if near else ""
    what = f"'{name}' is a folder, not a rig" if name and path.is_dir() else f"no rig '{name}'"
    raise RigError(f"{what}; {hint}shipped are: {', '.join(sorted(rigs)) or 'none'}")


def shipped() -> dict[str, Traversable]:
    """Shipped rig files by name."""
    for home in HOMES:
        try:
            folder = files(home) / "rigs"
        except ModuleNotFoundError:
            continue
        if folder.is_dir():
            entries = (entry for entry in folder.iterdir() if entry.name.endswith(".yaml"))
            return {entry.name.removesuffix(".yaml"): entry for entry in entries}
    return {}
