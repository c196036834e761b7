import pytest

from controller.laws.constant import Constant, ConstantSettings
from controller.laws.duan import Duan
from controller.laws.paper_aic import PaperAic
from controller.laws.soft import Soft
from hil_fixtures.law_contract import LawContract


def maker(law, settings=None):
    return lambda bounds, period: law(settings or law.Settings(), bounds, period)


class TestConstant(LawContract):
    @pytest.fixture
    def make_law(self):
        return maker(Constant, ConstantSettings(1.0, 400.0))


class TestDuan(LawContract):
    tolerance = 0.1

    @pytest.fixture
    def make_law(self):
        return maker(Duan)


class TestPaper(LawContract):
    stiffness = 2e3

    @pytest.fixture
    def make_law(self):
        return maker(PaperAic)


class TestSoft(LawContract):
    @pytest.fixture
    def make_law(self):
        return maker(Soft)


class TestSoftOnAStiffContact(LawContract):
    stiffness = 50e3

    @pytest.fixture
    def make_law(self):
        return maker(Soft)
