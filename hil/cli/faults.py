"""`hil faults`: what can be made to fail."""

import typer

from hil.cli.options import Json


def build() -> typer.Typer:
    app = typer.Typer(help="What can be made to fail.", no_args_is_help=True, rich_markup_mode=None)
    app.callback()(_faults)
    app.command("list")(catalogue)
    return app


def _faults() -> None:
    """Faults that a run, a test or a campaign can inject."""


def catalogue(json: Json = False) -> None:
    """List every fault: id, place, parameters, what a safe system does, what proves it."""
    from hil.view.faults import as_rows, as_text  # noqa: PLC0415
    from hil.view.tables import as_json  # noqa: PLC0415

    typer.echo(as_json({"faults": as_rows()}) if json else as_text(), nl=False)
