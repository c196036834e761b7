"""`hil experiment peg-in-hole`: learners compared on worlds without physics (Fig. 4)."""

from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from hil.cli import campaign
from hil.cli.errors import FAILED
from hil.cli.options import Json

if TYPE_CHECKING:
    from hil.experiments.peg_in_hole.contender import Contender

ALL = "ql,double-ql,wdql-alone,wdql,belief,search"


def peg_in_hole(
    *,
    learner: Annotated[
        str,
        typer.Option(
            help="With commas; also dql, ac, pg, ppo (extra `baselines`), shared-ql, shared-wdql, "
            "package.module:Class."
        ),
    ] = ALL,
    world: Annotated[
        str, typer.Option(help="G0, the paper's gridworld; K1, K2, K3, R1, ffc: stand-ins.")
    ] = "G0",
    agents: Annotated[
        str, typer.Option(metavar="N,...", help="Of wdql and the shared tables, each in turn.")
    ] = "1,2,4,6",
    seeds: campaign.Seeds = 20,
    seed: campaign.FirstSeed = 1,
    episodes: Annotated[int, typer.Option(min=1, help="With the first part.")] = 48,
    verify: Annotated[int, typer.Option(min=0, help="With the second one.")] = 2,
    out: Annotated[
        Path | None, typer.Option(help="Folder for report.html and Fig. 4 as a PNG.")
    ] = None,
    jobs: campaign.Jobs = None,
    scheduler: campaign.Scheduler = "",
    ledger: campaign.LedgerFile = None,
    fresh: campaign.Fresh = False,
    ablation: Annotated[
        bool, typer.Option("--ablation", help="Instead: wdql, each ingredient changed in turn.")
    ] = False,
    parameters: Annotated[
        Path | None,
        typer.Option(
            metavar="FILE", help="Also its learners with its parameters (`tune learner`)."
        ),
    ] = None,
    json: Json = False,
) -> int:
    """Learners on a gridworld: rates, steps and how often each beats wdql, over seeds."""
    from hil.experiments.ffc.rows import rows  # noqa: PLC0415
    from hil.experiments.ffc.table import as_text  # noqa: PLC0415
    from hil.experiments.peg_in_hole import contender as field  # noqa: PLC0415
    from hil.experiments.peg_in_hole.comparison import comparisons  # noqa: PLC0415
    from hil.experiments.peg_in_hole.runs import plan, trainings  # noqa: PLC0415
    from hil.view import tables  # noqa: PLC0415
    from learner.worlds.evaluate import Protocol  # noqa: PLC0415

    numbers = _numbers(agents)
    named = field.contenders(tuple(learner.split(",")), numbers)
    contenders = (field.ablation() if ablation else named) + _tuned(parameters)
    reference = "wdql n=6" if ablation else f"wdql n={max(numbers)}"
    series = plan(world, contenders, range(seed, seed + seeds), Protocol(episodes, verify))
    outcomes = campaign.conduct(
        series, jobs=jobs, scheduler=scheduler, ledger=ledger, fresh=fresh, quiet=json
    )
    found = trainings(series, outcomes)
    table = rows(found)
    against = comparisons(found, reference)
    shown = {"world": world, "rows": table, "comparisons": against}
    typer.echo(tables.as_json(shown) if json else as_text(table, paper=world != "G0"), nl=False)
    if out is not None:
        from hil.experiments.peg_in_hole.report import write  # noqa: PLC0415

        page = write(found, against, world, out)
        if not json:
            typer.echo(page)
    return FAILED if any(outcome.verdict.broken for outcome in outcomes) else 0


def _tuned(path: Path | None) -> "tuple[Contender, ...]":
    from hil.experiments.peg_in_hole.contender import tuned  # noqa: PLC0415
    from hil.experiments.peg_in_hole.parameter_file import load  # noqa: PLC0415

    return () if path is None else tuned(load(path))


def _numbers(text: str) -> tuple[int, ...]:
    words = text.split(",")
    if not all(word.strip().isdecimal() and int(word) > 0 for word in words):
        raise typer.BadParameter(
            f"'{text}': write numbers of 1 or more with commas, such as 1,2,4,6",
            param_hint="'--agents'",
        )
    return tuple(int(word) for word in words)
