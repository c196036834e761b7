"""Which fault was active in which phase, counted by what happened and not by what was armed."""

import json
from collections import Counter
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from typing import Final

from hil.campaign.ledger import Entry
from hil.cell.faults.catalogue import CATALOGUE
from hil.cell.faults.row import Phase, Row
from hil.experiments.faults.experiment import FUNCTION
from hil.trial.fmea import load

NOT_HERE: Final = "-"


@dataclass(frozen=True, slots=True)
class Covered:
    """One fault. active: runs by phase in which it had its first effect; None where it makes no
    sense. verdicts: of all its runs. stop, exposure: the worst, s and |f| / f_b.
    """

    id: str
    name: str
    reaction: str
    active: dict[str, int | None]
    verdicts: dict[str, int]
    detection: float | None
    stop: float | None
    exposure: float

    @property
    def open(self) -> tuple[str, ...]:
        """Phases where it makes sense and was never active."""
        return tuple(phase for phase, count in self.active.items() if count == 0)


def coverage(entries: Iterable[Entry]) -> list[Covered]:
    """Every row of the catalogue, in its order, from the runs of a ledger."""
    fmea = load()
    runs = [entry for entry in entries if entry.key.function == FUNCTION]
    return [
        _covered(row, fmea[row.id].reaction, [one for one in runs if _kind(one) == row.id])
        for row in CATALOGUE
    ]


def _covered(row: Row, reaction: str, own: Sequence[Entry]) -> Covered:
    seen = Counter(map(_active, own))
    figures = [entry.outcome.figures.get("figures") for entry in own]
    active = [one for one in figures if isinstance(one, dict) and one]
    return Covered(
        id=row.id,
        name=row.name,
        reaction=reaction,
        active={one.value: seen[one.value] if one in row.phases else None for one in Phase},
        verdicts=dict(Counter(entry.outcome.verdict.value for entry in own)),
        detection=_worst(active, "detection"),
        stop=_worst(active, "stop"),
        exposure=_worst(active, "exposure") or 0.0,
    )


def _kind(entry: Entry) -> str:
    return str(json.loads(entry.key.variant)["fault"]["kind"])


def _active(entry: Entry) -> str:
    figures = entry.outcome.figures
    return str(figures.get("phase", "")) if figures.get("active") else ""


def _worst(figures: Sequence[Mapping[str, object]], name: str) -> float | None:
    values = [value for one in figures if isinstance(value := one.get(name), int | float)]
    return max(values, default=None)


def as_text(rows: Sequence[Covered]) -> str:
    """The matrix: a line a fault."""
    head = f"{'id':4} {'name':22}" + "".join(f"{phase.value:>9}" for phase in Phase)
    lines = [f"{head}  {'detected':>9} {'stood':>9} {'force/f_b':>9}  verdicts"]
    for row in rows:
        cells = "".join(
            f"{NOT_HERE if count is None else count:>9}" for count in row.active.values()
        )
        words = ", ".join(f"{count} {word}" for word, count in sorted(row.verdicts.items()))
        times = f"{_ms(row.detection)} {_ms(row.stop)} {row.exposure:9.2f}"
        lines.append(f"{row.id:4} {row.name:22}{cells}  {times}  {words}")
    left = [f"{row.id} ({', '.join(row.open)})" for row in rows if row.open]
    lines.append(f"never active where it makes sense: {'; '.join(left) or 'none'}")
    return "\n".join(lines) + "\n"


def _ms(seconds: float | None) -> str:
    return f"{NOT_HERE:>9}" if seconds is None else f"{1e3 * seconds:6.0f} ms"
