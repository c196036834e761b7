"""The catalogue of faults for a screen, a program and a page of the documentation."""

from hil.cell.faults.catalogue import CATALOGUE
from hil.cell.faults.row import EVERYWHERE, Parameter, Row


def as_rows() -> list[dict[str, object]]:
    """For programs; defaults in SI."""
    return [
        {
            "id": row.id,
            "name": row.name,
            "title": row.title,
            "target": row.place.value,
            "parameters": [_parameter(parameter) for parameter in row.parameters],
            "lasting": row.lasting,
            "power_up_only": row.start,
            "phases": [phase.value for phase in row.phases],
            "safe": row.safe,
            "proof": row.proof,
        }
        for row in CATALOGUE
    ]


def as_text() -> str:
    """For a terminal: three lines a fault."""
    return "".join(
        f"{row.id:4} {row.name:22} {row.title} ({row.place.value})\n"
        f"     params: {_parameters(row) or 'none'}\n"
        f"     safe:   {row.safe}; seen by: {row.proof}\n"
        for row in CATALOGUE
    )


def as_markdown() -> str:
    """For docs/faults.md: a table a place."""
    lines: list[str] = []
    for place in dict.fromkeys(row.place for row in CATALOGUE):
        lines += [f"### {place.value}", "", _HEAD, "|---|---|---|---|---|---|"]
        lines += [_line(row) for row in CATALOGUE if row.place is place]
        lines.append("")
    return "\n".join(lines)


_HEAD = "| id, name | fault | parameters: default (allowed) | phases | a safe system | seen by |"


def _line(row: Row) -> str:
    phases = "all" if row.phases == EVERYWHERE else ", ".join(row.phases)
    when = "power-up only" if row.start else "a duration" if row.lasting else "one moment"
    cells = (
        f"**{row.id}** `{row.name}`", f"{row.title} ({when})", _parameters(row) or "none", phases,
        row.safe, row.proof,
    )  # fmt: skip
    return f"| {' | '.join(cells)} |"


def _parameters(row: Row) -> str:
    return "; ".join(
        f"{parameter.name}: {_default(parameter)} ({parameter.allowed})"
        for parameter in row.parameters
    )


def _default(parameter: Parameter) -> str:
    if isinstance(parameter.default, str):
        return parameter.default
    return f"{parameter.default:g} {parameter.unit}".rstrip()


def _parameter(parameter: Parameter) -> dict[str, object]:
    return {
        "name": parameter.name,
        "default": parameter.default,
        "unit": parameter.unit,
        "allowed": parameter.allowed,
    }
