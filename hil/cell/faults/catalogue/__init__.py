"""The catalogue: every fault that can be injected, a file for each end of the cell."""

from difflib import get_close_matches
from typing import Final

from hil.cell.errors import FaultError
from hil.cell.faults.catalogue.bus import BUS
from hil.cell.faults.catalogue.host import HOST
from hil.cell.faults.catalogue.learner import LEARNER
from hil.cell.faults.catalogue.link import LINK
from hil.cell.faults.catalogue.part import PART
from hil.cell.faults.catalogue.robot import ROBOT
from hil.cell.faults.catalogue.sensor import SENSOR
from hil.cell.faults.row import Row

CATALOGUE: Final[tuple[Row, ...]] = LINK + ROBOT + BUS + SENSOR + PART + HOST + LEARNER

_BY_KIND: Final = {row.id: row for row in CATALOGUE} | {row.name: row for row in CATALOGUE}


def row(kind: str) -> Row:
    """The row of an id ("C1") or a name ("can.drop"); FaultError says which one is near."""
    found = _BY_KIND.get(kind) or _BY_KIND.get(kind.upper())
    if found is None:
        near = get_close_matches(kind, _BY_KIND, n=1, cutoff=0.3)
        hint = f"; did you mean '{near[0]}'?" if near else ""
        raise FaultError(f"no fault '{kind}'{hint} (`hil faults list` shows all of them)")
    return found
