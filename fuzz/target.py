"""What a fuzz target is."""

from collections.abc import Callable
from typing import NamedTuple


class Target(NamedTuple):
    """check: takes any bytes; raises only when the code under test is wrong.

    seeds: valid inputs, to start from. words: of the language, to mutate with.
    """

    check: Callable[[bytes], None]
    seeds: tuple[bytes, ...]
    words: tuple[bytes, ...] = ()
