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
    ring: Annotated[
        int, typer.Option(min=0, help="Instead, so often in turn with a minimal ring (see docs).")
    ] = 0,
    json: Json = False,
) -> None:
    """Measure the loop's real-time factor and the cost of its parts on this machine."""
    if ring:
        _beside_the_ring(rig, seconds, tuple(case or ()), ring, json=json)
        return
    from hil.bench.case import chosen  # noqa: PLC0415
    from hil.bench.first_cycle import measure as startup  # noqa: PLC0415
    from hil.bench.run import measure  # noqa: PLC0415
    from hil.cli.shipped import read  # noqa: PLC0415
    from hil.view import tables  # noqa: PLC0415

    found, content = read(rig)
    names = tuple(case or ())
    measured = [measure(found, content, entry, seconds) for entry in chosen(names)]
    first = startup(content)
    if json:
        figures: dict[str, object] = {entry.case.name: entry.figures() for entry in measured}
        typer.echo(tables.as_json({**figures, "startup": first}), nl=False)
        return
    typer.echo(tables.of_bench(measured), nl=False)
    typer.echo(f"command to first control cycle: {first.first_cycle_s:.1f} s")
    typer.echo(f"memory of a cell with its drivers and recorder: {first.memory_mb:.0f} MB")


def _beside_the_ring(
    rig: str, seconds: float, names: tuple[str, ...], pairs: int, *, json: bool
) -> None:
    from hil.bench.case import chosen  # noqa: PLC0415
    from hil.bench.compare import compare  # noqa: PLC0415
    from hil.cli.shipped import read  # noqa: PLC0415
    from hil.view import tables  # noqa: PLC0415

    found, content = read(rig)
    compared = [compare(found, content, entry, seconds, pairs) for entry in chosen(names)]
    if json:
        typer.echo(
            tables.as_json({entry.case.name: entry.figures() for entry in compared}), nl=False
        )
        return
    typer.echo(tables.of_ring(compared), nl=False)
