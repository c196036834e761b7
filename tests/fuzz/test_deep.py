"""Inputs that nest or go on for ever are refused in one line; mutation seldom finds them."""

import pytest

from fuzz.targets import TARGETS

DEEP = {
    "formula": [
        b"f_z <= " + b"-" * 900 + b"1",
        b"once " * 190 + b"f_z < 1",
        b"not " * 5000,
        b"(" * 5000,
    ],
    "rig": [
        b"a: " + b"[" * 3000,
        b"? " * 3000,
        b"name: " + b"9" * 5000,
        b"x: 2001-99-99",
        b"a: !!int x",
    ],
    "script": [
        b"x = " + b"(" * 5000,
        b"x = " + b"-" * 50000 + b"1",
        b"if a:\n" * 2000,
        b"x = " + b"9" * 5000,
    ],
    "bus-address": ["udp_multicast a:²".encode(), b"udp_multicast a:" + b"9" * 5000],
}


@pytest.mark.parametrize(("name", "octets"), [(n, o) for n, all in DEEP.items() for o in all])
def test_what_nests_deeply_or_never_ends_is_refused(name, octets):
    TARGETS[name].check(octets)
