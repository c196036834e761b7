"""Target of recordings: damaged files are read as far as they go, or refused in one line."""

from contextlib import suppress
from pathlib import Path
from tempfile import TemporaryDirectory

from fuzz.target import Target
from hil.recording.channel import Channel
from hil.recording.channels import deadline, event
from hil.recording.channels.event import EventKind
from hil.recording.errors import RecordingError
from hil.recording.folder import NAME
from hil.recording.identity import Identity
from hil.recording.read import load
from hil.recording.recorder import Recorder
from hil.recording.summary import summarise

TICK = 8_000_000


def check_recording(octets: bytes) -> None:
    with TemporaryDirectory() as folder:
        path = Path(folder) / NAME
        path.write_bytes(octets)
        with suppress(RecordingError):
            summarise(load(path))


def whole() -> bytes:
    """A short recording's bytes."""
    identity = Identity(seed=7, rig_name="a", rig=b"name: a\n", dbc=b'VERSION ""\n')
    with TemporaryDirectory() as folder:
        with Recorder(Path(folder) / "run", identity) as recorder:
            for k in range(5):
                recorder.put(Channel.DEADLINE, TICK * k, deadline.encode(k, 0))
            recorder.put(Channel.EVENT, 5 * TICK, event.encode(EventKind.OUTCOME, "inserted"))
            recorder.close()
        return (Path(folder) / "run" / NAME).read_bytes()


TARGETS = {"recording": Target(check_recording, (whole(),))}
