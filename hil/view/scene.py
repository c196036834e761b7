"""A picture of the cell at one moment, drawn by a process of its own.

MuJoCo chooses its OpenGL when it is imported, and fails to import where the chosen one is missing;
a run must not depend on either.
"""

import os
import subprocess
import sys
from pathlib import Path

import numpy as np

from hil.cell.plant.ffc import FfcPlant

LIMIT = 60.0
"""Wall seconds; software rendering of one frame takes about one."""


def keep(plant: FfcPlant, path: Path) -> None:
    """Write what a picture needs of the plant's present state."""
    state, model = plant.state, plant.model
    np.savez(path, qpos=state.qpos, body_pos=model.body_pos, body_quat=model.body_quat)


def draw(rig: Path, kept: Path, picture: Path) -> str:
    """Draw a kept moment into a PNG; "" or the line that says why there is none."""
    environment = {**os.environ, "MUJOCO_GL": "egl"}
    command = [sys.executable, "-m", "hil.view.scene", str(rig), str(kept), str(picture)]
    try:
        child = subprocess.run(
            command, env=environment, capture_output=True, text=True, timeout=LIMIT, check=False
        )
    except subprocess.TimeoutExpired:
        return f"rendering took longer than {LIMIT:g} s"
    if child.returncode == 0:
        return ""
    return "no off-screen OpenGL here; install libegl1 and libgl1-mesa-dri (Debian)"


def main(rig: Path, kept: Path, picture: Path) -> None:
    """The child: the rig's plant in the kept state, through the close-up camera."""
    import mujoco  # noqa: PLC0415
    from matplotlib.image import imsave  # noqa: PLC0415

    from hil.cell.plant.render import render  # noqa: PLC0415
    from hil.cell.rig import load  # noqa: PLC0415

    plant = FfcPlant(load(rig), np.random.default_rng(0))
    with np.load(kept) as state:
        plant.model.body_pos[:], plant.model.body_quat[:] = state["body_pos"], state["body_quat"]
        plant.state.qpos[:] = state["qpos"]
    mujoco.mj_forward(plant.model, plant.state)
    imsave(picture, render(plant, 960, 640))


if __name__ == "__main__":
    main(*(Path(argument) for argument in sys.argv[1:4]))
