"""A run as a table for a spreadsheet: one row a control period."""

import csv
from typing import TextIO

from hil.recording import series
from hil.recording.channels.schema import AXES6, STAGE_AXES, WRENCH_AXES
from hil.recording.read import Recording

COLUMNS = (
    "t",
    "phase",
    "k",
    *(f"setpoint_{axis}" for axis in AXES6),
    *WRENCH_AXES,
    *(f"stage_{axis}" for axis in STAGE_AXES),
    "tip_x",
    "tip_y",
    "tip_z",
    "tip_theta",
    "depth",
    "contact",
)


def write(recording: Recording, target: TextIO) -> int:
    """Controller and plant side by side, SI; the number of rows.

    The plant's columns are those of the period's own time, empty where there is none.
    """
    controller, plant = series.control(recording), series.truth(recording)
    at = {t: index for index, t in enumerate(plant.t.tolist())}
    table = csv.writer(target)
    table.writerow(COLUMNS)
    for i, t in enumerate(controller.t.tolist()):
        row = [*controller.setpoint[i], *controller.wrench[i], *controller.stage[i]]
        seen = _plant(plant, at[t]) if t in at else [""] * 6
        table.writerow([t, controller.phase[i], controller.k[i], *map(float, row), *seen])
    return len(controller.t)


def _plant(plant: series.Truth, i: int) -> list[object]:
    return [*plant.tip[i].tolist(), float(plant.theta[i]), float(plant.depth[i]), plant.contact[i]]
