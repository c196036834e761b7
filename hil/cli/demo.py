"""The testbed in a minute: one assembly recorded and drawn, then the paper's whole experiment."""

from pathlib import Path

import typer

from hil.app.run import Request
from hil.app.train import Schedule
from hil.cli import campaign
from hil.cli.assembly import perform, report
from hil.cli.options import DEFAULT_RIG
from hil.cli.pictures import Photographer, clear, draw
from hil.cli.shipped import read
from hil.experiments.ffc.report import write
from hil.experiments.ffc.rows import rows
from hil.experiments.ffc.runs import plan, trainings
from hil.experiments.ffc.table import as_text

LEARNING_RIG = "ffc_learning"


def demo(out: Path, seed: int | None, learner: str, *, json: bool, overwrite: bool) -> int:
    """Run, record, draw, learn; the exit status is the assembly's."""
    rig, text = read(DEFAULT_RIG)
    request = Request(
        rig=rig.on_free_ports(),
        rig_text=text,
        seed=rig.seed if seed is None else seed,
        part=rig.first_part,
        out=out,
        overwrite=overwrite,
        alone=True,
    )
    camera = Photographer()
    if overwrite:
        clear(out)
    result = perform(request, camera.watch, json=json)
    lines = [*draw(out), camera.develop(DEFAULT_RIG, out / "scene.png")]
    if not json:
        typer.echo("\n".join(lines))
    status = report(result, out, json=json)
    if learner != "none":
        _learn(out / "learning", learner, request.seed, quiet=json)
    return status


def _learn(folder: Path, learner: str, seed: int, *, quiet: bool) -> None:
    """Section 4 of the paper at full length, on one cell."""
    schedule = Schedule()
    if not quiet:
        typer.echo(
            f"\nlearning ({learner}): FFC1 for 48 episodes, then FFC2, held otherwise, for 2; "
            "under a minute on an idle machine"
        )
    _, content = read(LEARNING_RIG)
    series = plan(content.decode(), (learner,), range(seed, seed + 1), schedule)
    outcomes = campaign.conduct(series, jobs=1, scheduler="", ledger=None, fresh=False, quiet=quiet)
    found = trainings(series, outcomes)
    paths = write(found, LEARNING_RIG, folder)
    if not quiet:
        typer.echo(as_text(rows(found)), nl=False)
        typer.echo("\n".join(map(str, paths)))
