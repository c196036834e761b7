"""`hil experiment`: the campaigns behind the numbers in the documentation."""

from pathlib import Path
from typing import Annotated

import typer

from hil.cli import campaign, envelope, faulty, force, learning, peg
from hil.cli.errors import FAILED
from hil.cli.options import DEFAULT_RIG, Json, PartName, PolicyName, PolicyOption, RigOption, Seed


def build() -> typer.Typer:
    app = typer.Typer(
        help="Repeat the documentation's experiments.", no_args_is_help=True, rich_markup_mode=None
    )
    app.command()(plant)
    app.command()(noise)
    app.command()(insertion)
    app.command()(learning.ffc)
    app.command()(learning.fast_model)
    app.command()(learning.beside)
    app.command()(peg.peg_in_hole)
    app.command()(force.force_tracking)
    app.command()(force.stability_map)
    app.command()(envelope.envelope)
    app.command()(envelope.law_cost)
    app.command("faults")(faulty.experiment)
    return app


def plant(*, rig: RigOption = DEFAULT_RIG, seed: Seed = None, json: Json = False) -> int:
    """Contact physics against closed forms; exit status 1 when a row fails."""
    from hil.cli.shipped import read  # noqa: PLC0415
    from hil.experiments.plant import run  # noqa: PLC0415
    from hil.view import tables  # noqa: PLC0415

    found, _ = read(rig)
    rows = run(found, found.seed if seed is None else seed)
    typer.echo(tables.of_rows(rows, json=json), nl=False)
    return 0 if all(row.passed for row in rows) else FAILED


def noise(
    *,
    rig: RigOption = DEFAULT_RIG,
    seed: Seed = None,
    figure: Annotated[
        Path | None, typer.Option(help="Also draw spectrum, Allan deviation and delays: a PNG.")
    ] = None,
    json: Json = False,
) -> int:
    """The emulated sensor's noise and delay against the rig; exit status 1 when a row fails."""
    from hil.cli.shipped import read  # noqa: PLC0415
    from hil.experiments.noise import rows  # noqa: PLC0415
    from hil.experiments.noise_report import measure  # noqa: PLC0415
    from hil.view import tables  # noqa: PLC0415

    found, _ = read(rig)
    report = measure(found, found.seed if seed is None else seed)
    shown = rows(report)
    typer.echo(tables.of_rows(shown, json=json), nl=False)
    if figure is not None:
        from hil.experiments.noise_figure import figure as draw  # noqa: PLC0415

        draw(report, figure)
    return 0 if all(row.passed for row in shown) else FAILED


def insertion(
    *,
    rig: RigOption = DEFAULT_RIG,
    seeds: campaign.Seeds = 20,
    seed: campaign.FirstSeed = 1,
    policy: PolicyOption = PolicyName.POSE,
    part: PartName = "FFC1",
    jobs: campaign.Jobs = None,
    scheduler: campaign.Scheduler = "",
    ledger: campaign.LedgerFile = None,
    fresh: campaign.Fresh = False,
    json: Json = False,
) -> int:
    """Success rate and steps of insertion over seeds; exit status 1 when a run broke."""
    from hil.cli.shipped import read  # noqa: PLC0415
    from hil.experiments.insertion import plan, rows, summary  # noqa: PLC0415
    from hil.view import tables  # noqa: PLC0415

    _, content = read(rig)
    series = plan(content.decode(), part, policy.value, range(seed, seed + seeds))
    outcomes = campaign.conduct(
        series, jobs=jobs, scheduler=scheduler, ledger=ledger, fresh=fresh, quiet=json
    )
    runs = rows(series, outcomes)
    typer.echo(tables.of_insertions(runs, summary(runs), json=json), nl=False)
    return FAILED if any(outcome.verdict.broken for outcome in outcomes) else 0
