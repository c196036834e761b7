"""What a ledger shows: how many runs ended how, and which ones did not pass."""

from collections import Counter
from collections.abc import Iterable
from dataclasses import dataclass
from pathlib import Path

from hil.campaign.ledger import Entry, Ledger
from hil.campaign.run import Outcome, Run, Verdict


@dataclass(frozen=True, slots=True)
class Broken:
    """A run that did not pass. run: its name, for `hil campaign rerun`."""

    run: str
    function: str
    seed: int
    variant: str
    code: str
    verdict: str
    reason: str


@dataclass(frozen=True, slots=True)
class Summary:
    """verdicts: runs by how they ended. codes: runs by what computed them. wall: s of all runs."""

    digest: str
    runs: int
    verdicts: dict[str, int]
    codes: dict[str, int]
    wall: float
    broken: list[Broken]


def summarise(ledger: Ledger) -> Summary:
    entries = list(ledger.entries())
    return Summary(
        ledger.digest(),
        len(entries),
        _counted(entry.outcome.verdict.value for entry in entries),
        _counted(entry.code for entry in entries),
        round(sum(entry.outcome.wall for entry in entries), 3),
        [_broken(entry) for entry in entries if entry.outcome.verdict is not Verdict.PASSED],
    )


def as_text(summary: Summary, path: Path) -> str:
    """Counts, then a line for each run that did not pass, then the command for one of them."""
    verdicts = ", ".join(f"{verdict} {n}" for verdict, n in summary.verdicts.items()) or "none"
    lines = [f"{summary.runs} runs: {verdicts}; {summary.wall:.0f} s of work"]
    lines += [f"{n} by {code}" for code, n in summary.codes.items()]
    for broken in summary.broken:
        variant = "" if broken.variant == "{}" else f" {broken.variant}"
        why = f": {broken.reason}" if broken.reason else ""
        lines.append(f"{broken.run} {broken.verdict:<7} seed {broken.seed}{variant}{why}")
    if summary.broken:
        lines.append(f"again: hil campaign rerun {path} {summary.broken[0].run}")
    return "\n".join([*lines, f"SHA-256 {summary.digest}"]) + "\n"


def of_outcome(run: Run, outcome: Outcome) -> str:
    """One run's verdict and figures; where it broke, if it did."""
    why = f": {outcome.reason}" if outcome.reason else ""
    lines = [f"{outcome.verdict.value}{why}", f"{run.function}, seed {run.seed}"]
    lines += [f"{name}: {value}" for name, value in outcome.figures.items()]
    return "\n".join([*lines, outcome.trace]).rstrip() + "\n"


def _broken(entry: Entry) -> Broken:
    key, outcome = entry.key, entry.outcome
    return Broken(
        key.name,
        key.function,
        key.seed,
        key.variant,
        entry.code,
        outcome.verdict.value,
        outcome.reason,
    )


def _counted(words: Iterable[str]) -> dict[str, int]:
    return dict(sorted(Counter(words).items()))
