"""What a lockstep run gains when it has the machine to itself."""

import gc
from collections.abc import Iterator
from contextlib import contextmanager


@contextmanager
def undisturbed(*, wanted: bool) -> Iterator[None]:
    """Spare what is loaded the garbage collector's walks: 4 % of the loop's time, measured."""
    if not wanted:
        yield
        return
    gc.collect()
    gc.freeze()
    try:
        yield
    finally:
        gc.unfreeze()
