"""`hil demo`, `hil run` and `hil up`: the whole loop, one run, the cell alone."""

from dataclasses import replace
from pathlib import Path
from typing import Annotated, TypeAlias

import typer

from hil.cli.options import (
    Clock,
    ClockOption,
    Json,
    Layout,
    Out,
    Overwrite,
    PolicyName,
    PolicyOption,
    RigName,
    Seed,
)

LayoutOption: TypeAlias = Annotated[
    Layout, typer.Option(help="The cell in this process or in one of its own.")
]
PartOption: TypeAlias = Annotated[
    str | None, typer.Option(help="Which part; the first unless given.")
]
RigPorts: TypeAlias = Annotated[
    bool, typer.Option("--rig-ports", help="Serve on the rig's ports, not on free ones.")
]
DryRun: TypeAlias = Annotated[
    bool, typer.Option("--dry-run", help="Say what would be connected and done; do nothing.")
]
UpClock: TypeAlias = Annotated[Clock, typer.Option(help="What paces the cell.")]
HostOption: TypeAlias = Annotated[
    str | None, typer.Option(help="Loopback address to serve on; the rig's host unless given.")
]

PoweredOption: TypeAlias = Annotated[
    bool, typer.Option("--powered", help="Start the arm with power and its brakes released.")
]

FaultsOption: TypeAlias = Annotated[
    Path | None,
    typer.Option(metavar="FILE", help="What fails, and when (`hil faults list`, docs/faults.md)."),
]

StatusOption: TypeAlias = Annotated[
    bool, typer.Option("--status", help="Ask the rig's running cell how it is doing; serve none.")
]


def demo(
    out: Out = Path("out/demo"),
    seed: Seed = None,
    learner: Annotated[
        str, typer.Option(help="Who learns in the second half; `none` leaves that out.")
    ] = "belief",
    json: Json = False,
    overwrite: Overwrite = False,
) -> int:
    """Assemble one cable, record it, draw it; then the paper's learning experiment, its figures."""
    from hil.cli.demo import demo as begin  # noqa: PLC0415

    return begin(out, seed, learner, json=json, overwrite=overwrite)


def run(
    rig: RigName,
    seed: Seed = None,
    out: Out = Path("out/run"),
    cell: LayoutOption = Layout.INLINE,
    clock: ClockOption = None,
    policy: PolicyOption = PolicyName.POSE,
    part: PartOption = None,
    rig_ports: RigPorts = False,
    dry_run: DryRun = False,
    faults: FaultsOption = None,
    json: Json = False,
    overwrite: Overwrite = False,
) -> int:
    """Run one assembly against a rig and record it; exit status 1 when it was not inserted."""
    from hil.cli.assembly import ignore, perform, report  # noqa: PLC0415
    from hil.cli.request import Choice, asked, plan_of, rig_of  # noqa: PLC0415
    from hil.view.tables import as_json, of_facts  # noqa: PLC0415

    choice = Choice(seed, cell, clock, policy, part, rig_ports, faults)
    request = asked(*rig_of(rig, choice), choice)
    if dry_run or request.rig.rig == "real":
        intent = plan_of(request)
        if dry_run or not json:
            typer.echo(as_json(intent) if json else of_facts(intent), nl=False)
    if dry_run:
        return 0
    request = replace(request, out=out, overwrite=overwrite)
    return report(perform(request, ignore, json=json), out, json=json)


def up(
    rig: RigName,
    clock: UpClock = Clock.WALL,
    seed: Seed = None,
    host: HostOption = None,
    powered: PoweredOption = False,
    status: StatusOption = False,
    json: Json = False,
) -> int:
    """Serve a rig's cell until Ctrl-C, for clients of your own; print its ports and bus.

    By the wall clock unless told otherwise: in lockstep, time stands still until somebody commands.
    SIGUSR1 makes it say how it keeps time and who is connected, as --status and its end do.
    """
    from hil.cli.serving import inquire, serve  # noqa: PLC0415

    if status:
        return inquire(rig, host, json=json)
    return serve(rig, seed, clock.value, host, powered=powered, json=json)
