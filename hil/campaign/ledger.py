"""The ledger: one SQLite file that holds what became of every run, and survives any death.

A row is written once, in a transaction of its own, when its run has ended; so there is nothing
half-done to clean up. The key holds everything that a run's figures depend on.
"""

import fcntl
import json
import os
import sqlite3
from collections.abc import Iterable, Iterator
from contextlib import closing, contextmanager
from hashlib import sha256
from pathlib import Path
from typing import NamedTuple

from hil.campaign.errors import CampaignError
from hil.campaign.run import Key, Outcome, Run, Verdict, canonical

APPLICATION = 0x48494C31
"""SQLite's application id of a ledger, "HIL1"."""

SCHEMA = """
CREATE TABLE IF NOT EXISTS rigs (digest TEXT PRIMARY KEY, content TEXT NOT NULL) WITHOUT ROWID;
CREATE TABLE IF NOT EXISTS runs (
    function TEXT NOT NULL, rig TEXT NOT NULL REFERENCES rigs, variant TEXT NOT NULL,
    seed INTEGER NOT NULL, code TEXT NOT NULL,
    verdict TEXT NOT NULL, reason TEXT NOT NULL, figures TEXT NOT NULL,
    timing TEXT NOT NULL, trace TEXT NOT NULL, wall REAL NOT NULL,
    PRIMARY KEY (function, rig, variant, seed, code)
) WITHOUT ROWID;
"""
COLUMNS = "function, rig, variant, seed, code, verdict, reason, figures, timing, trace, wall"
IDENTITY = "function = ? AND rig = ? AND variant = ? AND seed = ? AND code = ?"

_Row = tuple[str, str, str, int, str, str, str, str, str, str, float]


class Entry(NamedTuple):
    """One row. code: which code computed it."""

    key: Key
    code: str
    outcome: Outcome


class Ledger:
    """Rows of one code's runs beside those of others; `opened` makes one."""

    def __init__(self, store: sqlite3.Connection) -> None:
        self._store = store

    def find(self, run: Run, code: str) -> Outcome | None:
        """What became of a run computed by `code`, None if it has not been."""
        rows = self._store.execute(
            f"SELECT {COLUMNS} FROM runs WHERE {IDENTITY}", (*run.key, code)
        ).fetchall()
        return _entry(rows[0]).outcome if rows else None

    def put(self, run: Run, code: str, outcome: Outcome) -> None:
        """Keep what became of a run; on disk when this returns."""
        row = (
            *run.key, code, outcome.verdict.value, outcome.reason, canonical(outcome.figures),
            canonical(outcome.timing), outcome.trace, outcome.wall,
        )  # fmt: skip
        marks = ", ".join("?" * len(row))
        with self._store:
            rig = (run.key.rig, run.rig)
            self._store.execute("INSERT OR IGNORE INTO rigs VALUES (?, ?)", rig)
            self._store.execute(f"INSERT OR REPLACE INTO runs VALUES ({marks})", row)

    def forget(self, runs: Iterable[Run], code: str) -> None:
        """Drop these runs, so that they are computed again."""
        keys = [(*run.key, code) for run in runs]
        with self._store:
            self._store.executemany(f"DELETE FROM runs WHERE {IDENTITY}", keys)

    def entries(self) -> Iterator[Entry]:
        """Every row, in the order of the keys: whoever computed it, and when, leaves no trace."""
        order = "function, rig, variant, seed, code"
        for row in self._store.execute(f"SELECT {COLUMNS} FROM runs ORDER BY {order}"):
            yield _entry(row)

    def named(self, name: str) -> Run:
        """The run with this name, to perform it again; CampaignError when there is none."""
        keys = {entry.key for entry in self.entries() if entry.key.name == name}
        if not keys:
            raise CampaignError(f"the ledger holds no run '{name}'; `hil campaign show` lists them")
        (key,) = keys
        found = self._store.execute("SELECT content FROM rigs WHERE digest = ?", (key.rig,))
        ((content,),) = found.fetchall()
        return Run(key.function, content, key.seed, json.loads(key.variant))

    def digest(self) -> str:
        """SHA-256 of every row but its traces and wall-clock figures."""
        hashed = sha256()
        for key, code, outcome in self.entries():
            found = (outcome.verdict.value, outcome.reason, canonical(outcome.figures))
            hashed.update(canonical([*key, code, *found]).encode() + b"\n")
        return hashed.hexdigest()


@contextmanager
def opened(path: Path | None) -> Iterator[Ledger]:
    """The ledger in `path`, made if need be, or one in memory; no other campaign may have it."""
    if path is None:
        with closing(sqlite3.connect(":memory:")) as store:
            store.executescript(SCHEMA)
            yield Ledger(store)
        return
    with _alone(path), closing(_store(path, "rwc")) as store:
        yield Ledger(store)


@contextmanager
def reading(path: Path) -> Iterator[Ledger]:
    """The ledger in `path` to look at, also while a campaign writes it."""
    if not path.is_file():
        raise CampaignError(f"{path}: there is no ledger")
    with closing(_store(path, "rw")) as store:
        yield Ledger(store)


def _store(path: Path, mode: str) -> sqlite3.Connection:
    store = None
    try:
        store = sqlite3.connect(f"{path.absolute().as_uri()}?mode={mode}", uri=True)
        (tables,) = store.execute("SELECT count(*) FROM sqlite_master").fetchone()
        (application,) = store.execute("PRAGMA application_id").fetchone()
        if tables and application != APPLICATION:
            raise CampaignError(f"{path}: is a database, but no campaign's ledger")
        store.execute("PRAGMA journal_mode = WAL")
        store.execute(f"PRAGMA application_id = {APPLICATION}")
        store.executescript(SCHEMA)
    except (sqlite3.Error, CampaignError) as error:
        if store is not None:
            store.close()
        problem = f"{path}: cannot be used as a ledger: {error}"
        raise error if isinstance(error, CampaignError) else CampaignError(problem) from None
    return store


@contextmanager
def _alone(path: Path) -> Iterator[None]:
    """Hold the ledger's lock, which the kernel drops however this process ends.

    A file of its own: to close the ledger's would drop SQLite's locks (sqlite.org/howtocorrupt).
    """
    try:
        path.parent.mkdir(parents=True, exist_ok=True)
        lock = os.open(f"{path}-lock", os.O_RDWR | os.O_CREAT, 0o644)
    except OSError as error:
        raise CampaignError(f"{path}: cannot keep a ledger here: {error.strerror}") from None
    try:
        fcntl.flock(lock, fcntl.LOCK_EX | fcntl.LOCK_NB)
        yield
    except BlockingIOError:
        raise CampaignError(f"{path}: another campaign writes it; wait, or name another") from None
    finally:
        os.close(lock)


def _entry(row: _Row) -> Entry:
    function, rig, variant, seed, code, verdict, reason, figures, timing, trace, wall = row
    outcome = Outcome(
        Verdict(verdict), reason, json.loads(figures), json.loads(timing), trace, wall
    )
    return Entry(Key(function, rig, variant, seed), code, outcome)
