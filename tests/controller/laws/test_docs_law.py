"""The law that the documentation shows, taken from its page."""

import re
from pathlib import Path

import pytest

from hil_fixtures.law_contract import LawContract

PAGE = Path(__file__).parents[3] / "docs" / "force_laws.md"


class TestPi(LawContract):
    @pytest.fixture
    def make_law(self):
        code = re.findall(r"```python\n(.*?)```", PAGE.read_text(encoding="utf-8"), re.DOTALL)[0]
        assert len(code.splitlines()) <= 40
        names = {"__name__": "pi"}
        exec(code, names)
        return lambda bounds, period: names["Pi"](names["PiSettings"](), bounds, period)
