"""The testbed in a minute: one assembly in the paper's cell, recorded and drawn."""

from pathlib import Path

import typer

from hil.app.run import Request
from hil.cli.assembly import perform, report
from hil.cli.options import DEFAULT_RIG
from hil.cli.pictures import Photographer, clear, draw
from hil.cli.shipped import read


def demo(out: Path, seed: int | None, *, json: bool, overwrite: bool) -> int:
    """Run, record, draw; the exit status."""
    rig, text = read(DEFAULT_RIG)
    request = Request(
        rig=rig.on_free_ports(),
        rig_text=text,
        seed=rig.seed if seed is None else seed,
        part=rig.first_part,
        out=out,
        overwrite=overwrite,
        alone=True,
    )
    camera = Photographer()
    if overwrite:
        clear(out)
    result = perform(request, camera.watch, json=json)
    lines = [*draw(out), camera.develop(DEFAULT_RIG, out / "scene.png")]
    if not json:
        typer.echo("\n".join(lines))
    return report(result, out, json=json)
