"""`hil doctor`: whether this machine, or a rig's devices, have what the testbed needs."""

from collections.abc import Iterator
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, TypeAlias

import typer

from hil.cli.errors import FAILED
from hil.cli.options import Json, Out

if TYPE_CHECKING:
    from hil.doctor.finding import Finding

MaybeRig: TypeAlias = Annotated[
    str | None,
    typer.Argument(metavar="[RIG]", help="A rig whose devices are up; this machine unless given."),
]


def doctor(rig: MaybeRig = None, out: Out = Path("out"), json: Json = False) -> int:
    """Check this machine, or a rig's devices; exit status 1 when something required fails."""
    from hil.doctor.finding import Verdict  # noqa: PLC0415
    from hil.view import tables  # noqa: PLC0415

    found = list(_findings(rig, out))
    typer.echo(tables.as_json(found) if json else tables.of_findings(found), nl=False)
    return FAILED if any(finding.verdict is Verdict.FAIL for finding in found) else 0


def _findings(rig: str | None, out: Path) -> "Iterator[Finding]":
    if rig is None:
        from hil.doctor import machine  # noqa: PLC0415

        return machine.findings(out)
    from hil.cli.shipped import read  # noqa: PLC0415
    from hil.doctor import cell  # noqa: PLC0415

    return cell.findings(read(rig)[0])
