"""One order for records that came in any order: by time, then channel, then arrival in it."""

from operator import itemgetter

from hil.recording.channel import Record

_time_and_channel = itemgetter(0, 1)


class Ordering:
    """Holds records back until nothing earlier can follow.

    Two processes deliver the same records interleaved differently; each channel has one source and
    keeps its own order, so the sorted stream is the same.
    """

    def __init__(self) -> None:
        self._held: list[Record] = []
        self._settled = -1

    def add(self, record: Record) -> None:
        self._held.append(record)

    def before(self, t: int) -> list[Record]:
        """Take out, in order, every record earlier than t, ns."""
        if t <= self._settled:
            return []
        self._settled = t
        due = [record for record in self._held if record.t < t]
        self._held = [record for record in self._held if record.t >= t]
        return sorted(due, key=_time_and_channel)  # stable: arrival order within a channel

    def rest(self) -> list[Record]:
        """Take out everything, in order."""
        due, self._held = self._held, []
        return sorted(due, key=_time_and_channel)
