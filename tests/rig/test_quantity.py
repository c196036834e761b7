import math

import pytest
from hypothesis import given
from hypothesis import strategies as st

from hil.cell.errors import RigError
from hil.cell.rig import parse
from hil.cell.rig.quantity import parse as quantity

UNITS = {
    "m": {"m": 1.0, "mm": 1e-3, "cm": 1e-2, "um": 1e-6, "µm": 1e-6, "inch": 25.4e-3},
    "rad": {"rad": 1.0, "deg": math.pi / 180, "°": math.pi / 180, "mrad": 1e-3},
    "s": {"s": 1.0, "ms": 1e-3, "us": 1e-6, "min": 60.0},
    "N": {"N": 1.0, "kN": 1e3, "kg*m/s^2": 1.0, "kg m / s**2": 1.0},
    "N*m": {"N*m": 1.0, "mN*m": 1e-3, "N*mm": 1e-3},
    "Hz": {"Hz": 1.0, "kHz": 1e3},
    "kg": {"kg": 1.0, "g": 1e-3},
    "Pa": {"Pa": 1.0, "MPa": 1e6, "GPa": 1e9, "N/mm**2": 1e6},
    "m/s": {"m/s": 1.0, "mm/s": 1e-3},
    "N/m": {"N/m": 1.0, "N/mm": 1e3, "kN/m": 1e3},
    "N*m/rad": {"N*m/rad": 1.0, "mN*m/mrad": 1.0},
    "bit/s": {"bit/s": 1.0, "kbit/s": 1e3, "Mbit/s": 1e6},
}
"""SI units of rig files, each with others of its dimension and their factors."""

numbers = st.floats(-1e9, 1e9)


@st.composite
def written(draw):
    """(SI unit, unit of its dimension, factor)."""
    si = draw(st.sampled_from(sorted(UNITS)))
    unit = draw(st.sampled_from(sorted(UNITS[si])))
    return si, unit, UNITS[si][unit]


@given(numbers, written())
def test_any_unit_of_the_dimension_gives_the_same_si_value(number, unit):
    si, found, factor = unit
    assert quantity(f"{number!r} {found}", si) == pytest.approx(number * factor, rel=1e-12)


@given(numbers)
def test_the_si_unit_keeps_every_bit(number):
    assert quantity(f"{number!r} m", "m") == number


@pytest.mark.parametrize("text", ["18.5 mm", "18.5mm", " 18.5  mm ", "+1.85e1 mm", "1.85E-2 m"])
def test_spaces_signs_and_exponents_are_a_matter_of_taste(text):
    assert quantity(text, "m") == pytest.approx(18.5e-3, rel=1e-15)


@given(st.sampled_from(sorted(UNITS)), written())
def test_another_dimension_is_refused_with_what_was_found_and_what_is_wanted(wanted, unit):
    si, found, _ = unit
    # Pint has no dimension for angles: N*m/rad is N*m, and a bit is a number.
    if {si, wanted} in ({"N*m", "N*m/rad"}, {"Hz", "bit/s"}) or si == wanted:
        return
    with pytest.raises(ValueError, match="is not a quantity in") as refusal:
        quantity(f"1 {found}", wanted)
    assert found in str(refusal.value)
    assert wanted in str(refusal.value)


@pytest.mark.parametrize("value", [1, 18.5, True, None, [1], {"m": 1}])
def test_a_number_without_a_unit_is_refused(value):
    with pytest.raises(ValueError, match="has no unit"):
        quantity(value, "m")


@pytest.mark.parametrize("text", ["nan m", "-inf m", "Infinity m", "1e400 m", "1e308 km"])
def test_what_is_not_finite_is_refused(text):
    with pytest.raises(ValueError, match=r"not finite|not a number"):
        quantity(text, "m")


@pytest.mark.parametrize(
    "text",
    ["18,5 mm", "1 m; 2", "[1,2] m", "1..2 m", "1 + 1 m", "2 * 3 m", "(1 m", "1/0 m", "9**9**9 m"],
)
def test_text_is_never_evaluated_as_arithmetic(text):
    with pytest.raises(ValueError, match="is not a number and a unit"):
        quantity(text, "m")


@given(st.text(max_size=12))
def test_nonsense_is_refused_in_one_line_that_quotes_it(text):
    with pytest.raises(ValueError, match="is not") as refusal:
        quantity(text, "m^7/s")  # of no unit's dimension
    assert repr(text) in str(refusal.value)
    assert "\n" not in str(refusal.value)


@pytest.mark.parametrize(
    ("line", "key"),
    [
        ("cable: {width: 18.5}", "cable.width"),
        ("cable: {width: 18.5 kg}", "cable.width"),
        ("robot: {servo: {bandwidth: fast}}", "robot.servo.bandwidth"),
        ("connector: {position: [1 m, nan m, 0 m]}", "connector.position.1"),
        ("latency: {rtde: {to_cell: {mean: '18,5 ms'}}}", "latency.rtde.to_cell.mean"),
    ],
)
def test_a_rig_names_the_key_of_a_bad_quantity_in_one_line(line, key):
    with pytest.raises(RigError) as refusal:
        parse(f"name: x\n{line}")
    assert str(refusal.value).startswith(f"{key}: ")
    assert "\n" not in str(refusal.value)
