"""`hil campaign`: look into a ledger, and perform one of its runs again. What campaigns share."""

import os
import sys
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, TypeAlias

import typer

from hil.cli.errors import FAILED
from hil.cli.options import Json

if TYPE_CHECKING:
    from hil.campaign.plan import Plan
    from hil.campaign.run import Outcome

Seeds: TypeAlias = Annotated[int, typer.Option(min=1, help="How many runs, each of its own seed.")]
FirstSeed: TypeAlias = Annotated[int, typer.Option(min=0, help="Seed of the first run.")]
Jobs: TypeAlias = Annotated[
    int | None, typer.Option(min=1, help="Runs at once on this machine; a core each unless given.")
]
Scheduler: TypeAlias = Annotated[
    str, typer.Option(metavar="ADDRESS", help="Run on a dask scheduler's workers: tcp://host:port.")
]
LedgerFile: TypeAlias = Annotated[
    Path | None,
    typer.Option(metavar="FILE", help="Keep results here, and do not compute twice what it holds."),
]
Fresh: TypeAlias = Annotated[
    bool, typer.Option("--fresh/--resume", help="Compute again what the ledger holds.")
]
LedgerPath = Annotated[Path, typer.Argument(metavar="LEDGER", help="A campaign's ledger.")]


def build() -> typer.Typer:
    app = typer.Typer(
        help="Ledgers of experiments: what they hold, one run again.",
        no_args_is_help=True,
        rich_markup_mode=None,
    )
    app.command()(show)
    app.command()(rerun)
    return app


def conduct(
    plan: "Plan",
    *,
    jobs: int | None,
    scheduler: str,
    ledger: Path | None,
    fresh: bool,
    quiet: bool,
) -> "list[Outcome]":
    """Carry a plan out with the options that every experiment has; outcomes in its order."""
    from hil.campaign.campaign import Workers, carry_out  # noqa: PLC0415
    from hil.campaign.code import identity  # noqa: PLC0415
    from hil.campaign.ledger import opened  # noqa: PLC0415
    from hil.campaign.progress import CampaignProgress  # noqa: PLC0415

    workers, code = Workers(jobs or _cores(), scheduler), identity()
    with opened(ledger) as kept, CampaignProgress(len(plan.runs), quiet=quiet) as progress:
        if fresh:
            kept.forget(plan.runs, code)
        try:
            return carry_out(plan, kept, workers, code, progress.update)
        except KeyboardInterrupt:
            print(_left(progress.done, len(plan.runs), ledger), file=sys.stderr)
            raise


def show(ledger: LedgerPath, *, json: Json = False) -> None:
    """Count runs by verdict; name those that did not pass, and how to perform one again."""
    from hil.campaign.ledger import reading  # noqa: PLC0415
    from hil.campaign.summary import as_text, summarise  # noqa: PLC0415
    from hil.view import tables  # noqa: PLC0415

    with reading(ledger) as found:
        summary = summarise(found)
    typer.echo(tables.as_json(summary) if json else as_text(summary, ledger), nl=False)


def rerun(
    ledger: LedgerPath,
    run: Annotated[str, typer.Argument(metavar="RUN", help="A run's name, as `show` prints it.")],
    *,
    limit: Annotated[float, typer.Option(min=0.001, help="Wall seconds that it may take.")] = 600.0,
    json: Json = False,
) -> int:
    """Perform one run of a ledger again, with today's code; exit status 1 unless it passes."""
    from hil.campaign.campaign import again  # noqa: PLC0415
    from hil.campaign.ledger import reading  # noqa: PLC0415
    from hil.campaign.run import Verdict  # noqa: PLC0415
    from hil.campaign.summary import of_outcome  # noqa: PLC0415
    from hil.view import tables  # noqa: PLC0415

    with reading(ledger) as found:
        chosen = found.named(run)
    outcome = again(chosen, limit)
    typer.echo(tables.as_json(outcome) if json else of_outcome(chosen, outcome), nl=False)
    return 0 if outcome.verdict is Verdict.PASSED else FAILED


def _cores() -> int:

    return len(os.sched_getaffinity(0))


def _left(done: int, total: int, ledger: Path | None) -> str:
    if ledger is None:
        return f"hil: {done} of {total} runs were done; with --ledger FILE they would be kept"
    return f"hil: {done} of {total} runs are in {ledger}; the same command goes on from there"
