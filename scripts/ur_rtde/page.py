"""The compatibility page: rows and counts as Markdown."""

from collections import Counter
from collections.abc import Mapping

from case import Verdict

Results = Mapping[str, Mapping[str, Verdict]]
HEAD = """# Compatibility: ur_rtde 1.6.5

Written by `python scripts/ur_rtde/compatibility.py --write docs/compatibility.md`, not by hand.
An unmodified ur_rtde from PyPI runs against `hil up plate_ur5` (CB3 3.15, 125 Hz) and
`hil up plate_ur5e` (e-Series 5.11, 500 Hz) by the wall clock, client and cell in processes of their
own. There is a row for every public method of the installed client; each asserts the call's effect
(pose reached, force on the plant, output seen by another interface), not only what it returned.

| result | means |
|---|---|
| pass | the effect is there |
| no effect | the controller is too old for the call; asserted: the arm stands, control goes on |
| client bug | the call cannot work on any controller, for the reason given |
| FAIL | the emulation falls short, for the reason given |
"""


def text(results: Results) -> str:
    return "\n".join((HEAD, _counts(results), *_tables(results), _reasons(results)))


def _counts(results: Results) -> str:
    """How many rows of each interface came to what, a series."""
    lines = ["| interface | series | rows | pass | no effect | client bug | FAIL |"]
    lines.append("|---|---|---|---|---|---|---|")
    for interface in _interfaces(results):
        for series, found in results.items():
            mine = Counter(v.result for row, v in found.items() if _interface(row) == interface)
            numbers = [mine[result] for result in ("pass", "no effect", "client bug", "FAIL")]
            cells = " | ".join(str(number) for number in (sum(numbers), *numbers))
            lines.append(f"| {interface} | {series} | {cells} |")
    return "\n".join(lines) + "\n"


def _tables(results: Results) -> list[str]:
    return [_table(results, interface) for interface in _interfaces(results)]


def _table(results: Results, interface: str) -> str:
    lines = [f"## {interface}", "", f"| call | {' | '.join(results)} |"]
    lines.append("|---|" + "---|" * len(results))
    for row in _rows(results):
        if _interface(row) == interface:
            found = " | ".join(results[series][row].result for series in results)
            lines.append(f"| {row.partition('.')[2]} | {found} |")
    return "\n".join(lines) + "\n"


def _reasons(results: Results) -> str:
    """Why a row did not pass, once for all series that share the reason."""
    found: dict[tuple[str, str], list[str]] = {}
    for series, verdicts in results.items():
        for row, verdict in verdicts.items():
            if verdict.reason:
                found.setdefault((row, verdict.reason), []).append(series)
    lines = ["## Reasons", ""]
    lines += [
        f"- `{row}` ({', '.join(series)}): {reason}" for (row, reason), series in found.items()
    ]
    return "\n".join(lines) + "\n"


def _rows(results: Results) -> list[str]:
    return list(next(iter(results.values())))


def _interfaces(results: Results) -> list[str]:
    return list(dict.fromkeys(_interface(row) for row in _rows(results)))


def _interface(row: str) -> str:
    return row.partition(".")[0]
