"""`hil experiment ffc`: the paper's learning experiment through the whole cell."""

from typing import Annotated

import typer

from hil.cli import campaign
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
    json: Json = False,
) -> None:
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
    found = rows(trainings(series, outcomes))
    typer.echo(tables.as_json({"rows": found}) if json else as_text(found), nl=False)
