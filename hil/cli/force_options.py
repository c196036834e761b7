"""Options of the force-tracking experiments, and the grid and rigs that they ask for."""

from enum import StrEnum
from typing import TYPE_CHECKING, Annotated, NamedTuple

import typer

if TYPE_CHECKING:
    from collections.abc import Mapping

    from hil.cell.rig import Rig
    from hil.experiments.force_tracking.grid import Grid


class Ground(StrEnum):
    SURFACE = "surface"
    CABLE = "cable"


LAWS = "constant,duan,paper,soft"
Laws = Annotated[
    list[str] | None,
    typer.Option("--law", help="constant, duan, paper, soft or package.module:Class; with commas."),
]
Stiffnesses = Annotated[
    str | None,
    typer.Option("--stiffness", help="k_e, N/mm; with commas: 1,3,10,30,100 unless given."),
]
Latencies = Annotated[str, typer.Option("--latency", help="Of both wires together, ms.")]
Rates = Annotated[str, typer.Option("--rate", help="Control rates, Hz: 125, 500 or both.")]
Force = Annotated[float, typer.Option(help="f_d, N.")]
TrackedForce = Annotated[
    float | None, typer.Option("--force", help="f_d, N; 10 unless given, on the cable 5.")
]
Approach = Annotated[
    float | None,
    typer.Option(
        help="Speed down to the surface, mm/s; 0.5 a newton of f_d unless given, 4 at most."
    ),
]
Push = Annotated[
    float | None,
    typer.Option(
        help="Fastest inward speed in contact, mm/s; 16 unless given, --approach with --bottoming."
    ),
]
Slide = Annotated[
    float | None,
    typer.Option(
        help="Speed along the surface, mm/s, 0 to hold still; 20 unless given, 0 with --bottoming."
    ),
]
Bottoming = Annotated[
    str,
    typer.Option(help="Push (N) and stiffness (N/mm) at which the surface turns stiff: 3,50."),
]
Preset = Annotated[
    str, typer.Option(help="Parameters of the laws: tuned, ordered, printed, or a file.")
]
On = Annotated[
    Ground, typer.Option(help="The curved surface, or the paper's cable on its connector.")
]
Workers = Annotated[int, typer.Option(min=1, help="Runs at a time.")]


class Contact(NamedTuple):
    """What is pressed on, as the options tell it."""

    ground: Ground
    stiffness: str
    bottoming: str = "0,50"


def contact_of(
    ground: Ground, stiffness: str | None, bottoming: str, rigs: "Mapping[int, tuple[Rig, str]]"
) -> Contact:
    """A cable has its own stiffness: the jaws' pad is the softest thing behind it."""
    if ground is Ground.SURFACE:
        return Contact(ground, stiffness or "1,3,10,30,100", bottoming)
    if stiffness is not None:
        raise typer.BadParameter("--stiffness is the surface's: a cable has its rig's own")
    rig, _ = next(iter(rigs.values()))
    return Contact(ground, f"{rig.pad.stiffness_z / 1e3:g}", bottoming)


def grid_of(
    law: list[str] | None,
    contact: Contact,
    latency: str,
    preset: str,
    motion: tuple[float | None, float | None, float | None, float | None],
) -> "Grid":
    from hil.experiments.force_tracking.grid import Grid, speeds  # noqa: PLC0415

    laws = tuple(name for entry in law or [LAWS] for name in entry.split(",") if name)
    limit = numbers("--bottoming", contact.bottoming)
    if len(limit) != 2:
        found = contact.bottoming
        raise typer.BadParameter(f"--bottoming takes a force and a stiffness, found '{found}'")
    cable = contact.ground is Ground.CABLE
    force, *chosen = motion
    if force is None:
        force = 5.0 if cable else 10.0
    try:
        return Grid(
            laws,
            numbers("--stiffness", contact.stiffness),
            numbers("--latency", latency),
            force,
            *speeds(force, cable or limit[0] > 0.0, *chosen),
            bottoming=(limit[0], limit[1]),
            preset=preset,
            cable=cable,
        )
    except (ValueError, TypeError) as error:
        raise typer.BadParameter(str(error)) from None


def rigs_of(rate: str, ground: Ground) -> "dict[int, tuple[Rig, str]]":
    """By control rate: the shipped rig and its text."""
    from hil.cli.shipped import read  # noqa: PLC0415
    from hil.experiments.force_tracking.grid import CABLE_RIGS, RIGS  # noqa: PLC0415

    names = CABLE_RIGS if ground is Ground.CABLE else RIGS
    rates = numbers("--rate", rate)
    for value in rates:
        if value not in names:
            raise typer.BadParameter(f"--rate: {value:g} Hz; there are 125 (UR5) and 500 (UR5e)")
    found = {int(value): read(names[int(value)]) for value in rates}
    return {number: (rig, content.decode()) for number, (rig, content) in found.items()}


def numbers(option: str, text: str) -> tuple[float, ...]:
    try:
        return tuple(float(part) for part in text.split(",") if part.strip())
    except ValueError:
        raise typer.BadParameter(f"{option} takes numbers with commas, found '{text}'") from None
