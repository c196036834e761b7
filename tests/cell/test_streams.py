from hypothesis import assume, given
from hypothesis import strategies as st

from hil.cell.streams import stream

names = st.text(min_size=1, max_size=20)
seeds = st.integers(0, 2**64)


def numbers(seed, name):
    return stream(seed, name).integers(2**62, size=4).tolist()


@given(seeds, names)
def test_one_seed_and_name_give_the_same_numbers(seed, name):
    assert numbers(seed, name) == numbers(seed, name)


@given(seeds, names, names)
def test_another_name_gives_other_numbers(seed, one, other):
    assume(one != other)
    assert numbers(seed, one) != numbers(seed, other)


@given(seeds, seeds, names)
def test_another_seed_gives_other_numbers(one, other, name):
    assume(one != other)
    assert numbers(one, name) != numbers(other, name)


@given(seeds, names, names)
def test_drawing_from_one_stream_leaves_another_alone(seed, name, other):
    assume(name != other)
    stream(seed, other).random(1000)
    drained = stream(seed, other)
    kept = stream(seed, name)
    drained.random(1000)
    assert kept.integers(2**62, size=4).tolist() == numbers(seed, name)


def test_numbers_stay_as_they_are_for_the_recordings_that_name_their_seed():
    assert stream(1, "plant").integers(1000, size=4).tolist() == [606, 727, 502, 862]
