"""One campaign as a process of its own, which a test may kill.

campaign.py LEDGER FUNCTION SEEDS JOBS VARIANT
"""

import json
import sys
from pathlib import Path

from hil.campaign.campaign import Workers, carry_out
from hil.campaign.ledger import opened
from hil.campaign.plan import grid

if __name__ == "__main__":
    path, function, seeds, jobs, variant = sys.argv[1:]
    series = grid(
        function, "name: bench", range(int(seeds)), limit=3.0, variants=[json.loads(variant)]
    )
    with opened(Path(path)) as ledger:
        workers = Workers(int(jobs))
        carry_out(series, ledger, workers, "tested", lambda run, _: print(run.seed, flush=True))
        print(ledger.digest())
