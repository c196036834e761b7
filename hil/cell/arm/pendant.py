"""What the teach pendant holds and the dashboard steers: loaded files, roles, operational mode."""

from pathlib import Path, PurePosixPath
from typing import Final

UNNAMED: Final = "<unnamed>"
ROLES: Final = ("PROGRAMMER", "OPERATOR", "NONE", "LOCKED", "RESTRICTED")
FOLDERS: Final = ("/programs", "/ursim/programs")
"""Where a box and UR's simulator keep programs; clients may name them with or without it."""

DEFAULT_INSTALLATION: Final = "default.installation"


class Pendant:
    """program: name of the loaded program, UNNAMED for none; its script is `script`.

    operational_mode: MANUAL or AUTOMATIC while the dashboard sets it, else NONE.
    """

    __slots__ = ("_folder", "operational_mode", "program", "role", "script")

    def __init__(self, folder: Path | None) -> None:
        """folder: of the programs; a box without one has none."""
        self._folder = folder
        self.program = UNNAMED
        self.script: str | None = None
        self.role = "NONE"
        self.operational_mode = "NONE"

    def load(self, path: str) -> bool:
        """Load program `path`; false, and the old one stays, when there is no such file.

        Beside every program file, <name>.urp, PolyScope writes its code, <name>.script; that is
        what runs, and all that is needed here.
        """
        wanted = PurePosixPath(path)
        if self._folder is None or wanted.suffix != ".urp" or ".." in wanted.parts:
            return False
        file = self._folder / _inside(wanted).with_suffix(".script")
        if not file.is_file():
            return False
        self.script = file.read_text(encoding="utf-8")
        self.program = wanted.name
        return True


def _inside(path: PurePosixPath) -> PurePosixPath:
    """The path within the folder of programs."""
    for folder in FOLDERS:
        if path.is_relative_to(folder):
            return path.relative_to(folder)
    return path.relative_to(path.anchor)
