"""A picture of the cell at one moment, drawn by a process of its own.

MuJoCo chooses its OpenGL when it is imported, and fails to import where the chosen one is missing;
a run must not depend on either.
"""

import os
import subprocess
import sys
from io import BytesIO
from pathlib import Path

import numpy as np

from hil.cell.plant.ffc import FfcPlant
from hil.cell.plant.interface import PlantStep

LIMIT = 60.0
"""Wall seconds; software rendering of one frame takes about one."""


def keep(plant: FfcPlant, truth: PlantStep) -> bytes:
    """What a picture needs of the plant as it was at `truth`: it may be a period further by now."""
    model, kept = plant.model, BytesIO()
    np.savez(kept, qpos=truth.posture, body_pos=model.body_pos, body_quat=model.body_quat)
    return kept.getvalue()


def draw(rig: Path, kept: bytes, picture: Path) -> str:
    """Draw a kept moment into a PNG; "" or the line that says why there is none."""
    environment = {**os.environ, "MUJOCO_GL": "egl"}
    command = [sys.executable, "-m", "hil.view.scene", str(rig), str(picture)]
    try:
        child = subprocess.run(
            command, input=kept, env=environment, capture_output=True, timeout=LIMIT, check=False
        )
    except subprocess.TimeoutExpired:
        return f"rendering took longer than {LIMIT:g} s"
    if child.returncode == 0:
        return ""
    return "no off-screen OpenGL here; install libegl1 and libgl1-mesa-dri (Debian)"


def main(rig: Path, picture: Path) -> None:
    """The child: the rig's plant in the state kept at stdin, through the close-up camera."""
    import mujoco  # noqa: PLC0415
    from matplotlib.image import imsave  # noqa: PLC0415

    from hil.cell.plant.render import render  # noqa: PLC0415
    from hil.cell.rig import load  # noqa: PLC0415

    plant = FfcPlant(load(rig), np.random.default_rng(0))
    with np.load(BytesIO(sys.stdin.buffer.read())) as state:
        plant.model.body_pos[:], plant.model.body_quat[:] = state["body_pos"], state["body_quat"]
        plant.state.qpos[:] = state["qpos"]
    mujoco.mj_forward(plant.model, plant.state)
    imsave(picture, render(plant, 960, 640))


if __name__ == "__main__":
    main(*(Path(argument) for argument in sys.argv[1:3]))
