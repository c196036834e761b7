"""`hil rig`: whether a rig file is sound, and what it means with every default filled in."""

import typer

from hil.cli.options import Json, RigName


def build() -> typer.Typer:
    app = typer.Typer(help="Look at rig files.", no_args_is_help=True, rich_markup_mode=None)
    app.command()(check)
    app.command()(show)
    return app


def check(rig: RigName) -> None:
    """Say whether a rig file is sound."""
    from hil.cli.shipped import read  # noqa: PLC0415

    found, _ = read(rig)
    robot, sensor = found.robot, found.sensor
    arm = f"robot {robot.model} ({robot.series}, {robot.rate} Hz, {robot.version})"
    wrist = f"sensor {sensor.preset} ({sensor.rate:g} Hz, {sensor.range_force:g} N)"
    typer.echo(f"ok: {found.name}, {arm}, {wrist}, {sensor.frames} CAN frames")


def show(rig: RigName, json: Json = False) -> None:
    """Print the complete rig, every default filled in, as a rig file that means the same."""
    from hil.cli.rig_text import as_json, as_yaml  # noqa: PLC0415
    from hil.cli.shipped import read  # noqa: PLC0415

    found, _ = read(rig)
    typer.echo(as_json(found) if json else as_yaml(found), nl=False)
