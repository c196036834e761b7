"""A measured row, for people and for programs."""

import numpy as np
import orjson
import pytest

from hil.experiments.row import at_least, at_most, within
from hil.view.tables import of_rows


@pytest.mark.parametrize(
    ("row", "passed"),
    [
        (at_most("T3", "creep", np.float64(0.4), 0.5, "um/s"), True),
        (at_least("T2", "fall of force", np.float64(50.0), 60.0, "%"), False),
        (within("T4", "buckled force", np.float64(9.5), 10.5, 0.1), True),
    ],
)
def test_a_row_of_numpys_numbers_is_json_for_programs(row, passed):
    (told,) = orjson.loads(of_rows([row], json=True))
    assert told["passed"] is passed
