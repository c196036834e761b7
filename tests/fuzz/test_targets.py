"""Every fuzz target with inputs of hypothesis: random bytes, and bent pieces of valid ones."""

import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from fuzz.targets import TARGETS

EXAMPLES = 60
SLOW = {"script-run": 25, "script-session": 25, "rig": 30, "recording": 30}


def bent(target):
    """Valid inputs, words of the language and random bytes, cut and joined."""
    pieces = st.one_of(
        st.sampled_from((*target.seeds, *target.words, b"\n", b"\0", b"\xff" * 9)),
        st.binary(max_size=24),
    )
    cut = st.builds(
        lambda piece, a, b: piece[a:][: b or None], pieces, st.integers(0, 40), st.integers(0, 400)
    )
    return st.lists(st.one_of(pieces, cut), max_size=8).map(b"".join)


@pytest.mark.parametrize("name", sorted(TARGETS))
def test_a_target_survives_whatever_comes(name):
    target = TARGETS[name]

    @settings(
        max_examples=SLOW.get(name, EXAMPLES),
        deadline=None,
        derandomize=True,
        database=None,
        suppress_health_check=[HealthCheck.too_slow],
    )
    @given(st.one_of(bent(target), st.binary(max_size=600)))
    def survives(octets):
        target.check(octets)

    survives()


@pytest.mark.parametrize("name", sorted(TARGETS))
def test_the_seeds_of_a_target_pass(name):
    for seed in TARGETS[name].seeds:
        TARGETS[name].check(seed)
