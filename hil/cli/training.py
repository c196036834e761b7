"""`hil train` and `hil policy show`: one learner on one cell, and what it has learnt."""

from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from hil.cli.cell import DryRun, FaultsOption
from hil.cli.errors import FAILED
from hil.cli.options import Json, Overwrite, RigName, Seed

if TYPE_CHECKING:
    from collections.abc import Sequence

    from hil.app.sessions import Training
    from hil.app.train import EpisodeResult
    from hil.cell.faults.log import FaultEvent

PolicyFile = Annotated[Path, typer.Argument(metavar="FILE", help="A checkpoint of `hil train`.")]


def train(
    rig: RigName = "ffc_learning",
    *,
    learner: Annotated[
        str, typer.Option(help="Its name, or package.module:Class of your own.")
    ] = "belief",
    seed: Seed = None,
    episodes: Annotated[int, typer.Option(min=1, help="With the first part.")] = 48,
    verify: Annotated[int, typer.Option(min=0, help="With the second one.")] = 2,
    every: Annotated[
        int, typer.Option(min=1, help="Episodes between two checkpoints; 1 on a real rig.")
    ] = 8,
    out: Annotated[Path, typer.Option(help="The checkpoint.")] = Path("out/learner.hil"),
    resume: Annotated[
        bool, typer.Option("--resume", help="Go on from the checkpoint, if there is one.")
    ] = False,
    overwrite: Overwrite = False,
    dry_run: DryRun = False,
    faults: FaultsOption = None,
    json: Json = False,
) -> int:
    """Train a learner on a rig, emulated or real, and keep it; the checkpoint's SHA-256 is last.

    Killed in the middle, the same command with --resume ends in the same checkpoint, to the bit.
    Faults are armed anew in each session of --every episodes; one never active is exit status 1.
    """
    from hil.app.sessions import train as conduct  # noqa: PLC0415
    from hil.view.tables import as_json, of_facts  # noqa: PLC0415
    from learner.checkpoint import read as load  # noqa: PLC0415

    training = _asked(rig, learner, seed, (episodes, verify), every)
    if faults is not None:
        training = _under(training, faults)
    intent = _intent(training, out)
    if dry_run:
        typer.echo(as_json(intent) if json else of_facts(intent), nl=False)
        return 0
    if training.real and not json:
        typer.echo(of_facts(intent), nl=False)
    _room(out, resume=resume, overwrite=overwrite)
    results: list[EpisodeResult] = []
    told: list[FaultEvent] = []

    def tell(events: "Sequence[FaultEvent]") -> None:
        told.extend(events)
        if not json:
            typer.echo("".join(f"{event.t * 1e-9:9.3f} s  {event}\n" for event in events), nl=False)

    for result in conduct(training, out, lambda *_: None, resume=resume, tell=tell):
        results.append(result)
        if not json:
            typer.echo(_line(result))
    _finish(out, load(out).episodes, results, told, json=json)
    return _proven(told)


def show(
    file: PolicyFile,
    *,
    out: Annotated[Path | None, typer.Option(help="The picture; FILE.png unless given.")] = None,
    json: Json = False,
) -> None:
    """Say whose checkpoint it is and draw its policy: the worth of poses, as in Fig. 12."""
    from hil.experiments.ffc.policy import draw, facts  # noqa: PLC0415
    from hil.view.tables import as_json, of_facts  # noqa: PLC0415
    from learner.checkpoint import read  # noqa: PLC0415

    found = read(file)
    shown = facts(found, file)
    picture = out or file.with_name(f"{file.name}.png")
    shown["picture"] = str(picture) if draw(found, file, picture) else "none: it knows no worth"
    typer.echo(as_json(shown) if json else of_facts(shown), nl=False)


def build() -> typer.Typer:
    app = typer.Typer(
        help="What a learner has learnt.", no_args_is_help=True, rich_markup_mode=None
    )
    app.callback()(_policy)
    app.command()(show)
    return app


def _policy() -> None:
    """What a learner has learnt."""


