"""What the bus carried, in the files that other tools write and read."""

import re
import subprocess

import can
import pytest

from drivers.nrs.bus import open_bus

PERIODS = 40
EPOCH = 1.7e9
"""Seconds; BLF keeps a calendar date, so zero is none in every time zone."""


@pytest.fixture
def traffic(can_cell):
    """(messages a bystander saw, force vectors our driver gave) of a streaming sensor."""
    with can_cell("virtual") as cell, open_bus(cell.gateway.address, fd=False) as bystander:
        cell.stream()
        given = []
        for _ in range(PERIODS):
            cell.load = cell.load * 0.97
            given += [sample[:3] for sample in cell.read().samples]
        messages = []
        while (message := bystander.recv(0)) is not None:
            message.timestamp = EPOCH + len(messages) * 1e-4  # a virtual bus gives none
            messages.append(message)
    return messages, given


def write(path, messages):
    with can.Logger(path) as log:
        for message in messages:
            log(message)


@pytest.mark.parametrize("suffix", [".log", ".blf"])
def test_a_log_gives_back_every_frame(traffic, frame_of, tmp_path, suffix):
    messages, _ = traffic
    messages += [
        can.Message(
            timestamp=messages[-1].timestamp + 1e-3,
            arbitration_id=0x1A1,
            data=bytes(range(24)),
            is_fd=True,
            bitrate_switch=True,
            is_extended_id=False,
        )
    ]
    path = tmp_path / f"bus{suffix}"
    write(path, messages)
    with can.LogReader(path) as log:
        back = list(log)
    assert [frame_of(one) for one in back] == [frame_of(one) for one in messages]
    assert [one.timestamp for one in back] == pytest.approx(
        [one.timestamp for one in messages], abs=2e-6
    )


def test_error_frames_survive_a_blf_with_their_class(traffic, tmp_path):
    messages, _ = traffic
    passive = can.Message(
        timestamp=messages[-1].timestamp + 1e-3,
        arbitration_id=0x204,
        data=bytes([0, 0x20, 0, 0, 0, 0, 128, 0]),
        is_error_frame=True,
        is_extended_id=False,
    )
    write(tmp_path / "bus.blf", [*messages, passive])
    with can.LogReader(tmp_path / "bus.blf") as log:
        *_, last = log
    assert last.is_error_frame


def test_cantools_decodes_a_log_to_what_the_driver_gave(traffic, cantools, dbc, tmp_path):
    messages, given = traffic
    write(tmp_path / "bus.log", messages)
    decode = subprocess.run(
        [*cantools, "decode", "--single-line", dbc],
        input=(tmp_path / "bus.log").read_text(),
        capture_output=True,
        text=True,
        timeout=60,
        check=True,
    )
    forces = [
        rounded(map(float, re.findall(r"F[xyz]: (\S+) N", line)))
        for line in decode.stdout.splitlines()
        if "NRS1_FORCE" in line
    ]
    assert "Unknown" not in decode.stdout
    # The log begins before the driver's first sample and may end with half a sample.
    given = [rounded(one) for one in given]
    start = forces.index(given[0])
    assert forces[start : start + len(given)] == given
    assert len(forces) <= start + len(given) + 1


def rounded(force):
    """Both sides multiply a count by 0.015 N, in their own way."""
    return tuple(round(value, 6) for value in force)
