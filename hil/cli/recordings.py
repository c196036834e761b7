"""`hil replay` and `hil diff`: what happened in a run, and where two runs part."""

import sys
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from hil.cli.errors import FAILED
from hil.cli.options import Json

if TYPE_CHECKING:
    from hil.recording.read import Recording

RunPath = Annotated[
    Path, typer.Argument(metavar="RUN", help="A run's folder, its run.mcap, or a kept schedule.")
]


def replay(
    run: RunPath,
    json: Json = False,
    csv: Annotated[
        Path | None, typer.Option(help="Write one row a control period; - is stdout.")
    ] = None,
    figure: Annotated[Path | None, typer.Option(help="Draw the run's forces as PNG.")] = None,
    page: Annotated[Path | None, typer.Option(help="Write a self-contained HTML page.")] = None,
) -> int:
    """Print what happened in a recorded run: phases, contact, forces, trips.

    A schedule that `hil falsify` or `hil shrink` kept (.yaml) is run again.
    """
    if run.suffix == ".yaml":
        from hil.cli.falsify import again  # noqa: PLC0415

        return again(run, json=json)
    from hil.recording.read import load  # noqa: PLC0415
    from hil.recording.summary import summarise  # noqa: PLC0415
    from hil.view import tables  # noqa: PLC0415

    recording = load(run)
    if csv is not None:
        _table(recording, csv)
    if figure is not None or page is not None:
        _pictures(recording, figure, page)
    if csv != Path("-"):
        summary = summarise(recording)
        typer.echo(tables.as_json(summary) if json else tables.of_run(summary), nl=False)
    return 0


def diff(
    left: RunPath,
    right: Annotated[Path, typer.Argument(metavar="RUN", help="The run to compare it with.")],
    json: Json = False,
) -> int:
    """Find where two recordings first differ; exit status 0 same, 1 not, 2 unreadable."""
    from hil.recording.diff import compare  # noqa: PLC0415
    from hil.recording.read import load  # noqa: PLC0415
    from hil.view import tables  # noqa: PLC0415

    comparison = compare(load(left), load(right))
    text = tables.as_json(comparison) if json else tables.of_comparison(comparison)
    typer.echo(text, nl=False)
    return 0 if comparison.same else FAILED


def _table(recording: "Recording", target: Path) -> None:
    from hil.recording import csv_file  # noqa: PLC0415
    from hil.recording.errors import RecordingError  # noqa: PLC0415

    if target == Path("-"):
        csv_file.write(recording, sys.stdout)
        return
    try:
        with target.open("w", newline="", encoding="utf-8") as file:
            csv_file.write(recording, file)
    except OSError as error:
        raise RecordingError(f"{target}: {error.strerror}") from None


def _pictures(recording: "Recording", figure: Path | None, page: Path | None) -> None:
    from hil.recording.errors import RecordingError  # noqa: PLC0415
    from hil.view import page as pages  # noqa: PLC0415
    from hil.view import run_figure  # noqa: PLC0415

    picture = run_figure.draw(recording)
    try:
        if figure is not None:
            figure.write_bytes(picture)
        if page is not None:
            page.write_text(pages.render(recording, picture), encoding="utf-8")
    except OSError as error:
        raise RecordingError(f"{error.filename}: {error.strerror}") from None
