"""What nobody in a real cell can measure must not be on a wire: hidden play and offset."""

import pytest

from drivers.protocol.rtde_variables import OUTPUTS


@pytest.fixture(params=["wall", "analytic"])
def pair(request, make_bench):
    """Two cells that differ in how the part lies in the jaws, and in nothing else."""
    # Without the arm's own error, which is drawn anew at the grip and would set the cable swinging.
    cells = [
        make_bench(plant=request.param, play=play, repeatability="0 mm").gripped()
        for play in ("0 mm", "0.8 mm")
    ]
    true, off = (cell.bench.truth.part.grip for cell in cells)
    assert max(abs(a - b) for a, b in zip(true, off, strict=True)) > 0.05e-3
    return cells


def test_before_contact_no_can_frame_tells_how_the_part_lies(pair):
    true, off = pair
    assert len(true.frames) > 300
    assert true.frames == off.frames


def test_before_contact_no_output_variable_tells_how_the_part_lies(pair):
    for true, off in zip(*(cell.values for cell in pair), strict=True):
        told = {name for name in true if off[name] != pytest.approx(true[name], abs=1e-12)}
        assert told == set()


def test_every_output_variable_of_the_protocol_was_looked_at(make_bench):
    assert set(make_bench().run(1).values[0]) == set(OUTPUTS)


def test_the_arms_hidden_offset_does_not_show_in_what_it_reports(make_bench):
    cells = [make_bench(repeatability=width).run(5) for width in ("0 mm", "0.03 mm")]
    exact, off = (cell.values[-1]["actual_TCP_pose"] for cell in cells)
    assert off == pytest.approx(exact, abs=1e-12)
    hidden = [cell.bench.truth.stage for cell in cells]
    assert max(abs(a - b) for a, b in zip(*hidden, strict=True)) > 1e-6
