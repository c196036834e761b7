"""`hil tune`: parameters found by search, for a rig, by a named objective."""

from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

if TYPE_CHECKING:
    from optuna.trial import FrozenTrial

Study = Annotated[
    str, typer.Argument(metavar="STUDY", help="A study file, or constant, duan or paper.")
]


def build() -> typer.Typer:
    app = typer.Typer(
        help="Find parameters by search.", no_args_is_help=True, rich_markup_mode=None
    )
    app.callback()(_group)
    app.command()(force)
    return app


def _group() -> None:
    """Find parameters by search."""


def force(
    study: Study,
    *,
    trials: Annotated[int, typer.Option(min=1, help="Of the whole search, resumed or not.")] = 200,
    seed: Annotated[int, typer.Option(min=0, help="Of the sampler.")] = 1,
    journal: Annotated[
        Path | None, typer.Option(help="Where trials are kept; a stopped search goes on from it.")
    ] = None,
    preset: Annotated[
        Path, typer.Option(help="Preset file that the best set is written to.")
    ] = Path("tuned.yaml"),
) -> None:
    """A force law's parameters by Optuna's TPE, judged without a wire (see the docs)."""
    from hil.cli.shipped import read  # noqa: PLC0415

    try:
        from hil.tuning.preset_file import write  # noqa: PLC0415
        from hil.tuning.search import search  # noqa: PLC0415
    except ModuleNotFoundError as error:
        raise typer.BadParameter(f"{error}; install hil-testbed[tune]") from None
    from hil.tuning.study_file import load  # noqa: PLC0415

    path = _study_path(study)
    found = load(path)
    for folder in (preset.parent, journal.parent if journal else preset.parent):
        if not folder.is_dir():
            raise typer.BadParameter(f"the folder {folder} does not exist")
    rig, _ = read(found.rig)
    where = journal or Path(f"{path.stem}.journal")
    best = search(found, rig, where, trials=trials, seed=seed, tell=_tell)
    write(preset, found, best, f"hil tune force {study} --trials {trials} --seed {seed}")
    typer.echo(f"trial {best.number}, cost {best.value:.3f}, in {preset}; trials in {where}")


def _tell(trial: "FrozenTrial") -> None:
    typer.echo(f"trial {trial.number}: {trial.value:.3f}", err=True)


def _study_path(name: str) -> Path:
    from importlib.resources import files  # noqa: PLC0415

    shipped = Path(str(files("hil.tuning").joinpath("studies", f"{name}.yaml")))
    if name.endswith((".yaml", ".yml")):
        return Path(name)
    if shipped.exists():
        return shipped
    known = ", ".join(sorted(path.stem for path in shipped.parent.glob("*.yaml")))
    raise typer.BadParameter(f"no study '{name}'; shipped are {known}, or give a .yaml file")
