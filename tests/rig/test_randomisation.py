import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from hil.cell.errors import RigError
from hil.cell.rig import drawn, parse
from hil.cell.rig.rig import bounds

AXES = """
name: x
randomisation:
  enabled: true
  axes:
    - {key: cable.modulus, low: 4 GPa, high: 8 GPa}
    - {key: connector.friction, low: 0.10, high: 0.25}
    - {key: pad.stiffness_x, low: 4 N/mm, high: 4 N/mm}
"""
RIG = parse(AXES)
seeds = st.integers(0, 2**32)


def draw(rig, seed):
    return drawn(rig, np.random.default_rng(seed))


@given(seeds)
def test_every_draw_lies_within_its_axis_in_si(seed):
    rig = draw(RIG, seed)
    assert 4e9 <= rig.cable.modulus <= 8e9
    assert 0.10 <= rig.connector.friction <= 0.25
    assert rig.pad.stiffness_x == 4e3


@given(seeds)
def test_the_same_stream_draws_the_same_rig(seed):
    assert draw(RIG, seed) == draw(RIG, seed)


@given(seeds)
def test_nothing_but_the_axes_is_drawn(seed):
    rig, plain = draw(RIG, seed), RIG
    restored = rig.model_copy(
        update={"cable": plain.cable, "connector": plain.connector, "pad": plain.pad}
    )
    assert restored == plain
    assert rig.cable.model_copy(update={"modulus": plain.cable.modulus}) == plain.cable


def test_draws_fill_their_axis_evenly():
    shares = [(draw(RIG, seed).cable.modulus - 4e9) / 4e9 for seed in range(400)]
    # Mean of a uniform draw: sigma 1 / sqrt(12 n); four of them.
    assert abs(np.mean(shares) - 0.5) < 4 / np.sqrt(12 * 400)
    assert min(shares) < 0.05
    assert max(shares) > 0.95


def test_disabled_axes_are_documentation_only():
    rig = parse(AXES.replace("enabled: true", "enabled: false"))
    assert draw(rig, 1) == rig


def test_an_axis_gives_its_ends_in_si():
    assert bounds(RIG, RIG.randomisation.axes[0]) == (4e9, 8e9)


@pytest.mark.parametrize(
    ("axis", "complaint"),
    [
        ("{key: cable.modulos, low: 4 GPa, high: 8 GPa}", "'cable.modulos' is not a number"),
        ("{key: task.max_steps, low: 4, high: 8}", "'task.max_steps' is not a number"),
        ("{key: connector.position, low: 0 m, high: 1 m}", "'connector.position' is not a number"),
        ("{key: cable.modulus, low: 8 GPa, high: 4 GPa}", "cable.modulus goes from 8 GPa down"),
        ("{key: cable.modulus, low: 4 mm, high: 8 GPa}", "cable.modulus: .*'4 mm' is not"),
        ("{key: cable.modulus, low: 4, high: 8 GPa}", "cable.modulus: .*has no unit"),
        ("{key: connector.friction, low: 0.1, high: 1.5}", "connector.friction: .*less than"),
        ("{key: modulus, low: 4 GPa, high: 8 GPa}", "randomisation.axes.0.key"),
    ],
)
def test_an_axis_that_means_nothing_is_refused_by_its_key(axis, complaint):
    with pytest.raises(RigError, match=complaint) as refusal:
        parse(f"name: x\nrandomisation: {{axes: [{axis}]}}")
    assert "\n" not in str(refusal.value)


def test_an_axis_is_named_once():
    axis = "{key: cable.modulus, low: 4 GPa, high: 8 GPa}"
    with pytest.raises(RigError, match="each axis may be named once"):
        parse(f"name: x\nrandomisation: {{axes: [{axis}, {axis}]}}")


def test_a_draw_that_cannot_be_built_is_refused():
    rig = parse(
        "name: x\nrandomisation: {enabled: true, axes: "
        "[{key: connector.width, low: 18 mm, high: 18.4 mm}]}"
    )
    with pytest.raises(RigError, match=r"connector\.width must exceed cable\.width"):
        draw(rig, 1)
