"""`hil experiment force-tracking` and `stability-map`: force laws on a curved surface."""

from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from hil.cli import campaign
from hil.cli.errors import FAILED
from hil.cli.force_options import (
    Approach,
    Bottoming,
    Contact,
    Force,
    Ground,
    Latencies,
    Laws,
    On,
    Preset,
    Push,
    Rates,
    Slide,
    Stiffnesses,
    TrackedForce,
    Workers,
    contact_of,
    grid_of,
    rigs_of,
)
from hil.cli.options import Json

if TYPE_CHECKING:
    from hil.campaign.plan import Plan
    from hil.campaign.run import Outcome


def force_tracking(
    *,
    law: Laws = None,
    on: On = Ground.SURFACE,
    stiffness: Stiffnesses = None,
    latency: Latencies = "6,10",
    rate: Rates = "125",
    force: TrackedForce = None,
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
    figure_stiffness: Annotated[
        float, typer.Option(help="k_e of the figure, N/mm; of a surface.")
    ] = 3.0,
    json: Json = False,
) -> int:
    """The paper's experiment on a curved surface, all laws, over the wire, by the true force."""
    from hil.cli.force_output import write  # noqa: PLC0415
    from hil.experiments.force_tracking import experiment  # noqa: PLC0415
    from hil.experiments.force_tracking.table import as_text  # noqa: PLC0415
    from hil.view import tables  # noqa: PLC0415

    rigs = rigs_of(rate, on)
    contact = contact_of(on, stiffness, bottoming, rigs)
    grid = grid_of(law, contact, latency, preset, (force, approach, push, slide))
    texts = {number: text for number, (_, text) in rigs.items()}
    numbers = range(seed, seed + seeds)

    def conduct(plan: "Plan") -> "list[Outcome]":
        return campaign.conduct(
            plan, jobs=jobs, scheduler=scheduler, ledger=ledger, fresh=fresh, quiet=json
        )

    outcomes = conduct(experiment.plan(texts, grid, numbers, out))
    rows = experiment.table(list(texts), grid, numbers, outcomes)
    typer.echo(tables.as_json({"rows": rows}) if json else as_text(rows), nl=False)
    if out is not None:
        if grid.cable:
            figure_stiffness = grid.stiffnesses[0]
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

    grid = grid_of(
        law, Contact(Ground.SURFACE, ",".join(map(str, experiment.STIFFNESSES))),
        ",".join(map(str, experiment.LATENCIES)), preset, (force, None, None, None),
    )  # fmt: skip
    rigs = {number: rig for number, (rig, _) in rigs_of(rate, Ground.SURFACE).items()}
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


def _writable(path: Path) -> None:
    if path.suffix != ".png" or not path.parent.is_dir():
        raise typer.BadParameter(f"--figure {path}: a .png in a folder that exists is needed")
