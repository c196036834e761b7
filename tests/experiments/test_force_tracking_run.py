"""The experiment over the wire, once; and the loop without a wire against it."""

from dataclasses import replace

import pytest

from hil.experiments.force_tracking.direct import direct
from hil.experiments.force_tracking.grid import Grid, speeds
from hil.experiments.force_tracking.presets import parameters, preset
from hil.experiments.force_tracking.run import run
from hil.experiments.force_tracking.variant import Variant, rig_of
from hil_fixtures.testbed import shipped


@pytest.fixture
def rig():
    return shipped("surface_ur5")


@pytest.mark.parametrize(("law", "stiffness"), [("soft", 10.0), ("constant", 3.0)])
def test_the_loop_without_a_wire_says_what_the_wire_says(rig, law, stiffness):
    variant = Grid().variant(law, stiffness, 6.0)
    (wired, ending), bare = run(rig, 3, variant.as_json()), direct(rig, 3, variant)
    assert ending == "done: tracked to the end"
    assert not wired["unstable"]
    assert not bare.unstable
    assert wired["settling"] == pytest.approx(bare.settling, rel=0.25, abs=0.03)
    assert wired["rms_tracking"] == pytest.approx(bare.rms_tracking, rel=0.2)
    assert wired["overshoot"] == pytest.approx(bare.overshoot, abs=0.02)


def test_one_seed_is_one_row_over_the_wire_and_records_alike(rig, tmp_path):
    variant = Grid().variant("soft", 30.0, 10.0).as_json()
    recorded = {**variant, "recording": str(tmp_path / "run")}
    assert run(rig, 5, variant) == run(rig, 5, recorded)
    assert any((tmp_path / "run").iterdir())


def test_soft_overshoots_less_once_it_is_told_how_far_the_arm_gives_way(rig):
    told = Grid().variant("soft", 30.0, 10.0)
    untold = replace(told, parameters={**told.parameters, "compliance": 0.0})
    assert direct(rig, 1, told).overshoot < 0.03
    assert direct(rig, 1, untold).overshoot > 0.05


def test_an_unstable_law_is_told_from_a_stable_one(rig):
    wild = Variant("constant", {"damping": 60.0}, stiffness=30e3)
    assert direct(rig, 1, wild).unstable


def test_seeds_draw_the_surface_and_the_noise(rig):
    variant = Grid().variant("soft", 10.0, 6.0)
    assert direct(rig, 1, variant) == direct(rig, 1, variant)
    assert direct(rig, 1, variant) != direct(rig, 2, variant)


def test_latency_is_shared_by_both_wires(rig):
    made = rig_of(rig, Variant("soft", {}, latency=10e-3)).latency
    assert (made.can.from_cell.mean, made.rtde.to_cell.mean) == (5e-3, 5e-3)
    none = rig_of(rig, Variant("soft", {}, latency=0.0)).latency
    assert (none.can.from_cell.jitter, none.rtde.to_cell.jitter) == (0.0, 0.0)


@pytest.mark.parametrize(
    ("force", "bottoms", "chosen", "expected"),
    [
        (10.0, False, (None, None, None), (4.0, 16.0, 20.0)),
        (5.0, False, (None, None, None), (2.5, 16.0, 20.0)),
        (5.0, True, (None, None, None), (2.5, 2.5, 0.0)),
        (5.0, True, (3.0, 9.0, 20.0), (3.0, 9.0, 20.0)),
    ],
)
def test_speeds_suit_the_force_and_a_surface_that_bottoms_out(force, bottoms, chosen, expected):
    assert speeds(force, bottoms, *chosen) == expected


def test_a_cable_that_bottoms_out_is_pressed_below_8_newton(rig):
    variant = Grid(
        laws=("soft",), force=5.0, approach=2.5, push=2.5, slide=0.0, bottoming=(3.0, 50.0)
    ).variant("soft", 2.0, 10.0)
    found = direct(rig, 1, variant)
    assert found.peak < 8.0
    assert found.rms_tracking is None
    assert not found.unstable


def test_soft_presses_the_papers_cable_on_its_connector_with_5_newton():
    grid = Grid(laws=("soft",), stiffnesses=(20.0,), force=5.0, approach=2.5, push=2.5, slide=0.0,
                cable=True)  # fmt: skip
    found, ending = run(shipped("ffc_ur5"), 1, grid.variant("soft", 20.0, 10.0).as_json())
    assert ending == "done: tracked to the end"
    assert not found["unstable"]
    assert found["overshoot"] < 0.08
    assert found["settling"] < 0.3
    assert found["rms_static"] < 0.02 * 5.0, "the sensor's gain errs by 1 %"


@pytest.mark.parametrize("wrong", [{"slide": 20.0}, {"slide": 0.0, "bottoming": (3.0, 50.0)}])
def test_a_cable_neither_slides_nor_is_told_to_bottom_out(wrong):
    with pytest.raises(ValueError, match="a cable is pressed at rest"):
        Grid(cable=True, **wrong)


@pytest.mark.parametrize("name", ["tuned", "ordered", "printed"])
def test_every_shipped_preset_fits_its_laws(name):
    for law in preset(name):
        parameters(name, law)


@pytest.mark.parametrize(
    ("wrong", "said"),
    [
        ({"laws": ("sofft",)}, "soft"),
        ({"laws": ("nowhere:Law",)}, "cannot be imported"),
        ({"laws": ()}, "at least one"),
        ({"stiffnesses": (0.0,)}, "positive"),
        ({"stiffnesses": (-3.0,)}, "positive"),
        ({"stiffnesses": (float("nan"),)}, "positive"),
        ({"latencies": (90.0,)}, "50 ms"),
        ({"force": 0.0}, "positive"),
        ({"slide": -1.0}, "0 mm/s or more"),
        ({"force": 0.1}, "0.4"),
        ({"preset": "tunned"}, "did you mean 'tuned'"),
    ],
)
def test_a_grid_that_cannot_be_run_is_refused_before_anything_moves(wrong, said):
    with pytest.raises(ValueError, match=said) as caught:
        Grid(**wrong)
    assert "\n" not in str(caught.value)


def test_a_preset_file_with_an_unknown_parameter_is_refused(tmp_path):
    path = tmp_path / "mine.yaml"
    path.write_text("soft: {bandwith: 0.5}")
    with pytest.raises(ValueError, match="did you mean 'bandwidth'"):
        Grid(laws=("soft",), preset=str(path))
