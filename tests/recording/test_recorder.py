import hashlib
from dataclasses import replace
from pathlib import Path

import pytest

from hil.recording.channel import Channel
from hil.recording.channels import deadline
from hil.recording.errors import RecordingError
from hil.recording.recorder import CHUNK, Recorder


def test_the_same_content_gives_the_same_bytes(tmp_path, record, entries):
    first = record(tmp_path / "a", entries)
    second = record(tmp_path / "b", entries)
    assert first == second
    assert (tmp_path / "a/run.mcap").read_bytes() == (tmp_path / "b/run.mcap").read_bytes()


def test_the_digest_is_the_files_sha256(tmp_path, record, entries):
    digest = record(tmp_path / "a", entries)
    assert digest == hashlib.sha256((tmp_path / "a/run.mcap").read_bytes()).hexdigest()


def test_another_value_gives_another_digest(tmp_path, record, entries):
    other = [
        *entries[:-2],
        (Channel.DEADLINE, 8_000_000 * 39, deadline.encode(39, 99)),
        entries[-1],
    ]
    assert record(tmp_path / "a", entries) != record(tmp_path / "b", other)


def test_order_between_channels_does_not_matter(tmp_path, record, entries):
    late_truth = [entries[-1], *entries[:-1]]
    assert record(tmp_path / "a", entries) == record(tmp_path / "b", late_truth)


def test_when_records_are_settled_and_sent_does_not_matter(tmp_path, record):
    many = [(Channel.DEADLINE, 8_000_000 * k, deadline.encode(k, 0)) for k in range(2 * CHUNK + 5)]
    streamed = record(tmp_path / "a", many, settled=range(len(many)))
    at_once = record(tmp_path / "b", many)
    assert streamed == at_once


def test_a_record_before_the_settled_time_is_refused(tmp_path, identity):
    with Recorder(tmp_path / "a", identity) as recorder:
        recorder.settle(16_000_000)
        with pytest.raises(ValueError, match="16000000 ns was settled"):
            recorder.put(Channel.DEADLINE, 8_000_000, deadline.encode(1, 0))


def test_a_run_that_ends_in_an_error_leaves_a_part_file_only(tmp_path, identity, entries):
    with Recorder(tmp_path / "a", identity) as recorder:
        recorder.put(*entries[0])  # and no close: what an exception in the run comes to
    assert [path.name for path in (tmp_path / "a").iterdir()] == ["run.mcap.part"]


def test_a_folder_that_holds_a_run_is_refused(tmp_path, record, entries):
    record(tmp_path / "a", entries)
    with pytest.raises(RecordingError, match="holds a run"):
        record(tmp_path / "a", entries)


def test_a_folder_without_a_run_is_taken_and_its_files_kept(tmp_path, record, entries):
    (tmp_path / "notes.txt").write_text("mine")
    (tmp_path / "run.mcap.part").write_text("what an interrupted run left")
    record(tmp_path, entries)
    assert {path.name for path in tmp_path.iterdir()} == {"notes.txt", "run.mcap"}


def test_a_folder_that_a_run_is_recorded_into_is_refused_even_to_overwrite(tmp_path, identity):
    with Recorder(tmp_path, identity), pytest.raises(RecordingError, match="another run"):
        Recorder(tmp_path, identity, overwrite=True).open()


def test_overwrite_replaces_the_recording_and_nothing_else(tmp_path, record, entries):
    first = record(tmp_path / "a", entries)
    (tmp_path / "a/notes.txt").write_text("mine")
    assert record(tmp_path / "a", entries[:-1], overwrite=True) != first
    assert (tmp_path / "a/notes.txt").read_text() == "mine"


@pytest.mark.parametrize("place", ["/sys/hil-recording", "/dev/null/run"])
def test_a_place_that_cannot_be_written_is_refused_before_anything_starts(place, identity):
    with pytest.raises(RecordingError, match="cannot record here"):
        Recorder(Path(place), identity).open()


def test_a_full_disk_is_one_clear_error(tmp_path, record, entries):
    (tmp_path / "run.mcap.part").symlink_to("/dev/full")
    with pytest.raises(RecordingError, match="No space left on device"):
        record(tmp_path, entries, overwrite=True)


def test_an_unknown_rtde_type_is_refused_at_once(tmp_path, identity):
    with pytest.raises(ValueError, match="RTDE has no type 'FLOAT'"):
        Recorder(tmp_path, replace(identity, recipes_out={1: (("timestamp", "FLOAT"),)}))
