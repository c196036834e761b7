"""`hil demo`, `hil run` and `hil up`: the whole loop, one run, the cell alone."""

from pathlib import Path
from typing import Annotated

import typer

from hil.cli.errors import FAILED
from hil.cli.options import (
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


def demo(*, out: Out = Path("out/demo"), seed: Seed = None, overwrite: Overwrite = False) -> int:
    """Assemble one cable in the paper's cell, record it, draw it: the testbed in a minute."""
    from hil.app.demo import demo as begin  # noqa: PLC0415

    return begin(out=out, seed=seed, overwrite=overwrite)


def run(
    *,
    rig: RigName,
    seed: Seed = None,
    out: Out = Path("out/run"),
    cell: Annotated[
        Layout, typer.Option(help="The cell in this process or in one of its own.")
    ] = Layout.INLINE,
    clock: ClockOption = None,
    policy: PolicyOption = PolicyName.POSE,
    part: Annotated[str, typer.Option(help="Which part of the fixture to assemble.")] = "FFC1",
    json: Json = False,
    overwrite: Overwrite = False,
) -> int:
    """Run one assembly and record it; exit status 1 when the part was not inserted."""
    from controller.outcome import Kind  # noqa: PLC0415
    from hil.app.run import Request  # noqa: PLC0415
    from hil.app.run import run as begin  # noqa: PLC0415
    from hil.cli.result import text, watched  # noqa: PLC0415
    from hil.cli.shipped import read  # noqa: PLC0415

    found, content = read(rig)
    request = Request(
        rig=found,
        rig_text=content,
        seed=found.seed if seed is None else seed,
        part=part,
        policy=policy.value,
        layout=cell.value,
        clock=clock.value if clock else found.clock,
        out=out,
        overwrite=overwrite,
    )
    with watched(found, quiet=json) as watch:
        result = begin(request, watch)
    typer.echo(text(request, result, json=json), nl=False)
    return 0 if result.outcome.kind is Kind.INSERTED else FAILED


def up(*, rig: RigName, clock: ClockOption = None, seed: Seed = None, json: Json = False) -> int:
    """Serve a rig's cell until Ctrl-C, for a client of your own; print its ports and bus."""
    from hil.app.up import up as begin  # noqa: PLC0415
    from hil.cli.shipped import read  # noqa: PLC0415

    found, _ = read(rig)
    return begin(found, seed=seed, clock=clock.value if clock else None, json=json)
