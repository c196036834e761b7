"""Results as text: tables for people, JSON for programs."""

from collections.abc import Iterable, Mapping, Sequence
from io import StringIO
from statistics import median
from typing import TYPE_CHECKING

import orjson
from rich.console import Console
from rich.table import Table

from hil.recording.diff import Comparison
from hil.recording.summary import Summary, timeline

if TYPE_CHECKING:
    from hil.bench.compare import Compared
    from hil.bench.run import Measured
    from hil.cell.clock import Lateness
    from hil.doctor.finding import Finding
    from hil.experiments.insertion import Row as Insertion
    from hil.experiments.insertion import Summary as InsertionSummary
    from hil.experiments.row import Row

WIDTH = 110
"""Columns; a fixed number, so that output does not depend on the terminal."""


def as_json(result: object) -> str:
    """A dataclass or a named tuple, or a list of them, as JSON; numpy's numbers are numbers."""
    options = orjson.OPT_INDENT_2 | orjson.OPT_SERIALIZE_NUMPY
    return orjson.dumps(result, default=_named, option=options).decode() + "\n"


def _named(value: object) -> dict[str, object]:
    """A named tuple by its fields: orjson knows none."""
    names = getattr(value, "_fields", None)
    if names is None:
        raise TypeError(type(value).__name__)
    return {name: getattr(value, name) for name in names}


def of_run(summary: Summary) -> str:
    """A run's outcome, then its time line."""
    return _text(_facts(facts(summary)), _timeline(summary), _counts(summary))


def facts(summary: Summary) -> list[tuple[str, str]]:
    """Name and value of what a reader of a run asks first."""
    f_z, slot, depth = summary.f_z, summary.slot_found, summary.depth
    return [
        ("rig, seed", f"{summary.rig}, {summary.seed}"),
        ("outcome", summary.outcome or "none recorded"),
        ("recording", summary.ending or "complete"),
        ("bench time", f"{summary.duration:.3f} s"),
        ("slot found", "never" if slot is None else f"{slot:.3f} s"),
        ("depth reached", "-" if depth is None else f"{depth * 1e3:.3f} mm"),
        ("f_z, period means", "-" if f_z is None else f"{f_z[0]:.2f} to {f_z[1]:.2f} N"),
        ("guard trips", str(summary.guard_trips)),
        ("deadlines missed", f"{summary.misses} (bench time)"),
        ("SHA-256", summary.digest),
    ]


def of_comparison(comparison: Comparison) -> str:
    """`same`, or what differs first."""
    if comparison.same:
        return "same\n"
    lines = [f"{name}: {left} | {right}" for name, left, right in comparison.identity]
    first = comparison.message
    if first is None:
        return "\n".join([*lines, "all messages are the same"]) + "\n"
    place = f"{first.topic} at {first.t * 1e-9:.9f} s"
    where = f"{place}, {first.field}" if first.field else place
    sides = (_cut(side) for side in (first.left, first.right))
    lines += [f"first difference: {where}", *(f"  {side}" for side in sides)]
    return "\n".join(lines) + "\n"


def of_facts(values: Mapping[str, str | int | float | None]) -> str:
    """One name and value a line; None is a dash."""
    named = values.items()
    return _text(_facts((key.replace("_", " "), _shown(value)) for key, value in named))


def of_rows(rows: "Sequence[Row]", *, json: bool) -> str:
    """An experiment's table."""
    if json:
        return as_json(list(rows))
    table = _table("target", "what", "measured", "allowed", "")
    for row in rows:
        table.add_row(*row[:4], "ok" if row.passed else "FAILED")
    return _text(table)


def of_bench(measured: "Sequence[Measured]") -> str:
    """Real-time factor of each case, and where a period's CPU time goes."""
    table = _table("case", "x real time", "periods", "CPU of a period / us")
    for entry in measured:
        spent = ", ".join(f"{name} {us:.0f}" for name, us in entry.parts.items())
        late = "" if entry.lateness is None else of_lateness(entry.lateness)
        speed = f"{entry.real_time_factor:.1f}"
        table.add_row(entry.case.name, speed, str(entry.periods), spent or late)
    return _text(table)


