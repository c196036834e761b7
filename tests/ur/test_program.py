"""The uploaded URScript: what is filled in, and what cannot be."""

import re

import pytest

from drivers.ur.program import ServoProgram


def test_nothing_is_left_to_fill_in():
    assert "$" not in ServoProgram().text(125)


def test_numbers_have_no_exponent_which_urscript_might_not_read():
    text = ServoProgram(tcp=(1e-7, 0.0, 0.12, 0.0, 0.0, 3.1), mass=1e-5).text(125)
    assert "set_tcp(p[0.000000100, 0.000000000, 0.120000000," in text
    assert re.search(r"\de[-+]?\d", text) is None


@pytest.mark.parametrize(("rate", "cycles"), [(125, 25), (500, 100)])
def test_silence_is_the_same_time_at_every_rate(rate, cycles):
    assert f"silent >= {cycles}:" in ServoProgram(silence=0.2).text(rate)


def test_the_program_is_one_def_that_ends():
    lines = ServoProgram().text(125).splitlines()
    assert lines[0].startswith("def ")
    assert [line for line in lines if not line.startswith(" ")] == [lines[0], "end"]


@pytest.mark.parametrize(
    "parameter",
    [
        {"lookahead": 0.02},
        {"gain": 2001.0},
        {"mass": -0.1},
        {"deceleration": 0.0},
        {"silence": 3},
        {"step": 0.0},
        {"turn": 2.0},
    ],
)
def test_parameters_outside_the_manuals_range_are_refused(parameter):
    (name,) = parameter
    with pytest.raises(ValueError, match=f"{name} is"):
        ServoProgram(**parameter)
