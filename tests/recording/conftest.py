"""A short run that a test may record: contact, search, slot, bottom, as numbers without physics."""

from pathlib import Path

import pytest

from hil.recording.channel import Channel
from hil.recording.channels import deadline, event
from hil.recording.channels.event import EventKind
from hil.recording.identity import Identity
from hil.recording.recorder import Recorder

RIG = Path("fixtures/rigs/ffc_ur5.yaml")


@pytest.fixture
def identity():
    return Identity(seed=7, rig_name="ffc_ur5", rig=b"name: ffc_ur5\n", dbc=b'VERSION ""\n')


@pytest.fixture
def record(identity):
    """Record (channel, t, payload) entries into a folder; the digest."""

    def write(folder, entries, settled=(), **options):
        with Recorder(folder, options.pop("identity", identity), **options) as recorder:
            for index, (channel, t, payload) in enumerate(entries):
                recorder.put(channel, t, payload)
                if index in settled:
                    recorder.settle(t)
            return recorder.close()

    return write


@pytest.fixture
def entries():
    """Two channels over 40 periods and one event."""
    ticks = [(Channel.DEADLINE, 8_000_000 * k, deadline.encode(k, k // 9)) for k in range(40)]
    note = (Channel.EVENT, 80_000_000, event.encode(EventKind.GUARD, "f_z 10.2 N above 10 N"))
    return [*ticks, note]
