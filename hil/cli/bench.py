"""`hil bench`: how fast the loop runs here, part by part."""

from typing import Annotated

import typer

from hil.cli.options import Json


def bench(
    seconds: Annotated[float, typer.Option(min=0.1, help="Bench time of one case, s.")] = 10.0,
    case: Annotated[
        list[str] | None, typer.Option(help="Only this case; may be given more than once.")
    ] = None,
    json: Json = False,
) -> int:
    """Measure the loop's real-time factor and the cost of its parts on this machine."""
    from hil.bench.run import run  # noqa: PLC0415

    return run(seconds=seconds, cases=tuple(case or ()), json=json)
