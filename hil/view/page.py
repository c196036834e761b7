"""A run as one HTML file that needs nothing else: outcome, picture, time line."""

from base64 import b64encode
from html import escape

from hil.recording.read import Recording
from hil.recording.summary import summarise, timeline
from hil.view.tables import facts

_STYLE = """
body { font: 15px/1.45 system-ui, sans-serif; margin: 2rem auto; max-width: 62rem;
       padding: 0 1rem; color: #1c2026; }
h1 { font-size: 1.25rem; } h2 { font-size: 1rem; margin-top: 2rem; }
img { width: 100%; height: auto; }
table { border-collapse: collapse; } td { padding: .15rem 1.2rem .15rem 0; vertical-align: top; }
td:first-child { color: #555b66; white-space: nowrap; } td { overflow-wrap: anywhere; }
pre { font-size: 11px; overflow-x: auto; }
"""


def document(title: str, body: str) -> str:
    """A page under its title as plain text; body: HTML."""
    shown = escape(title)
    return f"""<!doctype html>
<html lang="en">
<head><meta charset="utf-8"><meta name="viewport" content="width=device-width">
<title>{shown}</title><style>{_STYLE}</style></head>
<body>
<h1>{shown}</h1>
{body}
</body>
</html>
"""


def render(recording: Recording, picture: bytes) -> str:
    """HTML with the PNG inside it; no script, no link to anywhere."""
    summary = summarise(recording)
    image = b64encode(picture).decode()
    entries = [(f"{e.t:.3f} s", f"{e.kind}: {e.text}") for e in timeline(summary)]
    body = f"""{_table(facts(summary))}
<h2>Forces and depth</h2>
<img alt="Normal force, lateral forces and depth over bench time"
 src="data:image/png;base64,{image}">
<h2>Time line</h2>
{_table(entries)}"""
    return document(f"{summary.rig}, seed {summary.seed}", body)


def _table(rows: list[tuple[str, str]]) -> str:
    cells = "\n".join(f"<tr><td>{escape(a)}</td><td>{escape(b)}</td></tr>" for a, b in rows)
    return f"<table>\n{cells}\n</table>"
