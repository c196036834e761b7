"""The record of the real-time interface."""

import pytest
from hypothesis import given
from hypothesis import strategies as st

from drivers.protocol.errors import WireError
from drivers.protocol.realtime import FIELDS, Record


@pytest.mark.parametrize(
    ("version", "size"),
    [
        ((3, 2), 1060), ((3, 4), 1060), ((3, 5), 1108), ((3, 10), 1116), ((3, 14), 1140),
        ((3, 15, 8), 1220), ((5, 0), 1108), ((5, 4), 1116), ((5, 9), 1140), ((5, 11, 0), 1220),
    ],
)  # fmt: skip
def test_each_version_has_its_size(version, size):
    assert Record(version).size == size


def test_a_version_without_a_record_is_refused():
    with pytest.raises(ValueError, match=r"3\.1 is not known"):
        Record((3, 1))


@given(values=st.lists(st.floats(allow_nan=False), min_size=152, max_size=152))
def test_a_record_survives_the_wire(values):
    record = Record((5, 11))
    found = record.unpack(record.pack(values))
    assert [value for name, _ in FIELDS for value in found[name]] == values


def test_an_older_version_sends_less():
    record = Record((3, 5))
    found = record.unpack(record.pack([0.0] * 152))
    assert "elbow_velocity" in found
    assert "safety_status" not in found


def test_a_record_of_another_size_is_refused():
    with pytest.raises(WireError, match="1060 bytes, allowed are 1220"):
        Record((5, 11)).unpack(bytes(1060))
