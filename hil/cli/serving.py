"""`hil up`: says where the cell can be reached, serves it, says how it kept time."""

import typer

from hil.app.up import up
from hil.cell.serve import Doors
from hil.cli.shipped import read
from hil.view.tables import as_json, of_facts, of_lateness


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
        typer.echo(of_facts({"periods": report.periods, "lateness": of_lateness(report.lateness)}))
    return 0


def _where(doors: Doors) -> dict[str, str | int | float | None]:
    return {
        "host": doors.host,
        **doors.ports,
        "can_interface": doors.can.interface,
        "can_channel": doors.can.channel,
    }
