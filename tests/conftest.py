"""What holds for every test: nothing that it opened outlives it."""

import os
import threading
from collections.abc import Iterator
from multiprocessing import active_children
from pathlib import Path

import pytest


def _sockets() -> set[str]:
    """Sockets this process holds, by inode."""
    links = set()
    for entry in Path("/proc/self/fd").iterdir():
        try:
            links.add(os.readlink(entry))
        except FileNotFoundError:  # the listing's own descriptor
            continue
    return {link for link in links if link.startswith("socket:")}


@pytest.fixture(autouse=True)
def _leaves_no_thread_socket_or_process() -> Iterator[None]:
    threads, sockets = set(threading.enumerate()), _sockets()
    yield
    assert set(threading.enumerate()) <= threads, "a thread outlived its test"
    assert _sockets() <= sockets, "a socket outlived its test"
    assert not active_children(), "a process outlived its test"
