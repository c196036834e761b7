"""A recorder that fails leaves a gap in the recording and is not felt by whoever records."""

import pytest

from hil.app.record import Lossy
from hil.recording.channel import Channel
from hil.recording.channels import deadline, event
from hil.recording.errors import RecordingError
from hil.recording.recorder import CHUNK, Recorder


class Disk:
    """A sink with room, or without."""

    def __init__(self):
        self.full, self.kept = False, []

    def put(self, channel, t, payload):
        if self.full:
            raise RecordingError("no space left")
        self.kept.append((channel, t, payload))

    def settle(self, t):
        pass


def test_what_could_not_be_written_is_marked_once_there_is_room_again():
    disk = Disk()
    record = Lossy(disk)
    for t in range(6):
        disk.full = t in (2, 3)
        record.put(Channel.DEADLINE, t, b"")
        record.mark(t)
    times = [t for channel, t, _ in disk.kept if channel is Channel.DEADLINE]
    marks = [(t, event.fields(text)) for channel, t, text in disk.kept if channel is Channel.EVENT]
    assert times == [0, 1, 4, 5]
    ((t, mark),) = marks
    assert t == 4
    assert mark["text"].startswith("gap: 2 records from 0.000 s")


def test_a_recorder_whose_writer_died_says_so_at_every_call(tmp_path, identity):
    recorder = Recorder(tmp_path / "a", identity)
    recorder.open()
    recorder._writer.kill()
    recorder._writer.wait()
    for k in range(CHUNK - 1):
        recorder.put(Channel.DEADLINE, 8_000_000 * k, deadline.encode(k, 0))
    with pytest.raises(RecordingError, match="recording failed"):
        recorder.put(Channel.DEADLINE, 1 << 39, deadline.encode(0, 0))
    with pytest.raises(RecordingError, match="recording failed"):
        recorder.put(Channel.DEADLINE, 1 << 40, deadline.encode(0, 0))
    with pytest.raises(RecordingError, match="recording failed"):
        recorder.close()
