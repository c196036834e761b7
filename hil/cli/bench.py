"""`hil bench`: how fast the loop runs here, part by part."""

from typing import Annotated

import typer

from hil.cli.options import DEFAULT_RIG, Json, RigOption


def bench(
    *,
    rig: RigOption = DEFAULT_RIG,
    seconds: Annotated[float, typer.Option(min=0.1, help="Bench time of one case, s.")] = 10.0,
    case: Annotated[
        list[str] | None, typer.Option(help="Only this case; may be given more than once.")
    ] = None,
    json: Json = False,
) -> None:
    """Measure the loop's real-time factor and the cost of its parts on this machine."""
    from hil.bench.case import chosen  # noqa: PLC0415
    from hil.bench.run import measure  # noqa: PLC0415
    from hil.cli.shipped import read  # noqa: PLC0415
    from hil.view import tables  # noqa: PLC0415

    found, content = read(rig)
    measured = [measure(found, content, entry, seconds) for entry in chosen(tuple(case or ()))]
    typer.echo(tables.as_json(measured) if json else tables.of_bench(measured), nl=False)
