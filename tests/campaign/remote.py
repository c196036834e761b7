"""A campaign on a dask scheduler with a worker process, both as on another machine.

remote.py LEDGER CODE: CODE is what the workers must run, "" for what this process runs.
"""

import sys
from pathlib import Path

from distributed import LocalCluster

from hil.campaign.campaign import Workers, carry_out
from hil.campaign.code import identity
from hil.campaign.errors import CampaignError
from hil.campaign.ledger import opened
from hil.campaign.plan import grid

if __name__ == "__main__":
    path, code = sys.argv[1:]
    series = grid("behaviours:mixed", "name: bench", range(25), limit=3.0)
    with (
        LocalCluster(n_workers=1, threads_per_worker=2, dashboard_address=None) as cluster,
        opened(Path(path)) as ledger,
    ):
        workers = Workers(scheduler=cluster.scheduler_address)
        try:
            found = carry_out(series, ledger, workers, code or identity())
        except CampaignError as error:
            print(error)
        else:
            print(*(outcome.verdict.value for outcome in found))
