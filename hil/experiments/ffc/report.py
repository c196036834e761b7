"""The report: what the paper says, what was measured, and why they differ; one HTML file."""

from base64 import b64encode
from collections.abc import Mapping, Sequence
from html import escape
from pathlib import Path

from hil.experiments.ffc.figures import draw, groups
from hil.experiments.ffc.rows import Estimate, Row, rows
from hil.experiments.ffc.runs import Training
from hil.experiments.ffc.table import as_text
from hil.experiments.peg_in_hole.comparison import Comparison, comparisons
from hil.view.page import STYLE

CAPTIONS = {
    "fig9.png": "Success and failures by cause and by episode (Fig. 9)",
    "fig10.png": "Steps by episode and execution times (Fig. 10)",
    "fig11.png": "Contact force of one episode (Fig. 11)",
    "fig12.png": "Worth of poses after the last episode (Fig. 12)",
}
REFERENCE = "wdql"


def write(trainings: Sequence[Training], rig: str, folder: Path) -> list[Path]:
    """Figures and `report.html`; their paths, the page first."""
    folder.mkdir(parents=True, exist_ok=True)
    pictures = draw(groups(trainings), folder)
    page = folder / "report.html"
    page.write_text(render(trainings, rig, pictures), encoding="utf-8")
    return [page, *pictures]


def render(trainings: Sequence[Training], rig: str, pictures: Sequence[Path]) -> str:
    """HTML with its pictures inside; no script, no link."""
    found = rows(trainings)
    figures = "\n".join(_picture(path) for path in pictures)
    title = escape(f"Learning to insert a flexible flat cable: rig {rig}")
    return f"""<!doctype html>
<html lang="en">
<head><meta charset="utf-8"><title>{title}</title><style>{STYLE}
pre {{ font-size: 11px; overflow-x: auto; }}</style></head>
<body>
<h1>{title}</h1>
<p>Every episode over RTDE and CAN in lockstep. Rates in % of all episodes; each figure with its
95 % bootstrap interval over seeds.</p>
<pre>{escape(as_text(found))}</pre>
{_claims({row.learner: row for row in found})}
{_better(comparisons(trainings, REFERENCE))}
{figures}
</body>
</html>
"""


def _picture(path: Path) -> str:
    image = b64encode(path.read_bytes()).decode()
    caption = escape(CAPTIONS[path.name])
    return f'<h2>{caption}</h2>\n<img alt="{caption}" src="data:image/png;base64,{image}">'


def _claims(found: Mapping[str, Row]) -> str:
    """The paper's sentences beside the row of its learner."""
    row = found.get(REFERENCE)
    if row is None:
        return ""
    lines = [
        ("92 % success, 6 % danger, 2 % step limit, in one run of 50 episodes",
         f"{_percent(row.success)}, {_percent(row.danger)}, {_percent(row.step_limit)}",
         "one run says 81 to 97 % (Wilson). Here the box has 847 poses and the mouth takes the "
         "cable within 0.3 mm; steps along the slot cause nearly all dangers"),
        ("about 20 steps after 15 episodes",
         f"five in a row within 20 steps from episode {_plain(row.episodes_to_20_steps)}; "
         f"from the 31st on {_plain(row.late_steps)} steps",
         "15 % of steps are random; the table knows the pose alone, so it mistakes a cable caught "
         "in the slot's mouth, which no step across it can move, for one on the face"),
        ("about 30 steps with FFC2",
         f"first episode {_plain(row.ffc2_first_steps_mean)} in the mean, "
         f"{_plain(row.ffc2_first_steps_iqm)} in the middle half",
         "the tables still point to where FFC1 went in: a few runs search for long, and two "
         "episodes cannot show it"),
    ]  # fmt: skip
    cells = "\n".join(
        f"<tr><td>{escape(a)}</td><td>{escape(b)}</td><td>{escape(c)}</td></tr>"
        for a, b, c in lines
    )
    head = "<tr><td>the paper says</td><td>measured</td><td>why</td></tr>"
    return f"<h2>Claims</h2>\n<table>{head}\n{cells}</table>"


def _better(found: Sequence[Comparison]) -> str:
    if not found:
        return ""
    lines = "\n".join(
        f"<tr><td>{escape(one.learner)}</td><td>{_plain(one.success)}</td>"
        f"<td>{_plain(one.danger)}</td><td>{_plain(one.training_steps)}</td></tr>"
        for one in found
    )
    return (
        f"<h2>Probability that a run is better than one of {REFERENCE}</h2>\n<table>"
        "<tr><td>learner</td><td>more success</td><td>fewer dangers</td><td>fewer steps</td></tr>\n"
        f"{lines}</table>"
    )


def _percent(estimate: Estimate) -> str:
    low, high = 100 * estimate.low, 100 * estimate.high
    return f"{100 * estimate.value:.3g} % [{low:.3g}, {high:.3g}]"


def _plain(estimate: Estimate) -> str:
    return f"{estimate.value:.3g} [{estimate.low:.3g}, {estimate.high:.3g}]"
