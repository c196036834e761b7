"""What `hil experiment beside` tells: each row with the loop's lateness."""

import orjson
import pytest

from hil.cell.clock import Lateness
from hil.experiments.beside import Row, as_text
from hil.view.tables import as_json

LATE = Lateness(periods=7500, missed=75, p50=60_000, p99=100_000, max=2_760_000, forgone=0)
ROWS = [Row("none", LATE, 1.22, 3.5)]


def test_rows_are_json_for_programs():
    """They were measured for eight minutes and then could not be written."""
    (row,) = orjson.loads(as_json({"fifo": True, "rows": ROWS}))["rows"]
    assert row["company"] == "none"
    assert row["lateness"] == LATE._asdict()


def test_what_is_no_data_is_not_taken_for_some():
    with pytest.raises(TypeError, match="not JSON serializable"):
        as_json({"rows": object()})


def test_rows_are_lines_for_people():
    assert as_text(ROWS).splitlines()[1].split() == [
        "none",
        "60",
        "100",
        "2760",
        "1.0%",
        "1.22",
        "3.50",
    ]
