"""A picture of the MuJoCo plant, close to the connector, without a screen.

Needs an OpenGL that draws off screen, which MuJoCo picks by the environment when it is imported:
MUJOCO_GL=egl with Debian's libegl1 and libgl1-mesa-dri. Never needed to run a cell.
"""

import mujoco
import numpy as np
from numpy.typing import NDArray

from hil.cell.errors import PlantError
from hil.cell.plant.ffc import FfcPlant
from hil.cell.plant.scenery import CLOSE_UP

Image = NDArray[np.uint8]

ADVICE = "set MUJOCO_GL=egl before Python starts and install libegl1 and libgl1-mesa-dri"


def render(plant: FfcPlant, width: int = 640, height: int = 480) -> Image:
    """RGB picture (height, width, 3); raises PlantError saying what is missing."""
    try:
        renderer = mujoco.Renderer(plant.model, height=height, width=width)
    except Exception as error:  # GL bindings raise whatever their loader does
        raise PlantError(f"no off-screen OpenGL ({error}): {ADVICE}") from error
    try:
        renderer.update_scene(plant.state, camera=CLOSE_UP)
        picture: Image = renderer.render()
    finally:
        renderer.close()
    return picture
