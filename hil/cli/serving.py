"""`hil up`: says where the cell can be reached, serves it, says how it kept time."""

from ipaddress import ip_address
from typing import Final

import typer

from hil.app.desk import ask_all
from hil.app.up import Status, up
from hil.cell.errors import DoorError
from hil.cell.rig import Rig
from hil.cell.serve import Doors
from hil.cli.shipped import read
from hil.view.tables import as_json, of_facts, of_lateness

POWERED: Final = "the arm releases its brakes now"
UNPOWERED: Final = (
    'the arm has no power yet: "power on" and "brake release" on the dashboard, or start with '
    "--powered"
)


def serve(  # one for each option
    rig: str, seed: int | None, clock: str, host: str | None, *, powered: bool, json: bool
) -> int:
    """Serve until SIGINT or SIGTERM; the exit status."""
    found = _found(rig, host)

    def announce(doors: Doors, bus: str) -> None:
        where = _where(doors)
        if json:
            typer.echo(as_json({"rig": found.name, "clock": clock, **where}).strip())
        else:
            typer.echo(of_facts({"emulated cell": found.name, "clock": clock, **where}), nl=False)
            typer.echo(bus)
            typer.echo(f"{POWERED if powered else UNPOWERED}; Ctrl-C ends it")

    drawn = found.seed if seed is None else seed
    up(found, drawn, clock, announce, lambda s: _tell(s, json=json), powered=powered)
    return 0


def inquire(rig: str, host: str | None, *, json: bool) -> int:
    """Show how this user's running cells of a rig are doing; DoorError when there is none."""
    found = _found(rig, host)
    running = [Status.from_json(answer) for answer in ask_all()]
    meant = [s for s in running if s.rig == found.name and host in (None, s.host)]
    if not meant:
        others = ", ".join(sorted({f"{s.rig} at {s.host}" for s in running})) or "none"
        raise DoorError(f"no `hil up {rig}` is running for you; running are: {others}")
    for status in meant:
        _tell(status, json=json)
    return 0


def _tell(status: Status, *, json: bool) -> None:
    """A line of JSON, or a table, of how a cell is doing."""
    if json:
        typer.echo(status.to_json().decode())
        return
    traffic, late = status.traffic, status.lateness
    clients = (f"{door} {count}" for door, count in traffic.clients.items() if count)
    events = (f"{event} {count}" for event, count in traffic.events.items())
    facts: dict[str, str | int | float | None] = {
        "cell": f"{status.rig} at {status.host}, rtde {status.rtde}, {status.clock}",
        "periods": traffic.periods,
        **({} if late is None else {"lateness": of_lateness(late)}),
        "clients": ", ".join(clients) or "none",
        "at the doors": ", ".join(events) or "nothing out of the ordinary",
    }
    typer.echo(of_facts(facts), nl=False)


def _found(rig: str, host: str | None) -> Rig:
    found, _ = read(rig)
    return found if host is None else _at(found, host)


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
