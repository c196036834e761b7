"""`hil tune`: parameters found by search, for a rig, by a named objective."""

from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

if TYPE_CHECKING:
    from optuna.trial import FrozenTrial

Study = Annotated[
    str, typer.Argument(metavar="STUDY", help="A study file, or constant, duan or paper.")
]
LearnerStudy = Annotated[
    str, typer.Argument(metavar="STUDY", help="A study file, or wdql, belief or ql.")
]
Trials = Annotated[int, typer.Option(min=1, help="Of the whole search, resumed or not.")]
SamplerSeed = Annotated[int, typer.Option(min=0, help="Of the sampler.")]
Journal = Annotated[
    Path | None, typer.Option(help="Where trials are kept; a stopped search goes on from it.")
]


def build() -> typer.Typer:
    app = typer.Typer(
        help="Find parameters by search.", no_args_is_help=True, rich_markup_mode=None
    )
    app.callback()(_group)
    app.command()(force)
    app.command()(learner)
    return app


def _group() -> None:
    """Find parameters by search."""


def force(
    study: Study,
    *,
    trials: Trials = 200,
    seed: SamplerSeed = 1,
    journal: Journal = None,
    preset: Annotated[
        Path, typer.Option(help="Preset file that the best set is written to.")
    ] = Path("tuned.yaml"),
) -> None:
    """A force law's parameters by Optuna's TPE, judged without a wire (see the docs)."""
    from hil.cli.shipped import read  # noqa: PLC0415

    _needs_optuna()
    from hil.tuning.objective import purpose  # noqa: PLC0415
    from hil.tuning.preset_file import write  # noqa: PLC0415
    from hil.tuning.search import search  # noqa: PLC0415
    from hil.tuning.study_file import load  # noqa: PLC0415

    path = _study_path(study, "studies")
    found = load(path)
    where = journal or Path(f"{path.stem}.journal")
    _check_folders(preset, where)
    rig, _ = read(found.rig)
    best = search(purpose(found, rig), where, trials=trials, seed=seed, tell=_tell)
    write(preset, found, best, f"hil tune force {study} --trials {trials} --seed {seed}")
    typer.echo(f"trial {best.number}, cost {best.value:.3f}, in {preset}; trials in {where}")


def learner(
    study: LearnerStudy,
    *,
    trials: Trials = 60,
    seed: SamplerSeed = 1,
    journal: Journal = None,
    out: Annotated[
        Path, typer.Option(help="Written: the best set, for `experiment peg-in-hole --parameters`.")
    ] = Path("tuned_learner.yaml"),
    jobs: Annotated[
        int, typer.Option(min=1, help="Trainings at once; the trials do not depend on it.")
    ] = 1,
) -> None:
    """A learner's parameters by Optuna's TPE, judged over seeds on worlds without physics."""
    _needs_optuna()
    from hil.experiments.peg_in_hole.parameter_file import write  # noqa: PLC0415
    from hil.tuning.learner_study import LearnerStudy, opened, purpose  # noqa: PLC0415
    from hil.tuning.search import search  # noqa: PLC0415
    from hil.tuning.study_file import read  # noqa: PLC0415

    path = _study_path(study, "learners")
    found = read(path, LearnerStudy)
    where = journal or Path(f"{path.stem}.journal")
    _check_folders(out, where)
    with opened(jobs) as mapped:
        best = search(purpose(found, mapped), where, trials=trials, seed=seed, tell=_tell)
    command = f"hil tune learner {study} --trials {trials} --seed {seed}"
    write(out, found.learner, best.params, f"{command} (trial {best.number}, {best.value:.4g})")
    typer.echo(f"trial {best.number}, cost {best.value:.4g}, in {out}; trials in {where}")


def _needs_optuna() -> None:
    from importlib.util import find_spec  # noqa: PLC0415

    if find_spec("optuna") is None:
        raise typer.BadParameter("optuna is not installed; install hil-testbed[tune]")


def _check_folders(*files: Path) -> None:
    for file in files:
        if not file.parent.is_dir():
            raise typer.BadParameter(f"the folder {file.parent} does not exist")


def _tell(trial: "FrozenTrial") -> None:
    typer.echo(f"trial {trial.number}: {trial.value:.3f}", err=True)


def _study_path(name: str, folder: str) -> Path:
    from importlib.resources import files  # noqa: PLC0415

    shipped = Path(str(files("hil.tuning").joinpath(folder, f"{name}.yaml")))
    if name.endswith((".yaml", ".yml")):
        return Path(name)
    if shipped.exists():
        return shipped
    known = ", ".join(sorted(path.stem for path in shipped.parent.glob("*.yaml")))
    raise typer.BadParameter(f"no study '{name}'; shipped are {known}, or give a .yaml file")
