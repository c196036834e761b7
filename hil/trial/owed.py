"""Which faults are in force now, and whether one of them has to stop the arm."""

from collections.abc import Callable, Mapping, Sequence

from hil.cell.faults.log import FaultEvent, Stage
from hil.cell.faults.schedule import Numbered
from hil.trial.fmea import Entry

Events = Callable[[], Sequence[FaultEvent]]


class Owed:
    """Follows the logs of one run. A fault of one moment is owed a stop until the run's end.

    Not one that was over before the job began: bringing the arm up is setting right what it finds.
    """

    def __init__(self, faults: Numbered, fmea: Mapping[str, Entry], *logs: Events) -> None:
        self._stops = {index for index, fault in faults if fmea[fault.kind].stops(fault)}
        self._moments = {index for index, fault in faults if not fault.row.lasting}
        self._logs = [(log, 0) for log in logs]
        self._active: set[int] = set()

    def __call__(self, running: bool) -> tuple[int, bool]:
        """Faults in force, and whether a stop is owed; running: a job is under way."""
        for at, (log, seen) in enumerate(self._logs):
            events = log()
            for event in events[seen:]:
                self._hear(event, running)
            self._logs[at] = log, len(events)
        return len(self._active), not self._active.isdisjoint(self._stops)

    def _hear(self, event: FaultEvent, running: bool) -> None:
        if event.stage is Stage.ACTIVE:
            self._active.add(event.index)
        elif event.stage is Stage.CLEARED and not (running and event.index in self._moments):
            self._active.discard(event.index)
