import re
from dataclasses import replace
from io import BytesIO, StringIO

import numpy as np
import pytest
from matplotlib.image import imread
from rich.console import Console

from hil.recording.diff import compare
from hil.recording.series import control, truth
from hil.recording.summary import summarise
from hil.view import page, run_figure, tables
from hil.view.progress import RunProgress
from hil.view.window import Window, assembly, true_normal_force


def test_the_picture_goes_from_contact_to_retreat(run):
    window = assembly(control(run), truth(run))
    assert window == pytest.approx((11 * 8e-3, 56 * 8e-3))


def test_true_force_is_shown_without_the_tools_weight(run):
    t, f_z = true_normal_force(truth(run), Window(0.0, 1.0))
    assert f_z[t < 0.16] == pytest.approx(0.0)
    assert np.max(f_z) == pytest.approx(5.0)


def test_the_same_run_gives_the_same_picture(run):
    assert run_figure.draw(run) == run_figure.draw(run)


def test_the_picture_shows_the_slot_only_when_it_was_found(run):
    without = tuple(
        m._replace(payload=m.payload.replace(b'"slot"', b'"face"')) for m in run.messages
    )
    orange = [_orange(run_figure.draw(r)) for r in (run, replace(run, messages=without))]
    assert orange[0] > orange[1]


def _orange(png):
    """Pixels of the colour in which the slot (and f_y) are drawn."""
    pixels = imread(BytesIO(png))[..., :3]
    return int((np.abs(pixels - np.array([0xD9, 0x73, 0x1A]) / 255).max(axis=-1) < 0.05).sum())


@pytest.mark.parametrize("kept", [(), ("/ctrl",), ("/plant",)])
def test_a_picture_can_be_drawn_of_what_little_was_recorded(run, kept):
    little = replace(run, messages=tuple(m for m in run.messages if m.topic in kept))
    assert run_figure.draw(little).startswith(b"\x89PNG")


def test_the_page_needs_nothing_from_elsewhere_and_escapes_what_it_shows(run):
    html = page.render(run, b"png")
    assert "http" not in html
    assert "<script" not in html
    assert "f_z &lt;high&gt;" in html
    assert set(re.findall(r'src="(\w+:)', html)) == {"data:"}


def test_a_runs_table_says_what_happened(run):
    text = tables.of_run(summarise(run))
    assert "slot found         0.328 s" in text
    assert "f_z <high>" in text
    assert run.digest in text


def test_a_difference_is_one_place_and_two_values(run):
    changed = list(run.messages)
    old = next(i for i, m in enumerate(changed) if m.topic == "/deadline" and m.t == 16_000_000)
    changed[old] = changed[old]._replace(payload=b'{"period":1,"misses":3}')
    text = tables.of_comparison(compare(run, replace(run, messages=tuple(changed))))
    assert text == "first difference: /deadline at 0.016000000 s, misses\n  2\n  3\n"


@pytest.fixture
def screen():
    return Console(file=StringIO(), force_terminal=True, width=120)


def test_progress_draws_at_most_ten_times_a_second(screen):
    clock = iter(np.arange(0.0, 10.0, 0.01).tolist())
    with RunProgress(2e-3, console=screen, now=lambda: next(clock)) as progress:
        before = screen.file.getvalue().count("mm")
        for k in range(100):  # one wall second
            progress.update(k * 8_000_000, "search", 0.0, 5.0)
    assert 9 <= screen.file.getvalue().count("mm") - before <= 12


@pytest.mark.parametrize(("quiet", "terminal"), [(True, True), (False, False)])
def test_progress_is_silent_when_asked_or_without_a_terminal(quiet, terminal):
    screen = Console(file=StringIO(), force_terminal=terminal)
    with RunProgress(2e-3, quiet=quiet, console=screen) as progress:
        progress.update(0, "search", 0.0, 5.0)
    assert screen.file.getvalue() == ""
