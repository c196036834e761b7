"""The language against an implementation that nobody here wrote, on random traces."""

import re

import numpy as np
import pytest
import sentil

from hil.monitors.monitor import offline

SCALES = {"f": 1.0, "age": 1.0, "fault": 1.0, "speed": 1.0}
FORMULAS = (
    "once[0:1] f <= 20",
    "age <= 6",
    "(historically[0:5] fault > 0.5) -> speed <= 0.01",
    "not (once[1:4] f > 19) or historically[0:2] age < 5",
    "(once[2:2] fault > 0.5 and f <= 18) or not speed > 1",
    "historically[0:3] (fault > 0.5 -> once[0:2] speed <= 0.5)",
)
TRACES = 200


def trace(rng):
    n = int(rng.integers(8, 60))
    begin = int(rng.integers(0, n))
    stop = begin + int(rng.integers(0, 12))
    return {
        "f": rng.normal(18, 3, n),
        "age": rng.choice([2.0, 4.0, 8.0], n, p=[0.8, 0.15, 0.05]),
        "fault": (np.arange(n) >= begin).astype(float),
        "speed": np.where(np.arange(n) >= stop, 0.0, 5.0) * rng.choice([0.0, 1.0], n, p=[0.2, 0.8]),
    }


def other(text, columns):
    """Robustness at each step, as sentil's online monitor gives it."""
    monitor = sentil.OnlineMonitor(re.sub(r"\[(\d+):(\d+)\]", r"[\1,\2]", text))
    n = len(columns["f"])
    verdicts = (
        monitor.update(float(i), {name: float(column[i]) for name, column in columns.items()})
        for i in range(n)
    )
    return [verdict.value for verdict in verdicts]


@pytest.mark.parametrize("text", FORMULAS)
def test_robustness_is_that_of_an_independent_monitor(text):
    rng = np.random.default_rng(7)
    for _ in range(TRACES):
        columns = trace(rng)
        names = list(columns)
        rows = [dict(zip(names, row, strict=True)) for row in zip(*columns.values(), strict=True)]
        ours = [verdict.robustness for verdict in offline(text, SCALES, rows)]
        assert ours == pytest.approx(other(text, columns), abs=1e-9)
