"""The cell in a thread of this process."""

from collections import deque
from threading import Event, Thread
from typing import Self

from hil.app.cell import CellReport
from hil.app.faulty import Teller, failing, served
from hil.app.pacing import pace
from hil.app.tap import Entry, entries, ignore
from hil.cell.faults.schedule import Numbered
from hil.cell.plant.interface import PlantStep
from hil.cell.rig import Rig
from hil.cell.serve import Doors, Observer, Tick


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
        faults: Numbered | None = None,
    ) -> None:
        """faults: the cell's own ones; None is a sound cell, () one that can be told of the job."""
        self.served = served(rig, seed, faults, across_processes=False)
        self._clock = clock
        self._ticks: deque[Tick] = deque()
        self._told: deque[Entry] = deque()
        self._teller = None if faults is None else Teller(self.served)
        self._observe = observe or (self._observer() if record else ignore)
        self._stopped = Event()
        self._failure: BaseException | None = None
        self._report: CellReport | None = None
        self._thread = self._server()

    @property
    def doors(self) -> Doors:
        return self.served.doors

    @property
    def description(self) -> str:
        return f"cell in this process, {self.served.describe()}"

    def truth(self) -> PlantStep:
        """The plant at the end of the last period."""
        return self.served.bench.truth

    def note(self, phase: str, episode: int) -> None:
        """Where the job stands, before the command that lets a period pass."""
        failing(self.served).note(phase, episode)

    def leave(self, duration: int) -> None:
        """The host is not there for so long, ns."""
        failing(self.served).leave(duration)

    def take(self) -> list[Entry]:
        """Records made since the last call, oldest first; packed here, not in the cell's thread."""
        ticks = [self._ticks.popleft() for _ in range(len(self._ticks))]
        told = [self._told.popleft() for _ in range(len(self._told))]
        return [entry for tick in ticks for entry in entries(tick)] + told

    def coast(self, periods: int) -> None:
        """Let so many periods pass with nobody's command; the clock of the cell's own then stands.

        Raises what the cell died of, if it did.
        """
        self._stopped.set()
        self._thread.join()
        if self._failure is not None:
            raise self._failure
        self.served.coast(periods, self._observe)

    def serve_again(self) -> None:
        """Go on serving after `coast`."""
        self._stopped.clear()
        self._thread = self._server()
        self._thread.start()

    def stop(self) -> CellReport:
        """Stop and close every door; raises what the cell died of, if it did."""
        self._halt()
        if self._failure is not None:
            raise self._failure
        return self._report or CellReport(0, None, ())

    def _server(self) -> Thread:
        # A cell that nobody closed must not keep the interpreter from ending.
        return Thread(target=self._run, name="cell", daemon=True)

    def _run(self) -> None:
        try:
            self._report = pace(self.served, self._clock, self._stopped.is_set, self._observe)
        except BaseException as error:
            self._failure = error
            self.served.close()  # so that whoever waits on a wire learns of it

    def _observer(self) -> Observer:
        teller = self._teller
        if teller is None:
            return self._ticks.append

        def observe(tick: Tick) -> None:
            self._ticks.append(tick)
            self._told.extend(teller(tick.t))

        return observe

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
