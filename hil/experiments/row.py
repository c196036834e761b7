"""One line of an experiment's table: what was wanted, what was measured, whether it will do."""

from typing import NamedTuple


class Row(NamedTuple):
    """target: the claim it belongs to. measured, allowed: numbers with their units, in words."""

    target: str
    what: str
    measured: str
    allowed: str
    passed: bool


def at_most(target: str, what: str, measured: float, bound: float, unit: str) -> Row:
    return Row(target, what, _text(measured, unit), f"<= {_text(bound, unit)}", measured <= bound)


def at_least(target: str, what: str, measured: float, bound: float, unit: str) -> Row:
    return Row(target, what, _text(measured, unit), f">= {_text(bound, unit)}", measured >= bound)


def within(target: str, what: str, measured: float, ideal: float, tolerance: float) -> Row:
    """`measured` against `ideal`, both in SI; tolerance as a fraction of the ideal."""
    allowed = f"{ideal:.4g} within {100 * tolerance:.3g} %"
    return Row(target, what, f"{measured:.4g}", allowed, abs(measured - ideal) <= tolerance * ideal)


def _text(value: float, unit: str) -> str:
    return f"{value:.3g} {unit}".rstrip()