def of_ring(compared: "Sequence[Compared]") -> str:
    """Speed of each case and of the minimal ring, and their ratio: median (least to most)."""
    table = _table("case", "x real time", "minimal ring", "of the ring's speed")
    for entry in compared:
        spreads = [_spread(values) for values in (entry.loop, entry.ring, entry.ratios)]
        table.add_row(entry.case.name, *spreads)
    return _text(table)


def _spread(values: "Sequence[float]") -> str:
    return f"{median(values):.2f} ({min(values):.2f} to {max(values):.2f})"


def of_lateness(late: "Lateness") -> str:
    """How a paced run kept time, in one line."""
    forgone = f", {late.forgone / 1e9:.1f} s not made up for" if late.forgone else ""
    return (
        f"late p50 {late.p50 / 1e6:.2f} ms, p99 {late.p99 / 1e6:.2f} ms, "
        f"max {late.max / 1e6:.2f} ms, {late.missed} of {late.periods} periods missed{forgone}"
    )


def of_insertions(runs: "Sequence[Insertion]", summary: "InsertionSummary", *, json: bool) -> str:
    """Each run's ending, then what the series shows."""
    if json:
        return as_json({"runs": runs, "summary": summary})
    table = _table("seed", "ending", "steps", "t / s", "x real time", "reason")
    for run in runs:
        cells = (f"{run.seconds:.2f}", f"{run.real_time_factor:.1f}", run.reason)
        table.add_row(str(run.seed), run.kind, str(run.steps), *cells)
    low, high = 100 * summary.success_low, 100 * summary.success_high
    shown = [
        ("inserted", f"{summary.inserted} of {summary.runs}"),
        ("success", f"{100 * summary.success:.0f} %, 95 % interval {low:.0f} to {high:.0f} %"),
        ("steps, median", f"{summary.steps_median:g}"),
        ("endings", ", ".join(f"{kind} {n}" for kind, n in sorted(summary.endings.items()))),
    ]
    return _text(table, _facts(shown))


def of_findings(found: "Sequence[Finding]") -> str:
    """What `hil doctor` found; advice under what needs some."""
    table = _table("check", "", "found")
    for entry in found:
        advice = f"\n-> {entry.advice}" if entry.advice else ""
        table.add_row(entry.name, entry.verdict.value, entry.found + advice)
    return _text(table)


def _cut(text: str) -> str:
    return text if len(text) <= WIDTH else f"{text[: WIDTH - 4]} ..."


def _shown(value: str | float | None) -> str:
    return "-" if value is None else str(value)


def _facts(rows: Iterable[tuple[str, str]]) -> Table:
    table = Table(show_header=False, box=None, pad_edge=False)
    for row in rows:
        table.add_row(*row)
    return table


def _timeline(summary: Summary) -> Table:
    table = _table("t / s", "what", "")
    for entry in timeline(summary):
        table.add_row(f"{entry.t:9.3f}", entry.kind, entry.text)
    return table


def _counts(summary: Summary) -> Table:
    table = _table("channel", "messages")
    for topic, count in summary.counts.items():
        table.add_row(topic, str(count))
    return table


def _table(*columns: str) -> Table:
    table = Table(box=None, pad_edge=False, header_style="")
    for column in columns:
        table.add_column(column, overflow="fold")
    return table


def _text(*tables: Table) -> str:
    """Tables as plain text, a blank line between them, no spaces at line ends."""
    screen = StringIO()
    console = Console(file=screen, width=WIDTH, color_system=None, highlight=False, markup=False)
    for table in tables:
        console.print(table)
        console.print()
    lines = [line.rstrip() for line in screen.getvalue().splitlines()]
    return "\n".join(lines).rstrip() + "\n"
