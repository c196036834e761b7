"""`hil experiment force-tracking` and `stability-map`: force laws on a curved surface."""

from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from hil.cli import campaign
from hil.cli.errors import FAILED
from hil.cli.options import Json

if TYPE_CHECKING:
    from hil.campaign.plan import Plan
    from hil.campaign.run import Outcome
    from hil.cell.rig import Rig
    from hil.experiments.force_tracking.grid import Grid

LAWS = "constant,duan,paper,soft"
Laws = Annotated[
    list[str] | None,
    typer.Option("--law", help="constant, duan, paper, soft or package.module:Class; with commas."),
]
Stiffnesses = Annotated[str, typer.Option("--stiffness", help="k_e, N/mm; with commas.")]
Latencies = Annotated[str, typer.Option("--latency", help="Of both wires together, ms.")]
Rates = Annotated[str, typer.Option("--rate", help="Control rates, Hz: 125, 500 or both.")]
Force = Annotated[float, typer.Option(help="f_d, N.")]
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
Preset = Annotated[str, typer.Option(help="Parameters of the laws: tuned, printed, or a file.")]
Workers = Annotated[int, typer.Option(min=1, help="Runs at a time.")]


def force_tracking(
    *,
    law: Laws = None,
    stiffness: Stiffnesses = "1,3,10,30,100",
    latency: Latencies = "6,10",
    rate: Rates = "125",
    force: Force = 10.0,
    approach: Approach = None,
    push: Push = None,
    slide: Slide = None,
    bottoming: Bottoming = "0,50",
    preset: Preset = "tuned",
    seeds: campaign.Seeds = 20,
    seed: campaign.FirstSeed = 1,
    jobs: campaign.Jobs = None,
    scheduler: campaign.Scheduler = "",
    ledger: campaign.LedgerFile = None,
    fresh: campaign.Fresh = False,
    out: Annotated[
        Path | None,
        typer.Option(help="Folder for rows.json, report.md, the figure and recordings."),
    ] = None,
    figure_stiffness: Annotated[float, typer.Option(help="k_e of the figure, N/mm.")] = 3.0,
    json: Json = False,
) -> int:
    """The paper's experiment on a curved surface, all laws, over the wire, by the true force."""
    from hil.cli.force_output import write  # noqa: PLC0415
    from hil.experiments.force_tracking import experiment  # noqa: PLC0415
    from hil.experiments.force_tracking.table import as_text  # noqa: PLC0415
    from hil.view import tables  # noqa: PLC0415

    grid = _grid(law, stiffness, latency, preset, (force, approach, push, slide), bottoming)
    texts = {number: text for number, (_, text) in _rigs(rate).items()}
    numbers = range(seed, seed + seeds)

    def conduct(plan: "Plan") -> "list[Outcome]":
        return campaign.conduct(
            plan, jobs=jobs, scheduler=scheduler, ledger=ledger, fresh=fresh, quiet=json
        )

    outcomes = conduct(experiment.plan(texts, grid, numbers, out))
    rows = experiment.table(list(texts), grid, numbers, outcomes)
    typer.echo(tables.as_json({"rows": rows}) if json else as_text(rows), nl=False)
    if out is not None:
        drawn = experiment.figure_plan(next(iter(texts.values())), grid, figure_stiffness, seed)
        courses = experiment.courses(grid, conduct(drawn))
        write(out, grid, rows, courses, figure_stiffness)
    return FAILED if any(outcome.verdict.broken for outcome in outcomes) else 0


def stability_map(
    *,
    law: Laws = None,
    rate: Rates = "125,500",
    force: Force = 10.0,
    preset: Preset = "tuned",
    seeds: Annotated[int, typer.Option(min=1, help="Runs a cell.")] = 3,
    seed: campaign.FirstSeed = 1,
    workers: Workers = 2,
    checks: Annotated[int, typer.Option(min=0, help="Cells checked over the wire.")] = 12,
    figure: Annotated[Path, typer.Option(help="The picture, a PNG.")] = Path("stability_map.png"),
    json: Json = False,
) -> int:
    """Stiffness against latency for each law and rate, without a wire; spot checks over it.

    Exit status 1 when a spot check disagrees.
    """
    from hil.experiments import stability_map as experiment  # noqa: PLC0415
    from hil.view import tables  # noqa: PLC0415

    grid = _grid(
        law, ",".join(map(str, experiment.STIFFNESSES)), ",".join(map(str, experiment.LATENCIES)),
        preset, (force, None, None, None), "0,50",
    )  # fmt: skip
    rigs = {number: rig for number, (rig, _) in _rigs(rate).items()}
    _writable(figure)
    cells = list(experiment.stability_map(rigs, grid, range(seed, seed + seeds), workers))
    experiment.draw(cells, figure)
    checked = list(experiment.spot_checks(rigs, grid, cells, seed, checks))
    agreeing = sum(check.agrees for check in checked)
    if json:
        typer.echo(tables.as_json({"cells": cells, "checks": checked}), nl=False)
    else:
        typer.echo(f"{len(cells)} cells in {figure}; over the wire {agreeing} of {checks} agree")
    return 0 if agreeing == len(checked) else FAILED


def _grid(
    law: list[str] | None,
    stiffness: str,
    latency: str,
    preset: str,
    motion: tuple[float, float | None, float | None, float | None],
    bottoming: str,
) -> "Grid":
    from hil.experiments.force_tracking.grid import Grid, speeds  # noqa: PLC0415

    laws = tuple(name for entry in law or [LAWS] for name in entry.split(",") if name)
    limit = _numbers("--bottoming", bottoming)
    if len(limit) != 2:
        raise typer.BadParameter(f"--bottoming takes a force and a stiffness, found '{bottoming}'")
    force, *chosen = motion
    try:
        return Grid(
            laws,
            _numbers("--stiffness", stiffness),
            _numbers("--latency", latency),
            force,
            *speeds(force, limit[0] > 0.0, *chosen),
            bottoming=(limit[0], limit[1]),
            preset=preset,
        )
    except (ValueError, TypeError) as error:
        raise typer.BadParameter(str(error)) from None


def _rigs(rate: str) -> "dict[int, tuple[Rig, str]]":
    """By control rate: the shipped rig and its text."""
    from hil.cli.shipped import read  # noqa: PLC0415
    from hil.experiments.force_tracking.grid import RIGS  # noqa: PLC0415

    rates = _numbers("--rate", rate)
    for value in rates:
        if value not in RIGS:
            raise typer.BadParameter(f"--rate: {value:g} Hz; there are 125 (UR5) and 500 (UR5e)")
    found = {int(value): read(RIGS[int(value)]) for value in rates}
    return {number: (rig, content.decode()) for number, (rig, content) in found.items()}


def _numbers(option: str, text: str) -> tuple[float, ...]:
    try:
        return tuple(float(part) for part in text.split(",") if part.strip())
    except ValueError:
        raise typer.BadParameter(f"{option} takes numbers with commas, found '{text}'") from None


def _writable(path: Path) -> None:
    if path.suffix != ".png" or not path.parent.is_dir():
        raise typer.BadParameter(f"--figure {path}: a .png in a folder that exists is needed")
