"""Signals of a whole run, a row a control period of the cell."""

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from hashlib import sha256

import numpy as np
from numpy.typing import NDArray

from hil.monitors.monitor import Monitor, Verdict
from hil.trial.signals import NAMES, SCALES


@dataclass(frozen=True)
class Trace:
    """columns: by signal, of one length. phases: the job's own name for each period's phase."""

    columns: Mapping[str, NDArray[np.float64]] = field(repr=False)
    phases: tuple[str, ...] = field(repr=False)

    def __len__(self) -> int:
        return len(self.phases)

    def __getitem__(self, name: str) -> NDArray[np.float64]:
        return self.columns[name]

    def rows(self, names: Sequence[str] = NAMES) -> Iterator[dict[str, float]]:
        """The values of some signals, period by period."""
        picked = [self.columns[name].tolist() for name in names]
        for values in zip(*picked, strict=True):
            yield dict(zip(names, values, strict=True))

    def verdicts(self, formula: str) -> list[Verdict]:
        """A formula's verdict in each period; MonitorError for one that cannot be read."""
        monitor = Monitor(formula, SCALES)
        return [monitor.step(row) for row in self.rows(sorted(monitor.signals))]

    def robustness(self, formula: str) -> float:
        """By how many scales the formula held in its worst period; below 0: it did not."""
        return min((verdict.robustness for verdict in self.verdicts(formula)), default=float("inf"))

    @property
    def digest(self) -> str:
        """SHA-256 over names, values and phases."""
        hashed = sha256("\0".join((*self.columns, *self.phases)).encode())
        for column in self.columns.values():
            hashed.update(column.tobytes())
        return hashed.hexdigest()


def trace(rows: Sequence[tuple[float, ...]], phases: Sequence[str]) -> Trace:
    """Of rows whose values are in the order of NAMES."""
    table = np.asarray(rows, dtype=np.float64).reshape(len(rows), len(NAMES))
    columns = {name: np.ascontiguousarray(table[:, n]) for n, name in enumerate(NAMES)}
    return Trace(columns, tuple(phases))
