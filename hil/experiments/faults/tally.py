"""What a campaign of faults came to."""

from collections import Counter
from collections.abc import Sequence
from dataclasses import dataclass

from hil.campaign.plan import Plan
from hil.campaign.run import Outcome, Run, Verdict, canonical

UNSAFE = (Verdict.FAILED, Verdict.ERROR, Verdict.CRASH, Verdict.HANG)


@dataclass(frozen=True, slots=True)
class Tally:
    """verdicts: runs by verdict. unsafe, vacuous: what to look at, a line each."""

    runs: int
    verdicts: dict[str, int]
    unsafe: list[str]
    vacuous: list[str]
    wall: float

    @property
    def safe(self) -> bool:
        return not self.unsafe


def tally(plan: Plan, outcomes: Sequence[Outcome]) -> Tally:
    """Of the plan's runs, in its order."""
    pairs = list(zip(plan.runs, outcomes, strict=True))
    return Tally(
        len(pairs),
        dict(sorted(Counter(outcome.verdict.value for outcome in outcomes).items())),
        [_line(run, outcome) for run, outcome in pairs if outcome.verdict in UNSAFE],
        [_line(run, outcome) for run, outcome in pairs if outcome.verdict is Verdict.VACUOUS],
        sum(outcome.wall for outcome in outcomes),
    )


def _line(run: Run, outcome: Outcome) -> str:
    what = canonical(run.variant.get("fault"))
    return f"{run.key.name} seed {run.seed} {what}: {outcome.verdict.value}: {outcome.reason}"


def as_text(found: Tally) -> str:
    """A count, then every run that was unsafe or proved nothing."""
    words = ", ".join(f"{count} {word}" for word, count in found.verdicts.items())
    head = f"{found.runs} runs: {words}; {len(found.unsafe)} unsafe; {found.wall:.0f} s of runs"
    return "\n".join([head, *found.unsafe, *found.vacuous]) + "\n"
