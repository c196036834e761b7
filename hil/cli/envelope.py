"""`hil experiment envelope`: random closed loops around the surface-observer tracker."""

from typing import Annotated

import typer

from hil.cli.errors import FAILED
from hil.cli.options import Json


def envelope(
    *,
    loops: Annotated[int, typer.Option(min=1, help="Loops of each family.")] = 2000,
    seed: Annotated[int, typer.Option(min=0, help="Of all draws.")] = 5,
    family: Annotated[
        list[str] | None, typer.Option(help="One family by name; again for more.")
    ] = None,
    json: Json = False,
) -> int:
    """Random plants, delays and forces: unstable loops and hardest blows, without a wire.

    Exit status 1 when a loop is unstable.
    """
    from hil.experiments.envelope import experiment  # noqa: PLC0415
    from hil.experiments.envelope.table import as_text  # noqa: PLC0415
    from hil.view import tables  # noqa: PLC0415

    try:
        families = experiment.select(family or [])
    except ValueError as error:
        raise typer.BadParameter(str(error)) from None
    results = []
    for result in experiment.envelope(loops, seed, families):
        results.append(result)
        typer.echo(as_text([result]).splitlines()[-1], err=True)
    typer.echo(tables.as_json({"families": results}) if json else as_text(results), nl=False)
    return FAILED if any(result.unstable for result in results) else 0


def law_cost(
    *,
    law: Annotated[
        list[str] | None,
        typer.Option(help="constant, duan, paper, soft or package.module:Class; again for more."),
    ] = None,
    json: Json = False,
) -> None:
    """Processor time of one governed update of each force law, median and 95th percentile."""
    from controller.laws.build import laws  # noqa: PLC0415
    from hil.experiments.envelope.cost import costs  # noqa: PLC0415
    from hil.view import tables  # noqa: PLC0415

    try:
        found = list(costs(law or sorted(laws())))
    except ValueError as error:
        raise typer.BadParameter(str(error)) from None
    if json:
        typer.echo(tables.as_json({"costs": found}), nl=False)
        return
    for cost in found:
        typer.echo(
            f"{cost.law:10} {cost.rate_hz:3d} Hz  median {cost.median_us:5.1f} us"
            f"  p95 {cost.p95_us:5.1f} us  of {cost.updates} updates"
        )
