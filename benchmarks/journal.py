"""How fast a journal takes trials and gives them back, beside plain sqlite3 on the same rows.

A trial is two events: a plan with a policy of 14 numbers, and an outcome of 2 numbers. The
reference writes rows that are encoded already (and reads them without decoding), so that a ratio
says what the journal adds. Run it with ``python benchmarks/journal.py``.
"""

from __future__ import annotations

import argparse
import gc
import sqlite3
import tempfile
import time
from collections.abc import Callable, Iterator
from pathlib import Path

import numpy as np

from sgim.events import Event, Planned, Told
from sgim.records import Plan
from sgim.runs.codec import Codec
from sgim.runs.journal import Journal
from sgim.runs.rows import COLUMNS, SCHEMA, Row
from sgim.runs.writer import GROUP_ROWS
from sgim.spaces import Box
from sgim.task import Task

TASK = Task(Box(np.full(14, -1.0), 1.0), {"throw": Box([-1, -1], 1)})
INSERT = f"INSERT INTO events({', '.join(COLUMNS)}) VALUES ({', '.join('?' * len(COLUMNS))})"


def make_events(trials: int) -> list[Event]:
    rng = np.random.default_rng(0)
    policies, outcomes = rng.random((trials, 14)), rng.random((trials, 2))
    events: list[Event] = []
    for i in range(trials):
        events.append(Planned(Plan(i, i // 20, "random", None, policies[i], None, None)))
        events.append(Told(i, {"throw": outcomes[i]}, 0.5))
    return events


def seconds(work: Callable[[], object]) -> float:
    gc.collect()
    start = time.perf_counter()
    work()
    return time.perf_counter() - start


def plain(path: Path, *, durable: bool) -> sqlite3.Connection:
    db = sqlite3.connect(path, isolation_level=None)
    db.execute("PRAGMA journal_mode = WAL")
    db.execute(f"PRAGMA synchronous = {'FULL' if durable else 'NORMAL'}")
    for statement in SCHEMA:
        db.execute(statement)
    return db


def write_plain(db: sqlite3.Connection, rows: list[Row], group: int) -> None:
    for start in range(0, len(rows), group):
        db.execute("BEGIN IMMEDIATE")
        db.executemany(INSERT, rows[start : start + group])
        db.execute("COMMIT")


def write_journal(journal: Journal, events: list[Event]) -> None:
    for event in events:
        journal.append(event)
    journal.commit()


def exhaust(items: Iterator[object]) -> None:
    for _ in items:
        pass


def report(what: str, trials: int, taken: float, reference: float) -> None:
    print(
        f"{what:<16}{trials / taken:>12,.0f} trials/s{2 * trials / taken:>12,.0f} rows/s   "
        f"plain sqlite3 {trials / reference:>12,.0f} trials/s   time ratio {taken / reference:.2f}"
    )


def measure(directory: Path, trials: int, durable_trials: int) -> None:
    events = make_events(trials)
    codec = Codec(TASK)
    rows = [row for event in events for row in codec.encode(event)]

    with Journal.create(directory / "grouped.sgim", {}, TASK) as journal:
        append = seconds(lambda: write_journal(journal, events))
        decode = seconds(lambda: exhaust(journal.events()))
    db = plain(directory / "grouped.sqlite", durable=False)
    report("append, grouped", trials, append, seconds(lambda: write_plain(db, rows, GROUP_ROWS)))
    report("decode", trials, decode, seconds(lambda: exhaust(db.execute("SELECT * FROM events"))))
    db.close()

    few = 2 * durable_trials
    with Journal.create(directory / "durable.sgim", {}, TASK, durable=True) as journal:
        append = seconds(lambda: write_journal(journal, events[:few]))
    db = plain(directory / "durable.sqlite", durable=True)
    report(
        "append, durable", durable_trials, append, seconds(lambda: write_plain(db, rows[:few], 1))
    )
    db.close()


def main() -> None:
    parser = argparse.ArgumentParser(description="Speed of the journal beside plain sqlite3.")
    parser.add_argument("--trials", type=int, default=240_000, help="trials in grouped commits")
    parser.add_argument("--durable-trials", type=int, default=500, help="trials committed singly")
    parser.add_argument("--directory", type=Path, help="where to write; default: a temporary one")
    arguments = parser.parse_args()
    with tempfile.TemporaryDirectory(dir=arguments.directory) as directory:
        measure(Path(directory), arguments.trials, min(arguments.durable_trials, arguments.trials))


if __name__ == "__main__":
    main()
