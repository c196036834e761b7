"""`hil falsify` and `hil shrink`: the worst that faults do to a rig, and the least that does it."""

from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from hil.cli.errors import FAILED
from hil.cli.options import PolicyName, PolicyOption, RigName, Seed

if TYPE_CHECKING:
    from hil.falsify.space import Case
    from hil.falsify.trials import Attempt

Formula = Annotated[
    str, typer.Option(help="What must hold in every period; the always-on monitors unless given.")
]
Budget = Annotated[int, typer.Option(min=1, help="Runs at most.")]


def falsify(
    rig: RigName,
    faults: Annotated[
        str, typer.Option(help="Ids or names, comma between them; all that lie in the cell.")
    ] = "",
    at_once: Annotated[int, typer.Option(min=1, max=5, help="Faults in one run.")] = 1,
    budget: Budget = 100,
    seed: Seed = None,
    policy: PolicyOption = PolicyName.POSE,
    formula: Formula = "",
    out: Annotated[Path, typer.Option(help="File of the schedule found.")] = Path(
        "found.regression.yaml"
    ),
) -> int:
    """Search for the schedule of faults that comes nearest to a violation, or finds one.

    Exit status 1 when something is violated, 0 when nothing was found, 2 for bad input.
    """
    from hil.falsify.regression import Regression  # noqa: PLC0415

    try:
        from hil.falsify.trials import falsify as search  # noqa: PLC0415
    except ModuleNotFoundError as error:
        raise typer.BadParameter(f"{error}; install hil-testbed[tune]") from None

    attempt = _attempt(rig, seed, policy.value, formula)
    kinds = _kinds(faults)
    _writable(out)

    def tell(run: int, case: "Case", robustness: float) -> None:
        words = ", ".join(f"{part.kind} {dict(part.values)}" for part in case)
        typer.echo(f"run {run}: {robustness:+.3f}  {words}", err=True)

    sampler = attempt.seed
    worst = search(attempt, kinds, faults=at_once, budget=budget, seed=sampler, tell=tell)
    trial = attempt.run(worst.schedule)
    found = Regression(
        rig, attempt.seed, policy.value, worst.schedule, trial.reason, formula=formula
    )
    out.write_text(found.as_yaml(), encoding="utf-8")
    kind = "violated" if worst.violated else "nothing violated; the nearest"
    typer.echo(f"{kind}: robustness {worst.robustness:+.3f} in run {worst.runs} of {budget}")
    typer.echo(f"{trial.verdict.value}: {trial.reason}\n{out}")
    return FAILED if worst.violated else 0


def shrink(
    found: Annotated[
        Path, typer.Argument(metavar="FILE", help="A schedule that violates, as falsify writes it.")
    ],
    budget: Budget = 100,
    formula: Formula = "",
    out: Annotated[
        Path | None, typer.Option(help="File of the least schedule; FILE unless given.")
    ] = None,
) -> int:
    """Make a violating schedule as small as it goes, and say which parameters do not matter."""
    from hil.falsify.regression import Regression, load  # noqa: PLC0415
    from hil.falsify.trials import shrunk  # noqa: PLC0415

    given = load(found)
    formula = formula or given.formula
    attempt = _attempt(given.rig, given.seed, given.policy, formula)
    _writable(out or found)
    try:
        least = shrunk(
            attempt, given.schedule, budget=budget,
            tell=lambda run: typer.echo(f"run {run}", err=True),
        )  # fmt: skip
    except ValueError as error:
        raise typer.BadParameter(f"{found}: {error}") from None
    trial = attempt.run(least.schedule)
    kept = Regression(
        given.rig, given.seed, given.policy, least.schedule, trial.reason, least.any_value, formula
    )
    (out or found).write_text(kept.as_yaml(), encoding="utf-8")
    for fault in least.schedule.faults:
        typer.echo(str(fault))
    for name in least.any_value:
        typer.echo(f"{name}: does not matter")
    typer.echo(f"{trial.verdict.value}: {trial.reason}\n{out or found}")
    return 0


def again(path: Path, *, json: bool) -> int:
    """Run a kept schedule again; exit status 1 when it violates."""
    from hil.falsify.regression import load  # noqa: PLC0415
    from hil.view.tables import as_json  # noqa: PLC0415

    given = load(path)
    trial = _attempt(given.rig, given.seed, given.policy, "").run(given.schedule)
    violated = given.violated(trial)
    if json:
        words = {"verdict": trial.verdict.value, "reason": trial.reason, "sha256": trial.digest}
        words |= {"violated": violated}
        typer.echo(as_json(words), nl=False)
    else:
        for event in trial.events:
            typer.echo(f"{event.t * 1e-9:9.3f} s  {event}")
        typer.echo(f"{trial.verdict.value}: {trial.reason}\nsha256 {trial.digest}")
        typer.echo(f"violated: {violated}" if violated else "nothing violated")
    return FAILED if violated else 0


def _attempt(rig: str, seed: int | None, policy: str, formula: str) -> "Attempt":
    from hil.cli.shipped import read  # noqa: PLC0415
    from hil.falsify.trials import Attempt  # noqa: PLC0415
    from hil.monitors.errors import MonitorError  # noqa: PLC0415
    from hil.monitors.monitor import Monitor  # noqa: PLC0415
    from hil.trial.signals import SCALES  # noqa: PLC0415

    file, _ = read(rig)
    try:
        _ = formula and Monitor(formula, SCALES)
    except MonitorError as error:
        raise typer.BadParameter(str(error), param_hint="--formula") from None
    chosen = file.seed if seed is None else seed
    return Attempt(file.on_free_ports(), chosen, policy, formula)


def _kinds(text: str) -> list[str]:
    from hil.cell.errors import FaultError  # noqa: PLC0415
    from hil.cell.faults.catalogue import CATALOGUE, row  # noqa: PLC0415

    if text:
        try:
            return [row(word.strip()).id for word in text.split(",")]
        except FaultError as error:
            raise typer.BadParameter(str(error), param_hint="--faults") from None
    return [one.id for one in CATALOGUE if not one.start]


def _writable(path: Path) -> None:
    if not path.parent.is_dir():
        raise typer.BadParameter(f"the folder {path.parent} does not exist", param_hint="--out")
