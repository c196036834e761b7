"""The command tree; nothing of the testbed is imported until a command runs."""

import typer

from hil.cli import (
    bench,
    campaign,
    cell,
    doctor,
    experiment,
    falsify,
    faults,
    faulty,
    recordings,
    rig,
    training,
    tune,
)


def build() -> typer.Typer:
    """Every command of `hil`."""
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
    app.command()(training.train)
    app.command()(recordings.replay)
    app.command()(recordings.diff)
    app.command()(falsify.falsify)
    app.command()(falsify.shrink)
    app.command()(bench.bench)
    app.command()(faulty.coverage)
    app.command()(doctor.doctor)
    app.add_typer(rig.build(), name="rig")
    app.add_typer(faults.build(), name="faults")
    app.add_typer(experiment.build(), name="experiment")
    app.add_typer(campaign.build(), name="campaign")
    app.add_typer(tune.build(), name="tune")
    app.add_typer(training.build(), name="policy")
    return app
