import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from hypothesis.extra import numpy as npst

from learner.checkpoint import MAGIC, Checkpoint, decode, encode, read, write
from learner.errors import CheckpointError

ARRAYS = npst.arrays(
    st.sampled_from([np.float64, np.int64, np.uint64, np.int8, np.bool_]),
    npst.array_shapes(max_dims=3, max_side=4),
)
LEAVES = st.integers(-(1 << 130), 1 << 130) | st.floats(allow_nan=False) | st.text() | ARRAYS
STATES = st.recursive(
    st.dictionaries(st.text(), LEAVES, max_size=4),
    lambda inner: st.dictionaries(st.text(), inner | LEAVES, max_size=3),
    max_leaves=8,
)


def checkpoint(state):
    return Checkpoint("wdql", {"psi": "0.01"}, "ffc_learning", 3, 7, {"numpy": "2"}, state)


def same(a, b):
    if isinstance(a, np.ndarray):
        return a.dtype == b.dtype and a.shape == b.shape and a.tobytes() == b.tobytes()
    if isinstance(a, dict):
        return a.keys() == b.keys() and all(same(a[key], b[key]) for key in a)
    return type(a) is type(b) and a == b


@given(STATES)
def test_what_was_saved_comes_back_to_the_bit(state):
    back = decode(encode(checkpoint(state)))
    assert same(dict(state), back.state)
    assert (back.learner, back.seed, back.episodes) == ("wdql", 3, 7)


@given(STATES)
def test_equal_checkpoints_are_equal_bytes_in_whatever_order_they_were_filled(state):
    turned = dict(reversed(list(state.items())))
    assert encode(checkpoint(state)) == encode(checkpoint(turned))


def test_a_generator_goes_on_where_it_was():
    rng = np.random.default_rng(5)
    rng.standard_normal(100)
    saved = decode(encode(checkpoint({"rng": dict(rng.bit_generator.state)}))).state
    other = np.random.default_rng(0)
    other.bit_generator.state = saved["rng"]
    assert np.array_equal(rng.standard_normal(50), other.standard_normal(50))


@given(st.integers(0), st.integers(1, 255))
def test_one_bent_byte_is_noticed(at, by):
    content = bytearray(encode(checkpoint({"q": np.arange(20.0)})))
    content[at % len(content)] ^= by
    with pytest.raises(CheckpointError):
        decode(bytes(content))


@given(st.integers(0, 200))
def test_a_file_cut_short_is_noticed(length):
    content = encode(checkpoint({"q": np.arange(20.0)}))
    if length < len(content):
        with pytest.raises(CheckpointError):
            decode(content[:length])


def test_a_foreign_file_is_named(tmp_path):
    path = tmp_path / "policy.bin"
    path.write_bytes(b"PK\x03\x04 something else")
    with pytest.raises(CheckpointError, match=r"policy\.bin: not a learner's checkpoint"):
        read(path)


def test_a_missing_file_is_named(tmp_path):
    with pytest.raises(CheckpointError, match=r"none: cannot be read: No such file"):
        read(tmp_path / "none")


def test_writing_replaces_the_old_file_and_leaves_nothing_beside_it(tmp_path):
    path = tmp_path / "policy"
    write(path, checkpoint({"n": 1}))
    digest = write(path, checkpoint({"n": 2}))
    assert read(path).state == {"n": 2}
    assert [entry.name for entry in tmp_path.iterdir()] == ["policy"]
    assert len(digest) == 64


def test_a_folder_that_is_not_there_is_one_line(tmp_path):
    with pytest.raises(CheckpointError, match="cannot be written"):
        write(tmp_path / "no" / "policy", checkpoint({}))


def test_what_cannot_be_kept_is_refused():
    with pytest.raises(CheckpointError, match="cannot keep a list"):
        encode(checkpoint({"steps": [1, 2]}))


def test_the_magic_says_the_version():
    assert encode(checkpoint({})).startswith(MAGIC)
