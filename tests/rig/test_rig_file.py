from importlib.resources import files
from math import pi

import pytest

from hil.cell.errors import RigError
from hil.cell.rig import Rig, load, parse
from hil.cell.rig.rig import keys_at

RIGS = sorted(
    (entry for entry in files("hil_fixtures").joinpath("rigs").iterdir()), key=lambda f: f.name
)


@pytest.fixture
def rig() -> Rig:
    return parse(files("hil_fixtures").joinpath("rigs", "ffc_ur5.yaml").read_text("utf-8"))


@pytest.mark.parametrize("file", RIGS, ids=lambda file: file.name)
def test_every_shipped_rig_loads_under_its_own_name(file):
    assert parse(file.read_text("utf-8")).name == file.name.removesuffix(".yaml")


def test_the_papers_cell_has_the_papers_arm_and_sensor(rig):
    assert (rig.robot.model, rig.robot.series, rig.robot.rate) == ("ur5", "cb3", 125)
    assert rig.robot.period == 8_000_000
    assert rig.sensor.preset == "nrs-6050-d80"
    assert (rig.sensor.range_force, rig.sensor.range_torque) == (500.0, 10.0)
    assert rig.sensor.resolution_force == pytest.approx(0.015)
    assert rig.sensor.resolution_torque == pytest.approx(0.312e-3)


def test_the_papers_cell_has_the_papers_cable_slot_and_play(rig):
    cable, slot = rig.cable, rig.connector
    assert (cable.width, cable.thickness) == pytest.approx((18.5e-3, 0.3e-3))
    assert (slot.width, slot.height) == pytest.approx((18.56e-3, 0.37e-3))
    assert rig.fixture.play == pytest.approx(0.8e-3)
    assert rig.fixture.play_rotation == pytest.approx(pi / 180)


def test_the_papers_job_has_the_papers_bounds_and_steps(rig):
    assert rig.limits.force_bound == (1.5, 1.5, 10.0, 1.0)
    assert rig.task.contact_force == 5.0
    assert (rig.task.step, rig.task.step_rotation) == pytest.approx((0.3e-3, pi / 180))
    assert rig.task.max_steps == 500


@pytest.mark.parametrize(
    ("text", "path", "near"),
    [
        ("connector: {widht: 3 mm}", "connector.widht", "width"),
        ("robot: {servo: {bandwith: 3 Hz}}", "robot.servo.bandwith", "bandwidth"),
        ("fixture: {parts: [{nam: a}]}", "fixture.parts.0.nam", "name"),
        ("conector: {}", "conector", "connector"),
    ],
)
def test_an_unknown_key_names_the_nearest_known_one(text, path, near):
    with pytest.raises(RigError) as refusal:
        parse(f"name: x\n{text}")
    assert f"{path}: no such key; did you mean '{near}'?" in str(refusal.value)
    assert "\n" not in str(refusal.value)


def test_a_missing_key_is_named():
    with pytest.raises(RigError, match=r"fixture\.parts\.0\.position: Field required"):
        parse("name: x\nfixture: {parts: [{name: a}]}")


@pytest.mark.parametrize("text", ["", "- a", "3", "just words", "name: [", "a: b: c", "\t- x"])
def test_what_is_not_a_mapping_is_one_line(text):
    with pytest.raises(RigError) as refusal:
        parse(text)
    assert "\n" not in str(refusal.value)


def test_a_file_that_cannot_be_read_is_named(tmp_path):
    with pytest.raises(RigError, match=r"absent\.yaml: cannot be read"):
        load(tmp_path / "absent.yaml")


def test_a_file_that_is_not_text_is_named(tmp_path):
    path = tmp_path / "rig.yaml"
    path.write_bytes(b"name: \xff\xfe")
    with pytest.raises(RigError, match=r"rig\.yaml: is not UTF-8 text"):
        load(path)


def test_a_wrong_file_is_named_with_its_fault(tmp_path):
    path = tmp_path / "rig.yaml"
    path.write_text("name: x\nseed: -1\n")
    with pytest.raises(RigError, match=r"rig\.yaml: seed: .*greater than or equal to 0"):
        load(path)


def test_the_keys_at_a_place_are_its_sections_fields():
    assert keys_at(("robot", "servo")) == ["bandwidth"]
    assert "position" in keys_at(("fixture", "parts", 3))
    assert keys_at(("seed",)) == []
    assert keys_at(("nowhere", "at", "all")) == []


def test_a_rig_never_changes(rig):
    with pytest.raises(ValueError, match="frozen"):
        rig.seed = 2
