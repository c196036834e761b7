"""What a checkpoint of a training holds, and its policy as a picture (Fig. 12)."""

from pathlib import Path

from matplotlib.figure import Figure

from controller.outcome import Kind
from hil.app.sessions import episodes_of, part_of
from hil.cell.streams import stream
from hil.experiments.ffc.figures import worth
from hil.experiments.ffc.rows import share
from learner.build import maker
from learner.checkpoint import Checkpoint
from learner.errors import CheckpointError
from learner.grid import Grid
from learner.surface import surface

STEP, TURN = 0.3e-3, 0.0174532925199433


def facts(found: Checkpoint, path: Path) -> dict[str, str | int | float | None]:
    """Whose it is and how it fared."""
    episodes = episodes_of(found, path)
    inserted = share(episodes, Kind.INSERTED) if episodes else 0.0
    return {
        "learner": found.learner,
        "rig": found.rig,
        "seed": found.seed,
        "episodes": found.episodes,
        "inserted": f"{100 * inserted:.3g} %",
        "dangers": sum(episode.kind is Kind.DANGER for episode in episodes),
        "last ten, steps": ", ".join(str(episode.steps) for episode in episodes[-10:]),
        "written by": ", ".join(f"{name} {version}" for name, version in found.versions.items()),
    }


def draw(found: Checkpoint, path: Path, picture: Path) -> bool:
    """Draw the worth of poses; False for a learner that knows none. Raises CheckpointError."""
    try:
        x, y, theta = (int(half) for half in found.settings["cells"].split(","))
        max_steps = int(found.settings["max_steps"])
    except (KeyError, ValueError):
        raise CheckpointError(f"{path}: no search box in it: not of `hil train`") from None
    grid = Grid((x, y, theta), (STEP, STEP, TURN))
    learner = maker(found.learner)(grid, max_steps, stream(found.seed, "learner"))
    learner.load(part_of(found.state, "learner", path))
    values = surface(learner)
    if values is None:
        return False
    sheet = Figure(figsize=(5.6, 4.6), layout="constrained")
    worth(sheet.subplots(), values, f"{found.learner} after {found.episodes} episodes")
    sheet.savefig(picture, dpi=120)
    return True
