"""The catalogue: fifty-two rows with stable ids, each complete, each found by id and by name."""

import pytest

from hil.cell.errors import FaultError
from hil.cell.faults.catalogue import CATALOGUE, row

COUNTS = {"T": 12, "R": 10, "C": 9, "S": 6, "G": 2, "P": 4, "H": 4, "L": 5}
IDS = [f"{family}{n}" for family, count in COUNTS.items() for n in range(1, count + 1)]


def test_the_catalogue_has_the_52_ids_that_reports_and_markers_rely_on():
    assert [row.id for row in CATALOGUE] == IDS


def test_names_differ_and_never_look_like_ids():
    names = [row.name for row in CATALOGUE]
    assert len(set(names)) == 52
    assert not set(names) & set(IDS)
    assert all("." in name for name in names)


@pytest.mark.parametrize("found", CATALOGUE, ids=lambda row: row.id)
def test_every_row_says_what_is_safe_what_proves_it_and_where_it_makes_sense(found):
    assert found.title
    assert found.safe
    assert found.proof
    assert found.phases
    assert row(found.id) is row(found.name) is row(found.id.lower()) is found


@pytest.mark.parametrize("found", CATALOGUE, ids=lambda row: row.id)
def test_every_default_is_within_what_its_parameter_allows(found):
    for parameter in found.parameters:
        if parameter.choices:
            assert parameter.default in parameter.choices
        else:
            assert parameter.low <= parameter.default <= parameter.high
        assert parameter.allowed


def test_an_unknown_fault_is_named_with_the_nearest_one():
    with pytest.raises(FaultError, match=r"no fault 'can.drip'; did you mean 'can.drop'\?"):
        row("can.drip")
