"""The report page: what the paper says, what was measured, and why they differ."""

from collections.abc import Sequence

from hil.experiments.force_tracking.grid import Grid
from hil.experiments.force_tracking.table import Series, as_text, ratio

INTRODUCTION = """\
# Force tracking on a curved surface

Section 3.4 of the paper: from x_c(0) = 0.193 m through free space into contact, then along a curved
surface, at f_d = {force:g} N. Over RTDE and CAN in lockstep, with noise and latency, {runs} runs a
row, parameters `{preset}`. Figures are of the true force on the tool. What the paper does not give
(surface, stiffness, delay, p2, p3, every unit) is this project's choice.

```
{table}```
"""

CLAIMS = (
    (
        "the proposed AIC tracks better than the common AIC, and that better than IC",
        "a constant gain leaves the error b v on a moving surface, and what integrates the force "
        "error removes it; how much may be integrated is a matter of the range of stiffness and "
        "the delay, so the order is one of parameters as much as of laws",
    ),
    (
        "without a large force overshoot",
        "true on soft contacts only: the gains grow with the error, while a stiff contact needs "
        "smaller ones, and about 40 ms of loop delay stand between force and motion",
    ),
    (
        "asymptotically stable by Lyapunov's theorem",
        "the proof has no delay, no robot lag, no noise and a still surface; Eqs. 16 to 25 "
        "contradict one another in signs and factors. The corrected function falls for the ideal "
        "loop; the loop with delay is another system",
    ),
)


CABLE = """# Force laws on the paper's cable, pressed on its connector

f_d = {force:g} N, {runs} runs a row, each with a cable and friction of its own, parameters
`{preset}`. k_e is the stiffness of the jaws' pad, the softest thing behind the cable. Static error
holds what the rig's sensor errs by: its gain alone is 1 %.

{table}
"""


def page(grid: Grid, rows: Sequence[Series]) -> str:
    """The report in Markdown."""
    runs = rows[0].runs if rows else 0
    if grid.cable:
        table = as_text(rows)
        head = CABLE.format(force=grid.force, runs=runs, preset=grid.preset, table=table)
        return head + _stability(rows) + "\n"
    head = INTRODUCTION.format(force=grid.force, runs=runs, preset=grid.preset, table=as_text(rows))
    return "\n".join([head, _claims(rows), _stability(rows), _ratios(grid, rows)])


def _claims(rows: Sequence[Series]) -> str:
    measured = (_order(rows), _overshoot(rows), _unstable(rows, "paper"))
    lines = ["| the paper says | measured here | why |", "|---|---|---|"]
    lines += [
        f"| {claim} | {found} | {why} |"
        for (claim, why), found in zip(CLAIMS, measured, strict=True)
    ]
    return "\n".join(lines) + "\n"


def _order(rows: Sequence[Series]) -> str:
    """Where the paper's order of tracking errors holds, and where it does not."""
    holds: list[str] = []
    fails: list[str] = []
    for place, laws in _by_cell(rows).items():
        three = [laws.get(name) for name in ("paper", "duan", "constant")]
        errors = [
            row.rms_tracking if row is not None and not row.unstable else None for row in three
        ]
        known = [error for error in errors if error is not None]
        ordered = len(known) == 3 and known == sorted(known)
        (holds if ordered else fails).append(place)
    if not holds and not fails:
        return "not run"
    return f"holds at {_places(holds)}; not at {_places(fails)}"


def _overshoot(rows: Sequence[Series]) -> str:
    of = [row for row in rows if row.law == "paper" and row.overshoot_p95 is not None]
    if not of:
        return "no stable run"
    return ", ".join(f"{row.overshoot_p95:.0f} % at {_place(row)}" for row in of)


def _unstable(rows: Sequence[Series], law: str) -> str:
    bad = [f"{row.unstable}/{row.runs} at {_place(row)}" for row in rows
           if row.law == law and row.unstable]  # fmt: skip
    return "unstable: " + ", ".join(bad) if bad else "no unstable run in this grid"


def _stability(rows: Sequence[Series]) -> str:
    laws = dict.fromkeys(row.law for row in rows)
    return "\n".join(["## Unstable runs\n", *(f"* {law}: {_unstable(rows, law)}" for law in laws)])


def _ratios(grid: Grid, rows: Sequence[Series]) -> str:
    """Tracking error of every law over SOFT's, where both are stable; below 1, SOFT loses."""
    lines = ["\n## Tracking error over that of `soft` (geometric mean where both are stable)\n"]
    for law in grid.laws:
        found = ratio(rows, law, "soft", "rms_tracking") if law != "soft" else None
        if found is not None:
            lines.append(f"* {law}: {found:.2f}")
    lost = [
        f"{row.law} at {_place(row)} ({row.rms_tracking:.2f} N)"
        for laws in _by_cell(rows).values()
        for row in laws.values()
        if _beats_soft(row, laws.get("soft"))
    ]
    lines.append(f"\nWhere `soft` tracks worse: {', '.join(lost) or 'nowhere in this grid'}.\n")
    return "\n".join(lines)


def _beats_soft(row: Series, soft: Series | None) -> bool:
    if soft is None or row.law == "soft" or row.unstable:
        return False
    ours, theirs = soft.rms_tracking, row.rms_tracking
    return ours is not None and theirs is not None and theirs < ours


def _by_cell(rows: Sequence[Series]) -> dict[str, dict[str, Series]]:
    cells: dict[str, dict[str, Series]] = {}
    for row in rows:
        cells.setdefault(_place(row), {})[row.law] = row
    return cells


def _place(row: Series) -> str:
    return f"{row.k_e:g} N/mm, {row.latency_ms:g} ms, {row.rate_hz} Hz"


def _places(places: Sequence[str]) -> str:
    return "; ".join(places) or "none of the cells"
