"""ur_rtde against the emulated controller, call by call, on both series: the table and its page.

python scripts/ur_rtde/compatibility.py --write docs/compatibility.md
python scripts/ur_rtde/compatibility.py --series cb3 --only moveJ --json
"""

import argparse
import json
import queue
import subprocess
import sys
import threading
from collections.abc import Iterator, Sequence
from pathlib import Path

import page
from case import Verdict
from cases import of_no_method, quick, rows, without_a_row
from cell import RIGS, Cell, own_address, served

CLIENT = Path(__file__).with_name("client.py")
SILENCE = 45.0
"""Longest that a row may take on a busy machine, s."""

Result = dict[str, Verdict]


def run(series: str, wanted: Sequence[str], host: str) -> Result:
    """Verdicts of the wanted rows against a fresh cell of the series."""
    found: Result = {}
    table = rows()
    with served(RIGS[series], host) as cell:
        while left := [row for row in wanted if row not in found]:
            for row, verdict in _attempt(cell, left):
                found[row] = verdict
                print(f"{series:9} {row:60} {verdict.result} {verdict.reason}", file=sys.stderr)
            stuck = next((row for row in left if row not in found), None)
            if stuck is not None:
                bug = table[stuck].bug
                found[stuck] = (
                    Verdict("client bug", f"{bug}; it then waits for ever")
                    if bug
                    else Verdict("FAIL", "the client hung or ended; see its stderr")
                )
                print(f"{series:9} {stuck:60} hung or ended", file=sys.stderr)
    return found


def _attempt(cell: Cell, left: Sequence[str]) -> Iterator[tuple[str, Verdict]]:
    """Rows that one client process decides, until it ends or falls silent."""
    version = [int(number) for number in cell.version.split(".")[:2]]
    order = {"host": cell.host, "version": version, "home": cell.home, "rows": list(left)}
    command = [sys.executable, str(CLIENT), json.dumps(order)]
    with subprocess.Popen(command, stdout=subprocess.PIPE, text=True) as child:
        try:
            for line in _lines(child):
                told = json.loads(line)
                yield told["row"], Verdict(told["result"], told["reason"])
        finally:
            child.kill()


def _lines(child: subprocess.Popen[str]) -> Iterator[str]:
    """Lines of a child until it ends or says nothing for long."""
    lines: queue.SimpleQueue[str] = queue.SimpleQueue()

    def pump() -> None:
        assert child.stdout is not None
        for line in child.stdout:
            lines.put(line)
        lines.put("")

    threading.Thread(target=pump, daemon=True).start()
    while True:
        try:
            line = lines.get(timeout=SILENCE)
        except queue.Empty:
            return
        if not line:
            return
        yield line


def both(series: Sequence[str], wanted: Sequence[str]) -> dict[str, Result]:
    """Each series in a thread of its own: the machine waits for motions, not for computing."""
    results: dict[str, Result] = {}

    def work(name: str, index: int) -> None:
        results[name] = run(name, wanted, own_address(index))

    threads = [threading.Thread(target=work, args=(s, k)) for k, s in enumerate(series)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    return {name: results[name] for name in series}


def selected(only: Sequence[str], short: bool) -> list[str]:
    """Rows whose name holds one of the words; all, or the quick ones, without words."""
    table = quick() if short else list(rows())
    found = [row for row in table if not only or any(word in row for word in only)]
    if not found:
        raise SystemExit(f"no row holds any of {', '.join(only)}; try moveJ")
    return found


def main(arguments: Sequence[str] | None = None) -> int:
    """Exit status 1 when a row fails, or a method of the client has none."""
    parser = argparse.ArgumentParser(description=__doc__.partition("\n")[0] if __doc__ else None)
    parser.add_argument("--series", choices=sorted(RIGS), action="append")
    parser.add_argument("--only", metavar="WORD", action="append", default=[])
    parser.add_argument("--quick", action="store_true", help="a selection of a minute")
    parser.add_argument("--json", action="store_true", help="print one JSON object")
    parser.add_argument("--write", metavar="PAGE", type=Path, help="write the page of all rows")
    asked = parser.parse_args(arguments)
    results = both(asked.series or sorted(RIGS), selected(asked.only, asked.quick))
    if asked.json:
        print(json.dumps(results, default=list))
    if asked.write:
        asked.write.write_text(page.text(results))
    for missing in without_a_row() + of_no_method():
        print(f"{missing}: a method without a row, or a row without a method", file=sys.stderr)
    failed = any(v.result == "FAIL" for result in results.values() for v in result.values())
    return int(failed or bool(without_a_row() + of_no_method()))


if __name__ == "__main__":
    sys.exit(main())
