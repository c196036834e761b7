"""The cell in a thread of this process."""

from collections import deque
from threading import Event, Thread
from typing import Self

from hil.app.cell import CellReport
from hil.app.pacing import pace
from hil.app.tap import Entry, entries, ignore
from hil.cell.plant.interface import PlantStep
from hil.cell.rig import Rig
from hil.cell.serve import Doors, Observer, ServedCell, Tick


class InlineCell:
    """Owns a served cell and its thread; construction opens the doors, `with` starts the clock.

    observe: sees each period as it ends, in the cell's thread, instead of its being recorded.
    """

    live = True

    def __init__(
        self,
        rig: Rig,
        seed: int,
        clock: str,
        *,
        record: bool = True,
        observe: Observer | None = None,
    ) -> None:
        from hil.cell.assemble import serve  # noqa: PLC0415  MuJoCo loads only with a cell

        self.served: ServedCell = serve(rig, seed, across_processes=False)
        self._clock = clock
        self._ticks: deque[Tick] = deque()
        self._observe = observe or (self._ticks.append if record else ignore)
        self._stopped = Event()
        self._failure: BaseException | None = None
        self._report: CellReport | None = None
        self._thread = Thread(target=self._run, name="cell")

    @property
    def doors(self) -> Doors:
        return self.served.doors

    @property
    def description(self) -> str:
        return f"cell in this process, {self.served.describe()}"

    def truth(self) -> PlantStep:
        """The plant at the end of the last period."""
        return self.served.bench.truth

    def take(self) -> list[Entry]:
        """Records made since the last call, oldest first; packed here, not in the cell's thread."""
        ticks = [self._ticks.popleft() for _ in range(len(self._ticks))]
        return [entry for tick in ticks for entry in entries(tick)]

    def coast(self, periods: int) -> None:
        """Let so many periods pass with nobody's command; the clock of the cell's own then stands.

        Raises what the cell died of, if it did.
        """
        self._stopped.set()
        self._thread.join()
        if self._failure is not None:
            raise self._failure
        self.served.coast(periods, self._observe)

    def stop(self) -> CellReport:
        """Stop and close every door; raises what the cell died of, if it did."""
        self._halt()
        if self._failure is not None:
            raise self._failure
        return self._report or CellReport(0, None, ())

    def _run(self) -> None:
        try:
            self._report = pace(self.served, self._clock, self._stopped.is_set, self._observe)
        except BaseException as error:
            self._failure = error
            self.served.close()  # so that whoever waits on a wire learns of it

    def __enter__(self) -> Self:
        self._thread.start()
        return self

    def __exit__(self, *_: object) -> None:
        self._halt()

    def _halt(self) -> None:
        self._stopped.set()
        if self._thread.ident is not None:
            self._thread.join()
        self.served.close()
