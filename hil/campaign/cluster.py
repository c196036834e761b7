"""Runs on dask.distributed: slots beside each of its workers, on as many machines as it has.

A worker's thread only waits for its slot, so it does not matter whether dask's workers are
processes or threads, and none of them can be hurt by a run.
"""

import logging
from collections.abc import Iterable, Iterator
from contextlib import contextmanager
from queue import Empty, SimpleQueue

from distributed import Client, LocalCluster, Worker, WorkerPlugin, as_completed, get_worker

from hil.campaign.code import identity
from hil.campaign.errors import CampaignError
from hil.campaign.run import Outcome, Run
from hil.campaign.slot import Slot, Work

PATIENCE = 10
"""Wall seconds within which a scheduler must answer."""


class Slots(WorkerPlugin):
    """The slots of one dask worker, opened as its threads need them."""

    name = "hil-campaign"

    def __init__(self, work: Work) -> None:
        self._work = work

    def setup(self, worker: Worker) -> None:
        self._code = identity()
        self._idle: SimpleQueue[Slot] = SimpleQueue()
        self._opened: list[Slot] = []

    def perform(self, run: Run, code: str) -> Outcome:
        """One run on an idle slot; CampaignError unless this worker has the code asked for."""
        if code not in {"", self._code}:
            raise CampaignError(f"a worker runs {self._code}, this campaign {code}; update it")
        slot = self._slot()
        slot.submit(run)
        outcome = slot.outcome()
        self._idle.put(slot)
        return outcome

    def _slot(self) -> Slot:
        try:
            return self._idle.get_nowait()
        except Empty:
            slot = Slot(self._work)
            self._opened.append(slot)
            return slot

    def teardown(self, worker: Worker) -> None:
        for slot in self._opened:
            slot.close()


def _perform(run: Run, code: str) -> Outcome:
    plugin = get_worker().plugins[Slots.name]
    assert isinstance(plugin, Slots), "the pool registered it"
    return plugin.perform(run, code)


class DaskPool:
    """Performs runs on the workers of a client. code: what theirs must be, "" for any."""

    def __init__(self, client: Client, work: Work, code: str) -> None:
        self._client, self._work, self._code = client, work, code

    def outcomes(self, runs: Iterable[Run]) -> Iterator[tuple[Run, Outcome]]:
        self._client.register_plugin(Slots(self._work))
        futures = {self._client.submit(_perform, run, self._code, pure=False): run for run in runs}
        try:
            for future in as_completed(futures):
                yield futures[future], future.result()
        finally:
            self._client.cancel(list(futures))
            self._client.unregister_worker_plugin(Slots.name)


@contextmanager
def connected(scheduler: str, jobs: int) -> Iterator[Client]:
    """A client of the scheduler at an address, or of one in this process with `jobs` threads."""
    if not scheduler:
        with (
            LocalCluster(
                n_workers=1,
                threads_per_worker=jobs,
                processes=False,
                dashboard_address=None,
                silence_logs=logging.ERROR,
            ) as cluster,
            Client(cluster) as client,
        ):
            yield client
        return
    try:
        client = Client(scheduler, timeout=PATIENCE)
    except (OSError, ValueError) as error:
        raise CampaignError(f"no dask scheduler answers at {scheduler}: {error}") from None
    with client:
        yield client
