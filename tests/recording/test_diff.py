from dataclasses import replace

import orjson
import pytest
from hypothesis import given
from hypothesis import strategies as st

from hil.recording.diff import ABSENT, Difference, compare
from hil.recording.read import Message, Recording


def message(t, **fields):
    return Message(t, "/ctrl", 0, orjson.dumps(fields))


def recording(*messages, seed="1"):
    return Recording("run.mcap", "", "", {"run": {"seed": seed}}, {}, messages)


def test_equal_recordings_are_the_same():
    run = recording(message(0, k=1), message(8, k=2))
    assert compare(run, run).same


def test_the_first_difference_is_found_with_its_field():
    left = recording(message(0, k=1), message(8, wrench={"fx": 0.0, "fz": 5.0}), message(16, k=3))
    right = recording(message(0, k=1), message(8, wrench={"fx": 0.0, "fz": 5.5}), message(16, k=4))
    assert compare(left, right).message == Difference("/ctrl", 8, "wrench.fz", "5.0", "5.5")


def test_an_element_of_a_table_is_named_by_its_index():
    left = recording(message(0, samples=[[1, 2], [3, 4]]))
    right = recording(message(0, samples=[[1, 2], [3, 5]]))
    assert compare(left, right).message.field == "samples[1][1]"


@pytest.mark.parametrize("extra", [message(8, k=2), message(4, k=2)])
def test_a_message_that_only_one_has_is_named(extra):
    left = recording(message(0, k=1), extra, message(8, k=3))
    right = recording(message(0, k=1), message(8, k=3))
    found = compare(left, right).message
    assert found.left != found.right
    assert found.t == extra.t


def test_a_recording_that_ends_earlier_differs_at_its_end():
    left, right = recording(message(0, k=1)), recording(message(0, k=1), message(8, k=2))
    assert compare(left, right).message == Difference("/ctrl", 8, "", ABSENT, '{"k":2}')


def test_another_seed_is_a_difference_even_with_equal_messages():
    left, right = recording(message(0, k=1)), recording(message(0, k=1), seed="2")
    assert compare(left, right).identity == (("run.seed", "1", "2"),)
    assert not compare(left, right).same


def test_another_rig_file_of_the_same_size_is_a_difference():
    left = recording(message(0, k=1))
    a, b = (replace(left, attachments={"rig.yaml": body}) for body in (b"seed: 1", b"seed: 2"))
    assert not compare(a, b).same


json_value = st.recursive(
    st.none() | st.booleans() | st.integers(-9, 9) | st.text(max_size=3),
    lambda inner: st.lists(inner, max_size=3) | st.dictionaries(st.text(max_size=2), inner),
    max_leaves=6,
)


@given(json_value, json_value)
def test_two_messages_differ_exactly_when_their_json_does(a, b):
    found = compare(recording(message(0, v=a)), recording(message(0, v=b)))
    assert found.same == (orjson.dumps(a) == orjson.dumps(b))
