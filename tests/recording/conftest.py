"""Runs that a test may record: numbers without physics."""

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from hil.cell.plant.interface import Contact, PartTruth, PlantStep
from hil.recording.channel import Channel
from hil.recording.channels import control, deadline, event, plant, truth
from hil.recording.channels.event import EventKind
from hil.recording.identity import Identity
from hil.recording.read import load
from hil.recording.recorder import Recorder

RIG = Path(__file__).parents[2] / "fixtures/rigs/ffc_ur5.yaml"


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


STEP = 8_000_000
FIRST_FACE, FIRST_SLOT = 20, 40


def _period(k):
    """(channel, t, payload) of one period of a run that finds the slot in period 40 of 60."""
    contact = Contact.FREE if k < FIRST_FACE else Contact.FACE if k < FIRST_SLOT else Contact.SLOT
    depth = max(0, k - FIRST_SLOT) * 1e-4
    f_z = 0.0 if contact is Contact.FREE else 5.0 if contact is Contact.FACE else 2.0
    wrenches = np.zeros((8, 6))
    wrenches[:, 2] = -f_z - 5.9  # sensor frame, with the tool's weight
    part = PartTruth("FFC1", (0.0, 0.0, -depth), 0.0, depth, (0.0, 0.0, 0.0), contact)
    step = PlantStep(wrenches, (0.0, 0.0, -depth, 0.0), (0.0,) * 4, part)
    phase = (
        "pick up" if k < 10 else "contact" if k < FIRST_FACE else "search" if k < 55 else "retract"
    )
    seen = (0.1, -0.1, f_z, 0.0, 0.0, 0.0)
    packed = control.encode(phase, k, (0.0,) * 6, seen, (0.0, 0.0, -depth, 0.0))
    t = (k + 1) * STEP
    return [
        (Channel.WRENCH_TRUE, t, truth.encode(wrenches)),
        (Channel.PLANT, t, plant.encode(step)),
        (Channel.CTRL, t, packed),
        (Channel.DEADLINE, t, deadline.encode(k, 2)),
    ]


@pytest.fixture
def run(tmp_path, identity, record):
    """A recorded run of 60 periods on the paper's rig: contact, slot, a trip, an outcome."""
    entries = [entry for k in range(60) for entry in _period(k)]
    entries.append((Channel.EVENT, 30 * STEP, event.encode(EventKind.GUARD, "f_z <high>")))
    entries.append((Channel.EVENT, 60 * STEP, event.encode(EventKind.OUTCOME, "inserted")))
    rig = replace(identity, rig=RIG.read_bytes())
    record(tmp_path / "run", entries, identity=rig)
    return load(tmp_path / "run")
