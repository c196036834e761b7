"""The page of Fig. 4: what the paper says, what was measured, and why they differ."""

from base64 import b64encode
from collections.abc import Sequence
from html import escape
from pathlib import Path

from hil.experiments.ffc.rows import Row, rows
from hil.experiments.ffc.runs import Training
from hil.experiments.ffc.table import as_text, shown
from hil.experiments.peg_in_hole.comparison import Comparison, as_html
from hil.experiments.peg_in_hole.figure import draw
from hil.view.page import document


def write(
    trainings: Sequence[Training], against: Sequence[Comparison], world: str, folder: Path
) -> Path:
    """`report.html` and `fig4.png` in the folder; the page."""
    folder.mkdir(parents=True, exist_ok=True)
    picture, page = folder / "fig4.png", folder / "report.html"
    seeds = len({training.seed for training in trainings})
    draw(trainings, f"world {world}, {seeds} seeds", picture)
    page.write_text(render(trainings, against, world, picture.read_bytes()), encoding="utf-8")
    return page


def render(
    trainings: Sequence[Training], against: Sequence[Comparison], world: str, picture: bytes
) -> str:
    """HTML with its picture inside; no script, no link."""
    found = rows(trainings)
    image = b64encode(picture).decode()
    claims = _claims({row.learner: row for row in found}) if world == "G0" else ""
    body = f"""<p>No robot and no physics: the search task alone. Rates in % of all episodes; each
figure with its 95 % bootstrap interval over seeds.</p>
<pre>{escape(as_text(found, paper=world != "G0"))}</pre>
{claims}
<h2>Steps by episode (Fig. 4)</h2>
<img alt="Mean steps of each episode by learner" src="data:image/png;base64,{image}">
{as_html(against)}"""
    return document(f"Learners on world {world}", body)


def _claims(found: dict[str, Row]) -> str:
    """Section 2's sentences beside the rows they speak of, as far as those were run."""
    n = [found[name] for name in (f"wdql n={count}" for count in (1, 2, 4, 6)) if name in found]
    shared = [row for name, row in found.items() if name.startswith("shared-")]
    others = [found[name] for name in ("ql", "dql", "ac", "pg", "ppo") if name in found]
    lines = [
        ("learning efficiency improves as n increases", _late(n),
         "every agent simulates the same model: only the simulated steps in all count, and past "
         "about 60 a real step more change nothing"),
        ("", _late(shared),
         "where n robots share tables on the true world, it does improve with n; but they take n "
         "times the steps, and one table spreads a reward faster than two"),
        ("with QL, DQL, AC, PG, PPO no notable drop", _late(others),
         "3,757 poses and one goal: a random walk finds it within 500 steps in 8 % of episodes, so "
         "there is hardly anything to learn from"),
    ]  # fmt: skip
    cells = "\n".join(
        f"<tr><td>{escape(said)}</td><td>{escape(measured)}</td><td>{escape(why)}</td></tr>"
        for said, measured, why in lines
        if measured
    )
    head = "<tr><td>the paper says</td><td>steps, episodes 31 on</td><td>why</td></tr>"
    return f"<h2>Claims</h2>\n<table>{head}\n{cells}</table>" if cells else ""


def _late(found: Sequence[Row]) -> str:
    return "; ".join(f"{row.learner}: {shown(row.late_steps)}" for row in found)
