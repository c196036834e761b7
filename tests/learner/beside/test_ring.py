from multiprocessing import get_context

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from learner.beside.memory import Memory
from learner.beside.policy import PublishedPolicy
from learner.beside.ring import SLOT, Record, Ring
from learner.errors import RingGapError

RECORDS = st.lists(st.builds(Record, *[st.integers(0, 1000)] * 4, st.integers(-1, 2)), max_size=30)


def ends(slots):
    memory = np.zeros(slots, SLOT)
    return Ring(memory), Ring(memory)


@given(RECORDS, st.integers(0, 30))
def test_what_was_put_comes_out_once_and_in_order(records, early):
    writer, reader = ends(32)
    taken = []
    for i, record in enumerate(records):
        writer.put(record)
        if i == early:
            taken.append(reader.take())
    while (record := reader.take()) is not None:
        taken.append(record)
    assert taken == records
    assert reader.take() is None


@given(st.integers(1, 8), st.integers(1, 40))
def test_an_overwritten_record_is_an_error_and_never_another_record(slots, ahead):
    writer, reader = ends(slots)
    for i in range(slots + ahead):
        writer.put(Record(i, 0, 0, 0, -1))
    with pytest.raises(RingGapError, match="transition 1 was overwritten"):
        reader.take()


def test_a_record_that_is_being_written_is_not_there_yet():
    memory = np.zeros(4, SLOT)
    writer, reader = Ring(memory), Ring(memory)
    writer.put(Record(1, 2, 3, 4, -1))
    memory[0]["number"] = 0
    assert reader.take() is None


def test_a_policy_is_whole_and_its_version_grows():
    version, tables = np.zeros(1, np.uint64), np.zeros((2, 5), np.uint8)
    learner, control = PublishedPolicy(version, tables), PublishedPolicy(version, tables)
    for n in range(1, 5):
        learner.publish(np.full(5, n, np.uint8))
        assert control.version == n
        assert [control.action(row) for row in range(5)] == [n] * 5


def _write(layout, count):
    memory = Memory.attach(layout)
    for i in range(count):
        memory.ring.put(Record(i, i % 6, i + 1, i, -1))
        memory.policy.publish(np.full(10, i % 6, np.uint8))
    memory.close()


def test_two_processes_see_one_memory():
    memory = Memory(10)
    try:
        process = get_context("spawn").Process(target=_write, args=(memory.layout, 500))
        process.start()
        taken = []
        while len(taken) < 500:
            record = memory.ring.take()
            if record is not None:
                taken.append(record.before)
        process.join()
        assert process.exitcode == 0
        assert taken == list(range(500))
        assert memory.policy.version == 500
        assert memory.policy.action(3) == 499 % 6
        process.close()
    finally:
        memory.close()
