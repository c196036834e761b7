"""Campaigns of the functions in behaviours.py, which workers import by name."""

from pathlib import Path

import pytest

from hil.campaign.campaign import Workers, carry_out
from hil.campaign.ledger import opened
from hil.campaign.plan import grid

HERE = Path(__file__).parent
CODE = "tested"


@pytest.fixture(autouse=True)
def _behaviours_can_be_imported(monkeypatch):
    monkeypatch.syspath_prepend(HERE)


@pytest.fixture
def plan():
    """A plan of one behaviour."""

    def make(name, seeds=range(1), *, limit=60.0, prepare="", **variant):
        function = f"behaviours:{name}"
        return grid(
            function, "name: bench", seeds, limit=limit, variants=[variant], prepare=prepare
        )

    return make


@pytest.fixture
def outcomes():
    """Carry a plan out with a ledger in memory, on one worker."""

    def carry(plan):
        with opened(None) as ledger:
            return carry_out(plan, ledger, Workers(), CODE)

    return carry


@pytest.fixture
def outcome(plan, outcomes):
    """What becomes of one run of a behaviour."""

    def one(name, **options):
        (found,) = outcomes(plan(name, **options))
        return found

    return one
