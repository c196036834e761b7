"""`hil doctor`: whether this machine has what the testbed needs."""

from pathlib import Path

import typer

from hil.cli.errors import FAILED
from hil.cli.options import Json, Out


def doctor(out: Out = Path("out"), json: Json = False) -> int:
    """Check this machine; exit status 1 when something required is missing."""
    from hil.cli.checks import Verdict, findings  # noqa: PLC0415
    from hil.view import tables  # noqa: PLC0415

    found = list(findings(out))
    typer.echo(tables.as_json(found) if json else tables.of_findings(found), nl=False)
    return FAILED if any(finding.verdict is Verdict.MISSING for finding in found) else 0
