"""`hil up`: says where the cell can be reached, serves it, says how it kept time."""

import typer

from hil.app.up import up
from hil.cell.clock import Lateness
from hil.cell.serve import Doors
from hil.cli.shipped import read
from hil.view.tables import as_json, of_facts


def serve(rig: str, seed: int | None, clock: str, *, json: bool) -> int:
    """Serve until SIGINT or SIGTERM; the exit status."""
    found, _ = read(rig)

    def announce(doors: Doors, bus: str) -> None:
        where = _where(doors)
        if json:
            typer.echo(as_json({"rig": found.name, "clock": clock, **where}).strip())
        else:
            typer.echo(of_facts({"emulated cell": found.name, "clock": clock, **where}), nl=False)
            typer.echo(f"{bus}; Ctrl-C ends it")

    report = up(found, found.seed if seed is None else seed, clock, announce)
    if not json and report.lateness is not None:
        typer.echo(of_facts({"periods": report.periods, "lateness": said(report.lateness)}))
    return 0


def said(late: Lateness) -> str:
    """Lateness in words."""
    return (
        f"p50 {late.p50 / 1e6:.2f} ms, p99 {late.p99 / 1e6:.2f} ms, max {late.max / 1e6:.2f} ms, "
        f"{late.missed} of {late.periods} periods missed"
    )


def _where(doors: Doors) -> dict[str, str | int | float | None]:
    return {
        "host": doors.host,
        **doors.ports,
        "can_interface": doors.can.interface,
        "can_channel": doors.can.channel,
    }
