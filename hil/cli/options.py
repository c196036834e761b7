"""Options that more than one command has."""

from enum import StrEnum
from pathlib import Path
from typing import Annotated, TypeAlias

import typer


class Layout(StrEnum):
    INLINE = "inline"
    PROCESS = "process"


class Clock(StrEnum):
    LOCKSTEP = "lockstep"
    WALL = "wall"


class PolicyName(StrEnum):
    POSE = "pose"
    SPIRAL = "spiral"
    RANDOM = "random"
    ORACLE = "oracle"


RigName: TypeAlias = Annotated[
    str, typer.Argument(metavar="RIG", help="A rig file, or the name of a shipped rig.")
]
DEFAULT_RIG = "ffc_ur5"
RigOption: TypeAlias = Annotated[
    str, typer.Option(metavar="RIG", help="A rig file, or the name of a shipped rig.")
]
PartName: TypeAlias = Annotated[str, typer.Option(help="Which part of the fixture to assemble.")]
Json: TypeAlias = Annotated[bool, typer.Option("--json", help="Print one JSON object.")]
Seed: TypeAlias = Annotated[
    int | None, typer.Option(min=0, help="Seed of every random draw; the rig's unless given.")
]
Out: TypeAlias = Annotated[Path, typer.Option(help="Folder for what is written.")]
Overwrite: TypeAlias = Annotated[
    bool, typer.Option("--overwrite", help="Replace the run that the folder holds.")
]
PolicyOption: TypeAlias = Annotated[
    PolicyName, typer.Option(help="How the search chooses its next step.")
]
ClockOption: TypeAlias = Annotated[
    Clock | None,
    typer.Option(
        help="lockstep repeats to the byte, wall keeps real time; the rig's unless given."
    ),
]
