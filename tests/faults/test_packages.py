"""What a bad link does to RTDE packages."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from drivers.protocol.errors import WireError
from drivers.protocol.rtde import Cutter, PackageType, encode
from drivers.protocol.rtde_setup import decode_names, encode_names
from hil.cell.injection import packages

payloads = st.binary(min_size=1, max_size=60)


@given(st.lists(payloads, max_size=6), st.integers(1, 20))
def test_a_stream_cut_anywhere_gives_the_packages_that_were_sent(found, size):
    sent = [encode(PackageType.DATA, payload) for payload in found]
    stream, cutter = b"".join(sent), packages.Cutter()
    pieces = [stream[at : at + size] for at in range(0, len(stream), size)]
    assert [whole for piece in pieces for whole in cutter.feed(piece)] == sent


@given(payloads, st.integers(0, 1000))
def test_a_length_that_no_package_has_is_refused_by_whoever_reads_it(payload, seed):
    bent = packages.bent(
        encode(PackageType.DATA, payload), "length", 1, np.random.default_rng(seed)
    )
    with pytest.raises(WireError):
        Cutter().feed(bent)


@given(payloads, st.integers(1, 8), st.integers(0, 1000))
def test_a_bent_payload_keeps_its_header(payload, bits, seed):
    package = encode(PackageType.DATA, payload)
    bent = packages.bent(package, "payload", bits, np.random.default_rng(seed))
    assert (bent[:3], len(bent)) == (package[:3], len(package))


def test_a_recipe_asks_for_what_is_not_there():
    request = encode(PackageType.SETUP_INPUTS, encode_names(["input_int_register_24", "x"]))
    names = decode_names(packages.refused(request, "input")[3:])
    assert names == ("input_int_register_2_", "x")
    assert packages.refused(request, "output") == request
