"""Each picture in a fresh process: MuJoCo picks its OpenGL when it is imported."""

import os
import subprocess
import sys
from ctypes.util import find_library
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[2]
PROGRAM = """
from pathlib import Path
import numpy as np
from hil.cell.errors import PlantError
from hil.cell.plant.ffc import FfcPlant
from hil.cell.plant.render import render
from hil.cell.rig import load
from hil.experiments.press import Press
trial = Press(FfcPlant, load(Path("fixtures/rigs/ffc_ur5.yaml")))
before = trial.plant.state.qpos.copy()
try:
    held = render(trial.plant, 160, 120)
    trial.open()
    print(held.shape, held.dtype, (before == trial.plant.state.qpos).all() or "moved",
          len(np.unique(held)) > 20, (held != render(trial.plant, 160, 120)).any())
except PlantError as error:
    print(error)
"""


def picture(**environment):
    kept = {k: v for k, v in os.environ.items() if k not in ("MUJOCO_GL", "DISPLAY")}
    done = subprocess.run(
        [sys.executable, "-W", "ignore", "-c", PROGRAM],
        cwd=ROOT, env=kept | environment, capture_output=True, text=True, check=True,
    )  # fmt: skip
    return done.stdout.strip()


@pytest.mark.skipif(find_library("EGL") is None, reason="needs libegl1")
def test_a_picture_shows_the_cable_while_it_is_gripped():
    shown = picture(MUJOCO_GL="egl").split()
    assert shown[:4] == ["(120,", "160,", "3)", "uint8"]
    assert shown[-2:] == ["True", "True"]


def test_without_opengl_the_error_says_what_to_install():
    assert "MUJOCO_GL=egl" in picture()
    assert "libegl1" in picture()
