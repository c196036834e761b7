"""Dashboard lines, whole and in pieces."""

import pytest
from hypothesis import given
from hypothesis import strategies as st

from drivers.protocol.dashboard import GREETING, MAX_LINE, LineCutter, encode
from drivers.protocol.errors import WireError

lines = st.lists(
    st.text(st.characters(exclude_characters="\r\n", exclude_categories=("Cs",)), max_size=60)
)


@given(lines, st.integers(1, 7))
def test_lines_come_back_in_pieces_of_any_size(sent, size):
    stream = b"".join(map(encode, sent))
    cutter = LineCutter()
    pieces = (stream[at : at + size] for at in range(0, len(stream), size))
    assert [line for piece in pieces for line in cutter.feed(piece)] == sent


def test_a_partial_line_waits_for_its_end():
    cutter = LineCutter()
    assert cutter.feed(encode(GREETING) + b"Power") == [GREETING]
    assert cutter.feed(b"ing on\r\n") == ["Powering on"]


@pytest.mark.parametrize("text", ["stop\nplay", "stop\rplay"])
def test_a_line_break_inside_a_line_is_the_callers_error(text):
    with pytest.raises(ValueError, match="line break"):
        encode(text)


@pytest.mark.parametrize("end", [b"", b"\n"])
def test_a_line_without_end_is_cut_off(end):
    cutter = LineCutter()
    cutter.feed(bytes(MAX_LINE))
    with pytest.raises(WireError, match=str(MAX_LINE)):
        cutter.feed(b"x" + end)
