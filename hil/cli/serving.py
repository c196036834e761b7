"""`hil up`: says where the cell can be reached, serves it, says how it kept time."""

from ipaddress import ip_address

import typer

from hil.app.up import up
from hil.cell.rig import Rig
from hil.cell.serve import Doors
from hil.cli.shipped import read
from hil.view.tables import as_json, of_facts, of_lateness


def serve(rig: str, seed: int | None, clock: str, host: str | None, *, json: bool) -> int:
    """Serve until SIGINT or SIGTERM; the exit status."""
    found, _ = read(rig)
    if host is not None:
        found = _at(found, host)

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


def _at(rig: Rig, host: str) -> Rig:
    """The rig's cell on another loopback address, so that two can have the same ports."""
    try:
        local = ip_address(host).is_loopback
    except ValueError:
        local = False
    if not local:
        raise typer.BadParameter(
            f"'{host}' is no loopback address such as 127.0.0.5; to serve a network, "
            "set robot.host in the rig file",
            param_hint="--host",
        )
    return rig.model_copy(update={"robot": rig.robot.model_copy(update={"host": host})})


def _where(doors: Doors) -> dict[str, str | int | float | None]:
    return {
        "host": doors.host,
        **doors.ports,
        "can_interface": doors.can.interface,
        "can_channel": doors.can.channel,
        **({"sensor_tcp": "{}:{}".format(*doors.sensor)} if doors.sensor else {}),
    }
