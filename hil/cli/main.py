"""The `hil` command: what it offers, and how it ends."""

import sys
from collections.abc import Sequence

import typer

from hil.cli import bench, cell, doctor, experiment, recordings, rig
from hil.cli.errors import INTERRUPTED, line, status


def build() -> typer.Typer:
    """The command tree; nothing of the testbed is imported until a command runs."""
    app = typer.Typer(
        name="hil",
        help="An emulated robot cell (UR arm, F/T sensor, contact) behind real wires.",
        add_completion=False,
        no_args_is_help=True,
        pretty_exceptions_enable=False,
        rich_markup_mode=None,  # rich's help takes twice as long to import as all else
    )
    app.command()(cell.demo)
    app.command()(cell.run)
    app.command()(cell.up)
    app.command()(recordings.replay)
    app.command()(recordings.diff)
    app.command()(bench.bench)
    app.command()(doctor.doctor)
    app.add_typer(rig.build(), name="rig")
    app.add_typer(experiment.build(), name="experiment")
    return app


def call(arguments: Sequence[str]) -> int:
    """Run one command line; its exit status. Known errors become one line on stderr."""
    try:
        code = build()(list(arguments), prog_name="hil", standalone_mode=False)
    except (KeyboardInterrupt, typer.Abort):
        code = INTERRUPTED
    except Exception as error:
        known = status(error)
        if known is None:
            raise
        print(f"hil: {line(error)}", file=sys.stderr)
        return known
    if code == INTERRUPTED:
        print("hil: interrupted", file=sys.stderr)
    return code or 0


def main() -> None:
    sys.exit(call(sys.argv[1:]))