def _asked(
    name: str, learner: str, seed: int | None, counts: tuple[int, int], every: int
) -> "Training":
    from hil.app.sessions import Training  # noqa: PLC0415
    from hil.app.train import Schedule  # noqa: PLC0415
    from hil.cell.errors import RigError  # noqa: PLC0415
    from hil.cli.shipped import read  # noqa: PLC0415
    from learner.build import maker  # noqa: PLC0415

    found, text = read(name)
    maker(learner)
    parts = [part.name for part in found.fixture.parts]
    if len(parts) < 1 + (counts[1] > 0):
        raise RigError(f"{name}: {len(parts)} parts; verification wants two, or --verify 0")
    wanted = tuple((part, count) for part, count in zip(parts, counts, strict=False) if count)
    rig = found if found.rig == "real" else found.on_free_ports()
    return Training(
        rig, text, learner, found.seed if seed is None else seed, Schedule(wanted), every
    )


def _under(training: "Training", file: Path) -> "Training":
    """The training with the faults in a file; FaultError for one that it has no place for."""
    from dataclasses import replace  # noqa: PLC0415

    from hil.app.sessions import faults_of, learner_of  # noqa: PLC0415
    from hil.cell.errors import FaultError  # noqa: PLC0415
    from hil.cell.faults.parse import load  # noqa: PLC0415

    broken = replace(training, faults=load(file))
    try:
        faults_of(broken, learner_of(broken))
    except FaultError as error:
        raise FaultError(f"{file}: {error}") from None
    return broken


def _proven(told: "list[FaultEvent]") -> int:
    """Exit status: a fault that was armed and never active in any session proves nothing."""
    from hil.cell.faults.log import idle  # noqa: PLC0415

    if unfelt := idle(tuple(told)):
        kinds = ", ".join(kind for _, kind in unfelt)
        typer.echo(f"hil: vacuous: {kinds} armed but never active; nothing is proven", err=True)
    return FAILED if unfelt else 0


def _intent(training: "Training", out: Path) -> dict[str, str | int | float | None]:
    """What would be connected and done."""
    from hil.cli.options import Clock, Layout, PolicyName  # noqa: PLC0415
    from hil.cli.request import Choice, asked, plan_of  # noqa: PLC0415

    clock = Clock.WALL if training.real else Clock.LOCKSTEP
    choice = Choice(training.seed, Layout.INLINE, clock, PolicyName.POSE, None, rig_ports=False)
    facts = plan_of(asked(training.rig, training.text, choice))
    del facts["policy"], facts["part"]
    return facts | {
        "learner": training.learner,
        "parts": ", ".join(
            f"{count} episodes with {name}" for name, count in training.schedule.parts
        ),
        "search box": "x, y, theta up to {}, {}, {} steps off the nominal slot".format(
            *training.rig.task.search_cells
        ),
        "checkpoint": f"{out}, {training.checkpoints} times",
    }


def _room(out: Path, *, resume: bool, overwrite: bool) -> None:
    if out.exists() and not (resume or overwrite):
        raise typer.BadParameter(
            f"{out} exists: --resume goes on from it, --overwrite begins anew", param_hint="--out"
        )
    out.parent.mkdir(parents=True, exist_ok=True)
    if overwrite and not resume:
        out.unlink(missing_ok=True)


def _line(result: "EpisodeResult") -> str:
    flag = f"  refused evaluations: {result.refused}" if result.refused else ""
    return (
        f"{result.number:3d}  {result.part}  {result.kind.value:8s}  {result.steps:3d} steps  "
        f"{result.seconds:5.1f} s{flag}"
    )


def _finish(
    out: Path,
    episodes: int,
    results: "list[EpisodeResult]",
    told: "list[FaultEvent]",
    *,
    json: bool,
) -> None:
    from hashlib import sha256  # noqa: PLC0415

    from hil.view.tables import as_json  # noqa: PLC0415

    digest = sha256(out.read_bytes()).hexdigest()
    if json:
        found = {"checkpoint": str(out), "episodes": episodes, "now": results, "sha256": digest}
        if told:
            found["faults"] = told
        typer.echo(as_json(found), nl=False)
    else:
        typer.echo(f"{out}, {episodes} episodes\nsha256 {digest}")
