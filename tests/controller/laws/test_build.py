"""Laws by name, by import path, and from named numbers."""

import pytest

from controller.laws.bounds import Bounds
from controller.laws.build import build, law_class, laws, settings_of
from controller.laws.duan import DuanSettings
from controller.laws.soft import Soft


@pytest.mark.parametrize("name", sorted(laws()))
def test_every_law_is_built_by_its_name_with_its_defaults(name):
    axis = build(name, None, Bounds(), 8_000_000)
    axis.reset(0.1)
    assert axis.position == 0.1


def test_a_law_is_found_by_its_import_path():
    assert law_class("controller.laws.soft:Soft") is Soft


@pytest.mark.parametrize(
    ("name", "says"),
    [
        ("sfot", "there are constant, duan, paper, soft"),
        ("no.such.place:Law", "cannot be imported: No module named 'no'"),
        ("controller.laws.soft:Hard", "cannot be imported"),
        ("controller.laws.bounds:Bounds", "no class attribute Settings"),
    ],
)
def test_a_law_that_cannot_be_had_is_refused_in_one_line(name, says):
    with pytest.raises(ValueError, match=says) as error:
        law_class(name)
    assert "\n" not in str(error.value)


def test_named_numbers_fill_nested_groups():
    made = settings_of("soft", {"bandwidth": 0.5, "stiffness": {"stiffest": 100e3}})
    assert made.bandwidth == 0.5
    assert made.stiffness.stiffest == 100e3
    assert made.stiffness.softest == 1e3


def test_an_unknown_parameter_names_the_nearest():
    with pytest.raises(ValueError, match="did you mean 'stiffest'"):
        settings_of("soft", {"stiffness": {"stifest": 1.0}})


def test_settings_of_another_law_are_refused():
    with pytest.raises(ValueError, match="takes SoftSettings, found DuanSettings"):
        build("soft", DuanSettings(), Bounds(), 8_000_000)
