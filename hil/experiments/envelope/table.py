"""The campaign's table, one line a family, as Markdown."""

from collections.abc import Sequence

from hil.experiments.envelope.experiment import FamilyResult, Spread

HEAD = (
    "| family | loops | unstable | overshoot %: median, p95, most | settling s | rms still N"
    " | peak / f_d | peak / bound | over bound | lost contact |\n"
)


def as_text(results: Sequence[FamilyResult]) -> str:
    rule = "|---" * HEAD.count(" | ") + "|---|\n"
    return HEAD + rule + "".join(map(_line, results))


def _line(result: FamilyResult) -> str:
    cells = (
        result.family, str(result.loops), str(result.unstable), _three(result.overshoot),
        _three(result.settling), _three(result.rms_still), f"{result.peak_over_force:.2f}",
        f"{result.peak_over_bound:.3f}", str(result.over_bound), str(result.lost),
    )  # fmt: skip
    return f"| {' | '.join(cells)} |\n"


def _three(spread: Spread) -> str:
    return ", ".join(f"{value:.2g}" for value in spread)
