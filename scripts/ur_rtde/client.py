"""The client's process: runs the rows it is given, one JSON line a row as soon as it is decided.

Its only input is the JSON object in argv[1]: host, version, home, rows. A call of ur_rtde may hang
or end the process; its parent (compatibility.py) then says so and goes on with the next row.
"""

import json
import os
import sys

from case import judge
from cases import rows
from robot import Robot


def main(order: str) -> None:
    job = json.loads(order)
    robot = Robot(job["host"], tuple(job["version"]), job["home"])
    out = os.fdopen(os.dup(1), "w")
    os.dup2(2, 1)  # the client's C++ side writes to stdout, which is ours
    table = rows()
    for row in job["rows"]:
        try:
            robot.ready()
        except Exception as error:
            raise SystemExit(f"{row}: the arm could not be made ready: {error}") from error
        verdict = judge(table[row], robot)
        print(json.dumps({"row": row, **verdict._asdict()}), file=out, flush=True)
    robot.close()


if __name__ == "__main__":
    main(sys.argv[1])
