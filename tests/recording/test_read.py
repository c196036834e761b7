import os
import signal
import subprocess
import sys

import orjson
import pytest
from mcap.reader import make_reader
from mcap.writer import Writer

from hil.recording.errors import RecordingError
from hil.recording.read import load
from hil.recording.recorder import CHUNK


def test_messages_come_back_in_order_with_their_bench_time(tmp_path, record, entries):
    digest = record(tmp_path, entries)
    run = load(tmp_path)
    assert run.digest == digest
    assert run.ending == ""
    assert [m.t for m in run.messages] == sorted(t for _, t, _ in entries)
    assert orjson.loads(run.messages[11].payload)["text"] == "f_z 10.2 N above 10 N"


def test_identity_and_attachments_come_back(tmp_path, record, entries):
    record(tmp_path, entries)
    run = load(tmp_path / "run.mcap")
    assert run.metadata["run"]["seed"] == "7"
    assert set(run.metadata["versions"]) == {"hil-testbed", "mujoco", "numpy", "python-can"}
    assert run.attachments == {"rig.yaml": b"name: ffc_ur5\n", "nrs.dbc": b'VERSION ""\n'}


def test_another_mcap_reader_finds_the_same_messages_by_its_index(tmp_path, record, entries):
    record(tmp_path, entries)
    with (tmp_path / "run.mcap").open("rb") as file:
        theirs = [(c.topic, m.log_time, m.data) for _, c, m in make_reader(file).iter_messages()]
    assert theirs == [(m.topic, m.t, m.payload) for m in load(tmp_path).messages]


def test_a_file_cut_anywhere_gives_a_prefix_or_one_clear_error(tmp_path, record, entries):
    record(tmp_path, entries)
    whole = (tmp_path / "run.mcap").read_bytes()
    complete = load(tmp_path).messages
    cut = tmp_path / "cut.mcap"
    for length in range(1, len(whole) - 1, 23):
        cut.write_bytes(whole[:length])
        run = load(cut)
        assert run.ending
        assert run.messages == complete[: len(run.messages)]


def test_an_empty_file_is_no_recording(tmp_path):
    (tmp_path / "run.mcap").touch()
    with pytest.raises(RecordingError, match="is empty"):
        load(tmp_path)


def test_a_damaged_byte_never_shows_as_another_message(tmp_path, record, entries):
    record(tmp_path, entries)
    whole = bytearray((tmp_path / "run.mcap").read_bytes())
    complete = load(tmp_path).messages
    damaged = tmp_path / "damaged.mcap"
    for at in range(8, len(whole), 41):
        whole[at] ^= 0xFF
        damaged.write_bytes(whole)
        whole[at] ^= 0xFF
        assert {m.payload for m in load(damaged).messages} <= {m.payload for m in complete}


def test_a_message_of_no_channel_is_damage(tmp_path):
    """Found by mutation: the record of its channel was bent into another kind's."""
    with (tmp_path / "run.mcap").open("wb") as file:
        writer = Writer(file)
        writer.start()
        writer.add_message(channel_id=7, log_time=0, data=b"{}", publish_time=0)
        writer.finish()
    run = load(tmp_path)
    assert run.messages == ()
    assert run.ending.startswith("cut off or damaged")


def test_a_file_that_is_no_recording_is_refused(tmp_path):
    (tmp_path / "notes.mcap").write_text("these are notes, not a recording")
    with pytest.raises(RecordingError, match="is not an MCAP recording"):
        load(tmp_path / "notes.mcap")


def test_a_missing_file_and_an_empty_folder_are_refused(tmp_path):
    with pytest.raises(RecordingError, match="No such file"):
        load(tmp_path / "run.mcap")
    with pytest.raises(RecordingError, match="holds neither"):
        load(tmp_path)


KILLED = """
import os, signal, sys
from pathlib import Path
from hil.recording.channel import Channel
from hil.recording.channels import deadline
from hil.recording.identity import Identity
from hil.recording.recorder import CHUNK, Recorder
recorder = Recorder(Path(sys.argv[1]), Identity(1, "r", b""))
recorder.open()
for k in range(3 * CHUNK + 7):
    recorder.put(Channel.DEADLINE, 8_000_000 * k, deadline.encode(k, 0))
os.kill(os.getpid(), signal.SIGKILL)
"""


def test_a_killed_run_leaves_every_chunk_it_sent(tmp_path):
    env = os.environ | {"PYTHONPATH": os.pathsep.join(sys.path)}
    # stderr is shared with the writer: it reaches its end when the writer has ended too
    run = subprocess.run(
        [sys.executable, "-c", KILLED, str(tmp_path)], env=env, stderr=subprocess.PIPE, check=False
    )
    assert (run.returncode, run.stderr) == (-signal.SIGKILL, b"")
    part = load(tmp_path)
    assert part.ending == "the run did not finish"
    assert len(part.messages) == 3 * CHUNK
