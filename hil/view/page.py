"""A run as one HTML file that needs nothing else: outcome, picture, time line."""

from base64 import b64encode
from html import escape

from hil.recording.read import Recording
from hil.recording.summary import summarise, timeline
from hil.view.tables import facts

STYLE = """
body { font: 15px/1.45 system-ui, sans-serif; margin: 2rem auto; max-width: 62rem;
       padding: 0 1rem; color: #1c2026; }
h1 { font-size: 1.25rem; } h2 { font-size: 1rem; margin-top: 2rem; }
img { width: 100%; height: auto; }
table { border-collapse: collapse; } td { padding: .15rem 1.2rem .15rem 0; vertical-align: top; }
td:first-child { color: #555b66; white-space: nowrap; } td { overflow-wrap: anywhere; }
"""


def render(recording: Recording, picture: bytes) -> str:
    """HTML with the PNG inside it; no script, no link to anywhere."""
    summary = summarise(recording)
    title = escape(f"{summary.rig}, seed {summary.seed}")
    image = b64encode(picture).decode()
    entries = [(f"{e.t:.3f} s", f"{e.kind}: {e.text}") for e in timeline(summary)]
    return f"""<!doctype html>
<html lang="en">
<head><meta charset="utf-8"><meta name="viewport" content="width=device-width">
<title>{title}</title><style>{STYLE}</style></head>
<body>
<h1>{title}</h1>
{_table(facts(summary))}
<h2>Forces and depth</h2>
<img alt="Normal force, lateral forces and depth over bench time"
 src="data:image/png;base64,{image}">
<h2>Time line</h2>
{_table(entries)}
</body>
</html>
"""


def _table(rows: list[tuple[str, str]]) -> str:
    cells = "\n".join(f"<tr><td>{escape(a)}</td><td>{escape(b)}</td></tr>" for a, b in rows)
    return f"<table>\n{cells}\n</table>"
