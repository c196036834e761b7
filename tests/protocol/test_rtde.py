"""Laws of RTDE framing: what was cut off a stream is what was put on it, however it arrives."""

from contextlib import suppress

import pytest
from hypothesis import given
from hypothesis import strategies as st

from drivers.protocol.errors import WireError
from drivers.protocol.rtde import MAX_PACKAGE, Cutter, Package, PackageType, encode

packages = st.lists(
    st.builds(Package, st.sampled_from(list(PackageType)).map(int), st.binary(max_size=300)),
    max_size=8,
)


def stream_of(sent):
    return b"".join(encode(package.type, package.payload) for package in sent)


@given(packages)
def test_a_whole_stream_is_cut_into_its_packages(sent):
    assert Cutter().feed(stream_of(sent)) == sent


@given(packages)
def test_a_stream_a_byte_at_a_time_is_cut_into_its_packages(sent):
    cutter = Cutter()
    received = [p for byte in stream_of(sent) for p in cutter.feed(bytes((byte,)))]
    assert received == sent


@given(packages, st.data())
def test_the_beginning_of_a_next_package_waits_for_its_end(sent, data):
    last = encode(PackageType.DATA, b"next")
    cut = data.draw(st.integers(0, len(last) - 1))
    cutter = Cutter()
    assert cutter.feed(stream_of(sent) + last[:cut]) == sent
    assert cutter.feed(last[cut:]) == [Package(PackageType.DATA, b"next")]


@given(st.lists(st.binary(max_size=200), max_size=20))
def test_garbage_raises_wire_error_or_nothing(chunks):
    cutter = Cutter()
    with suppress(WireError):
        for chunk in chunks:
            cutter.feed(chunk)


@pytest.mark.parametrize("size", [0, 1, 2, MAX_PACKAGE + 1, 0xFFFF])
def test_a_size_no_package_can_have_is_refused(size):
    with pytest.raises(WireError, match=f"of {size} bytes"):
        Cutter().feed(size.to_bytes(2, "big") + b"U")


def test_the_largest_package_passes():
    payload = bytes(MAX_PACKAGE - 3)
    assert Cutter().feed(encode(PackageType.DATA, payload)) == [Package(PackageType.DATA, payload)]


def test_a_package_above_the_bound_cannot_be_encoded():
    with pytest.raises(ValueError, match="4097"):
        encode(PackageType.DATA, bytes(MAX_PACKAGE - 2))


def test_a_type_no_version_defines_is_passed_on():
    assert Cutter().feed(bytes.fromhex("000400ff")) == [Package(0, b"\xff")]
