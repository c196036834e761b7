"""`hil experiment ffc`: the paper's learning experiment through the whole cell."""

from pathlib import Path
from typing import Annotated

import typer

from hil.cli import campaign
from hil.cli.errors import FAILED
from hil.cli.options import Json, RigOption

Learners = Annotated[
    list[str] | None,
    typer.Option(
        "--learner",
        help="With commas: ql, double-ql, wdql-alone, wdql, belief, search; dql, ac, pg, ppo after "
        "`make baselines`; package.module:Class.",
    ),
]


def ffc(
    *,
    learner: Learners = None,
    rig: RigOption = "ffc_learning",
    seeds: campaign.Seeds = 5,
    seed: campaign.FirstSeed = 1,
    episodes: Annotated[int, typer.Option(min=1, help="With the first cable.")] = 48,
    verify: Annotated[int, typer.Option(min=0, help="With the second one.")] = 2,
    jobs: campaign.Jobs = None,
    scheduler: campaign.Scheduler = "",
    ledger: campaign.LedgerFile = None,
    fresh: campaign.Fresh = False,
    out: Annotated[
        Path | None, typer.Option(help="Folder for report.html and Figs. 9 to 12 as PNG.")
    ] = None,
    json: Json = False,
) -> int:
    """Train learners over the wire as in the paper's Section 4; a row of figures for each."""
    from hil.app.train import Schedule  # noqa: PLC0415
    from hil.cli.shipped import read  # noqa: PLC0415
    from hil.experiments.ffc.rows import rows  # noqa: PLC0415
    from hil.experiments.ffc.runs import plan, trainings  # noqa: PLC0415
    from hil.experiments.ffc.table import as_text  # noqa: PLC0415
    from hil.view import tables  # noqa: PLC0415

    _, content = read(rig)
    names = tuple(",".join(learner or ["wdql"]).split(","))
    parts = (("FFC1", episodes), *((("FFC2", verify),) if verify else ()))
    series = plan(content.decode(), names, range(seed, seed + seeds), Schedule(parts))
    outcomes = campaign.conduct(
        series, jobs=jobs, scheduler=scheduler, ledger=ledger, fresh=fresh, quiet=json
    )
    found = trainings(series, outcomes)
    shown = rows(found)
    typer.echo(tables.as_json({"rows": shown}) if json else as_text(shown), nl=False)
    if out is not None:
        from hil.experiments.ffc.report import write  # noqa: PLC0415

        paths = write(found, rig, out)
        if not json:
            typer.echo("\n".join(map(str, paths)))
    return FAILED if any(outcome.verdict.broken for outcome in outcomes) else 0


def fast_model(
    *,
    rig: RigOption = "ffc_learning",
    poses: Annotated[int, typer.Option(min=1, help="Random poses near the slot.")] = 500,
    steps: Annotated[
        int, typer.Option(min=1, help="Random steps from each; a dozen meet dangers too.")
    ] = 1,
    seed: campaign.FirstSeed = 1,
    jobs: campaign.Jobs = None,
    scheduler: campaign.Scheduler = "",
    ledger: campaign.LedgerFile = None,
    fresh: campaign.Fresh = False,
    json: Json = False,
) -> int:
    """Outcomes of the fast world `ffc` against the contact plant's, and its episodes a minute."""
    from hil.cli.shipped import read  # noqa: PLC0415
    from hil.experiments.fast_model import (  # noqa: PLC0415
        as_text,
        confusion,
        episodes_a_minute,
        plan,
        replanning,
    )
    from hil.view import tables  # noqa: PLC0415

    _, content = read(rig)
    series = plan(content.decode(), poses, steps, seed)
    outcomes = campaign.conduct(
        series, jobs=jobs, scheduler=scheduler, ledger=ledger, fresh=fresh, quiet=json
    )
    found = confusion(outcomes)
    speeds = {name: episodes_a_minute(name) for name in ("belief", "search", "wdql")}
    planning = replanning()
    shown = {"confusion": found, "episodes_a_minute": speeds, "replanning_s": planning}
    typer.echo(tables.as_json(shown) if json else as_text(found, speeds, planning), nl=False)
    return FAILED if any(outcome.verdict.broken for outcome in outcomes) else 0


def beside(
    *,
    rig: RigOption = "surface_ur5",
    seconds: Annotated[float, typer.Option(min=5.0, help="Wall seconds of each row.")] = 60.0,
    figure: Annotated[Path | None, typer.Option(help="Also draw both columns: a PNG.")] = None,
    json: Json = False,
) -> None:
    """A 125 Hz force loop by the wall clock: alone, beside n learning threads, beside a process."""
    from hil.cli.shipped import read  # noqa: PLC0415
    from hil.experiments.beside import COMPANY, as_text, draw, fifo_allowed, measure  # noqa: PLC0415
    from hil.view import tables  # noqa: PLC0415

    found, _ = read(rig)
    rows = [measure(found, company, seconds) for company in COMPANY]
    fifo = fifo_allowed()
    typer.echo(tables.as_json({"fifo": fifo, "rows": rows}) if json else as_text(rows), nl=False)
    if not (json or fifo):
        typer.echo(
            "without SCHED_FIFO, which this user may not have: other programs delay the loop"
        )
    if figure is not None:
        draw(rows, seconds, figure)
