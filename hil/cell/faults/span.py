"""A stretch of bench time as people write it: "3 cycles" or "0.2 s"."""

import re
from typing import Final, NamedTuple

from hil.cell.errors import FaultError
from hil.cell.rig import quantity

NS: Final = 1_000_000_000
_CYCLES: Final = re.compile(r"\+?\s*(\d+)\s*cycles?")


class Span(NamedTuple):
    """Control periods, or ns, of which one is 0."""

    cycles: int = 0
    ns: int = 0

    def long(self, period: int) -> int:
        """Its length, ns, with this control period, ns."""
        return self.cycles * period + self.ns

    def __str__(self) -> str:
        if self.cycles or not self.ns:
            return f"{self.cycles} cycles"
        return f"{self.ns / NS!r} s"


NOW: Final = Span()


def span(key: str, text: object) -> Span:
    """Parse it; a bare whole number counts cycles. FaultError names `key`."""
    if isinstance(text, int) and not isinstance(text, bool) and text >= 0:
        return Span(cycles=text)
    written = text.strip() if isinstance(text, str) else ""
    if found := _CYCLES.fullmatch(written):
        return Span(cycles=int(found[1]))
    try:
        seconds = quantity.parse(written.removeprefix("+").strip() if written else text, "s")
    except ValueError:
        seconds = -1.0
    if seconds < 0.0:
        raise FaultError(f"{key}: {text!r} is not a time such as '3 cycles' or '0.2 s'")
    return Span(ns=round(seconds * NS))
