"""`hil experiment faults` and `hil coverage`: single faults over a whole job."""

from pathlib import Path
from typing import Annotated

import typer

from hil.cli import campaign
from hil.cli.errors import FAILED
from hil.cli.options import DEFAULT_RIG, Json, RigOption

Runs = Annotated[int, typer.Option(min=1, help="How many runs, each with one random fault.")]
Each = Annotated[
    bool, typer.Option("--each", help="Every fault once in every phase instead, with its defaults.")
]

Page = Annotated[Path | None, typer.Option(help="Also write it as a Markdown page.")]


def experiment(
    *,
    rig: RigOption = DEFAULT_RIG,
    runs: Runs = 52,
    each: Each = False,
    seed: campaign.FirstSeed = 1,
    jobs: campaign.Jobs = None,
    scheduler: campaign.Scheduler = "",
    ledger: campaign.LedgerFile = None,
    fresh: campaign.Fresh = False,
    json: Json = False,
) -> int:
    """Assemblies under a single fault each, judged by F1 to F3; exit status 1 if one is unsafe."""
    from hil.cli.shipped import read  # noqa: PLC0415
    from hil.experiments.faults.experiment import each_plan, random_plan  # noqa: PLC0415
    from hil.experiments.faults.tally import as_text, tally  # noqa: PLC0415
    from hil.view import tables  # noqa: PLC0415

    _, content = read(rig)
    text = content.decode()
    plan = each_plan(text, seed) if each else random_plan(text, runs, seed)
    outcomes = campaign.conduct(
        plan, jobs=jobs, scheduler=scheduler, ledger=ledger, fresh=fresh, quiet=json
    )
    found = tally(plan, outcomes)
    typer.echo(tables.as_json(found) if json else as_text(found), nl=False)
    return 0 if found.safe else FAILED


def coverage(ledger: campaign.LedgerPath, *, page: Page = None, json: Json = False) -> None:
    """Which fault was active in which phase, from the ledger of `hil experiment faults`."""
    from hil.campaign.ledger import reading  # noqa: PLC0415
    from hil.experiments.faults.coverage import as_markdown, as_text  # noqa: PLC0415
    from hil.experiments.faults.coverage import coverage as covered  # noqa: PLC0415
    from hil.view import tables  # noqa: PLC0415

    if page is not None and not page.parent.is_dir():
        raise typer.BadParameter(f"no folder {page.parent}", param_hint="--page")
    with reading(ledger) as found:
        rows = covered(found.entries())
    if page is not None:
        page.write_text(as_markdown(rows, "hil experiment faults --each"), encoding="utf-8")
    typer.echo(tables.as_json(rows) if json else as_text(rows), nl=False)
