"""What the doors' log keeps of a flood."""

from hypothesis import given
from hypothesis import strategies as st

from hil.cell.arm.door_log import SAID, DoorLog, Event


@given(st.lists(st.sampled_from(Event), max_size=300))
def test_every_event_is_counted_and_few_have_a_line(events):
    said = []
    log = DoorLog(said.append)
    for event in events:
        log.note(event, f"a client: {event}")
    assert sum(log.counts.values()) == len(events)
    assert set(log.counts) == {event.value for event in events}
    assert len(said) <= len(set(events)) * (SAID + len(str(len(events))))


def test_the_first_events_and_then_each_power_of_ten_have_a_line():
    said = []
    log = DoorLog(said.append)
    for number in range(1, 1001):
        log.note(Event.CUT_OFF, f"client {number}")
    assert [line.split()[1] for line in said] == ["1", "2", "3", "10", "100", "1000"]
    assert "cut off: 1000 so far" in said[-1]
