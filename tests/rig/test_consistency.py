import pytest

from hil.cell.errors import RigError
from hil.cell.rig import parse

PART = "name: FFC1, position: [0 m, 0 m, 0 m]"


@pytest.mark.parametrize(
    ("text", "complaint"),
    [
        ("cable: {thickness: 0.4 mm}", "connector.height must exceed cable.thickness"),
        ("cable: {width: 18.56 mm}", "connector.width must exceed cable.width"),
        ("task: {goal_depth: 2.6 mm}", "task.goal_depth lies below the slot's floor"),
        (f"fixture: {{parts: [{{{PART}}}, {{{PART}}}]}}", "fixture.parts: names must differ"),
    ],
)
def test_a_cell_that_cannot_be_built_is_refused(text, complaint):
    with pytest.raises(RigError, match=complaint) as refusal:
        parse(f"name: x\n{text}")
    assert "\n" not in str(refusal.value)


@pytest.mark.parametrize(
    ("key", "value"),
    [
        ("cable: {width", "0 mm"),
        ("cable: {thickness", "-0.3 mm"),
        ("cable: {modulus", "0 GPa"),
        ("pad: {stiffness_z", "-20 N/mm"),
        ("connector: {depth", "0 mm"),
        ("connector: {chamfer", "-0.1 mm"),
        ("fixture: {play", "-0.8 mm"),
        ("tool: {mass", "-1 kg"),
        ("physics: {step", "0 ms"),
        ("robot: {repeatability", "-0.03 mm"),
        ("robot: {servo: {bandwidth", "0 Hz}"),
        ("sensor: {range_force", "0 N"),
        ("sensor: {boot_time", "-1 s"),
        ("limits: {sample_age", "-1 ms"),
        ("limits: {step", "0 mm"),
        ("task: {contact_force", "-5 N"),
    ],
)
def test_a_size_below_its_least_is_refused_by_key(key, value):
    with pytest.raises(RigError, match="greater than") as refusal:
        parse(f"name: x\n{key}: {value}}}")
    path = key.replace(": {", ".")
    assert str(refusal.value).startswith(f"{path}: ")


def test_positions_may_be_negative_and_errors_may_be_switched_off():
    rig = parse(
        "name: x\nconnector: {position: [-1 m, -1 m, 0 m]}\n"
        "robot: {repeatability: 0 m}\nsensor: {errors: {noise_force: 0 N}}\nfixture: {play: 0 m}"
    )
    assert rig.connector.position == (-1.0, -1.0, 0.0)
    assert rig.sensor.errors.noise_force == 0.0


def test_the_first_part_is_what_a_run_takes():
    assert parse(f"name: x\nfixture: {{parts: [{{{PART}}}]}}").first_part == "FFC1"
    assert parse("name: x").first_part == ""


def test_a_software_version_of_another_series_is_refused():
    with pytest.raises(RigError, match=r"robot: version 3\.15\.8\.106339 .* e-series"):
        parse("name: a\nrobot: {series: e-series}")
