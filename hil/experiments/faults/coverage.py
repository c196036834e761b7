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
FIGURES: Final = ("detected", "reacted", "stood", "force/f_b", "ready")


@dataclass(frozen=True, slots=True)
class Covered:
    """One fault. owed: what the FMEA file asks for. active: runs by phase in which it had its first
    effect; None where it makes no sense. verdicts: of all its runs. detection, reaction, stop (s),
    recovery (s), exposure (|f| / f_b): the worst of its runs; None where none had it.
    """

    id: str
    name: str
    owed: str
    active: dict[str, int | None]
    verdicts: dict[str, int]
    detection: float | None
    reaction: float | None
    stop: float | None
    exposure: float
    recovery: float | None

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


def _covered(row: Row, owed: str, own: Sequence[Entry]) -> Covered:
    seen = Counter(map(_active, own))
    figures = [entry.outcome.figures.get("figures") for entry in own]
    active = [one for one in figures if isinstance(one, dict) and one]
    phases = (Phase.FREE,) if row.start else row.phases
    return Covered(
        id=row.id,
        name=row.name,
        owed=owed,
        active={one.value: seen[one.value] if one in phases else None for one in Phase},
        verdicts=dict(Counter(entry.outcome.verdict.value for entry in own)),
        detection=_worst(active, "detection"),
        reaction=_worst(active, "reaction"),
        stop=_worst(active, "stop"),
        exposure=_worst(active, "exposure") or 0.0,
        recovery=_worst(active, "recovery"),
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
    lines = [head + "".join(f" {name:>9}" for name in FIGURES) + "  verdicts"]
    for row in rows:
        counts = "".join(f"{cell:>9}" for cell in _counts(row))
        figures = "".join(f" {figure:>9}" for figure in _figures(row))
        lines.append(f"{row.id:4} {row.name:22}{counts}{figures}  {_verdicts(row)}")
    return "\n".join([*lines, _left(rows)]) + "\n"


def as_markdown(rows: Sequence[Covered], runs: str) -> str:
    """The page of the documentation. runs: the command that made them."""
    total = Counter[str]()
    for row in rows:
        total.update(row.verdicts)
    verdicts = ", ".join(f"{count} {word}" for word, count in sorted(total.items()))
    head = ("id, name", "owed", *(phase.value for phase in Phase), *FIGURES, "verdicts")
    lines = [
        "# Coverage: which fault was active in which phase",
        "",
        f"Written by `hil coverage LEDGER --page FILE` from the runs of `{runs}`:",
        f"{sum(total.values())} runs ({verdicts}), each with one fault and its defaults. A number",
        "is how many runs saw the fault's first effect in that phase (of power-up faults that is",
        f"before anything moves). `{NOT_HERE}`: it makes no sense there, or nothing was stopped.",
        "Times are bench time from that effect, `ready` from the permission to go on: the worst",
        "of the row's runs. What is owed is in `fixtures/faults.yaml`, what the words mean in",
        "[trials.md](trials.md).",
        "",
        f"| {' | '.join(head)} |",
        f"|{'---|' * len(head)}",
    ]
    for row in rows:
        cells = (f"{row.id} `{row.name}`", row.owed, *_counts(row), *_figures(row), _verdicts(row))
        lines.append(f"| {' | '.join(cells)} |")
    return "\n".join([*lines, "", f"N{_left(rows)[1:]}."]) + "\n"


def _counts(row: Covered) -> list[str]:
    return [NOT_HERE if count is None else str(count) for count in row.active.values()]


def _figures(row: Covered) -> tuple[str, ...]:
    times = (_ms(time) for time in (row.detection, row.reaction, row.stop))
    return (*times, f"{row.exposure:.2f}", _ms(row.recovery))


def _verdicts(row: Covered) -> str:
    return ", ".join(f"{count} {word}" for word, count in sorted(row.verdicts.items()))


def _left(rows: Sequence[Covered]) -> str:
    left = [f"{row.id} ({', '.join(row.open)})" for row in rows if row.open]
    return f"never active where it makes sense: {'; '.join(left) or 'none'}"


def _ms(seconds: float | None) -> str:
    return NOT_HERE if seconds is None else f"{1e3 * seconds:.0f} ms"
