"""Events are written in groups or one by one, and a full disk or an interrupt loses none."""

import itertools
import sqlite3
from collections import deque
from types import SimpleNamespace

import numpy as np
import pytest

from sgim import events as e
from sgim.errors import JournalError
from sgim.records import Plan
from sgim.runs import journal_mode, writer
from sgim.runs.journal import Journal

BOTH = {"throw": np.array([0.25, 0.5]), "word": "da"}


@pytest.fixture
def path(tmp_path):
    return tmp_path / "runs" / "a run.sgim"


@pytest.fixture
def journal(path, task):
    with Journal.create(path, {"seed": 7}, task) as journal:
        yield journal


def told(events):
    return [event.plan for event in events]


def test_events_wait_until_a_group_is_full(journal, path, monkeypatch):
    monkeypatch.setattr(writer, "GROUP_ROWS", 4)
    monkeypatch.setattr(writer, "GROUP_SECONDS", 1e9)
    with Journal.open(path, append=False) as reader:
        seen = []
        for i in range(9):
            journal.append(e.Told(i, {}))
            seen.append(len(reader))
            assert len(journal) == i + 1
        assert seen == [0, 0, 0, 4, 4, 4, 4, 8, 8]


def test_events_wait_no_longer_than_a_group_may(journal, path, monkeypatch):
    clock = iter([0.0, 0.9, 1.1, 1.2])
    monkeypatch.setattr(writer, "time", SimpleNamespace(monotonic=lambda: next(clock)))
    with Journal.open(path, append=False) as reader:
        seen = []
        for i in range(4):
            journal.append(e.Told(i, {}))
            seen.append(len(reader))
    assert seen == [0, 0, 3, 3]


def test_a_durable_journal_writes_each_event_at_once(path, task):
    with (
        Journal.create(path, {}, task, durable=True) as journal,
        Journal.open(path, append=False) as reader,
    ):
        for i in range(3):
            journal.append(e.Told(i, BOTH))
            assert len(reader) == i + 1
        assert journal._db.execute("PRAGMA synchronous").fetchone() == (2,)


def test_an_event_that_does_not_fit_leaves_nothing_behind(journal):
    with pytest.raises(JournalError, match="unknown outcome kind"):
        journal.append(e.Told(0, {"throw": np.zeros(2), "thrown": np.zeros(2)}))
    assert len(journal) == 0


def test_a_full_disk_loses_nothing(journal, path, task):
    journal.append(e.Told(0, {}))
    journal.commit()
    journal._db.execute("PRAGMA max_page_count = 8")
    for i in range(1, 1000):
        journal.append(e.Told(i, BOTH))
    message = r"full\. 999 events are not yet written and kept in memory: make space on the disk"
    for _ in range(2):
        with pytest.raises(JournalError, match=message):
            journal.commit()
    with pytest.raises(JournalError, match="999 events"):
        journal.close()
    with Journal.open(path, append=False) as reader:
        assert told(reader.events()) == [0]
    assert len(journal) == 1000
    journal._db.execute("PRAGMA max_page_count = 100000")
    journal.append(e.Told(1000, {}))
    journal.commit()
    assert told(journal.events()) == list(range(1001))


def test_a_durable_append_on_a_full_disk_keeps_the_event(path, task):
    with Journal.create(path, {}, task, durable=True) as journal:
        pages = journal._db.execute("PRAGMA page_count").fetchone()[0]
        journal._db.execute(f"PRAGMA max_page_count = {pages}")
        plans = (Plan(i, 0, "random", None, np.ones(3), None, None) for i in range(10**6))
        written = itertools.count(1)
        with pytest.raises(JournalError, match="1 event is not yet written"):
            deque(journal.append(e.Planned(plan)) for plan in plans if next(written))
        journal._db.execute("PRAGMA max_page_count = 100000")
        journal.append(e.Told(0, {}))
        assert len(list(journal.events())) == next(written)


class _Interrupting:
    """A connection on which Ctrl-C comes right after a commit has been done."""

    def __init__(self, db):
        self._db = db

    def execute(self, statement, *values):
        result = self._db.execute(statement, *values)
        if statement == "COMMIT":
            raise KeyboardInterrupt
        return result

    def __getattr__(self, name):
        return getattr(self._db, name)


def test_an_interrupt_right_after_a_commit_writes_nothing_twice(journal, monkeypatch):
    for i in range(3):
        journal.append(e.Told(i, BOTH))
    with monkeypatch.context() as patch:
        patch.setattr(journal._writer, "_db", _Interrupting(journal._db))
        with pytest.raises(KeyboardInterrupt):
            journal.commit()
    journal.append(e.Told(3, {}))
    assert told(journal.events()) == [0, 1, 2, 3]


def test_without_a_write_ahead_log_it_says_so_and_works(path, task, monkeypatch):
    connect = sqlite3.connect
    # This way of SQLite's to use files has no shared memory, as network file systems have none.
    monkeypatch.setattr(
        sqlite3, "connect", lambda place, **options: connect(f"{place}&vfs=unix-none", **options)
    )
    with pytest.warns(UserWarning, match=r"cannot share a write-ahead log.*mode DELETE") as warned:
        journal = Journal.create(path, {}, task)
    assert warned[0].filename == __file__
    journal.append(e.Told(0, BOTH))
    journal.commit()
    with Journal.open(path, append=False) as reader:
        assert told(reader.events()) == [0]
    journal.close()
    assert [file.name for file in path.parent.iterdir()] == [path.name]


def test_a_network_file_system_is_known_by_its_mount(path, task, tmp_path, monkeypatch):
    mounts = tmp_path / "mounts"
    mounts.write_text(
        "/dev/sda / ext4 rw 0 0\nhost:/x /home nfs4 rw 0 0\n/dev/b /home/b ext4 rw 0 0\n"
    )
    kind = journal_mode.network_file_system
    assert kind(path, mounts) is None
    assert kind(type(path)("/home/a/run.sgim"), mounts) == "nfs4"
    assert kind(type(path)("/home/b/run.sgim"), mounts) is None
    assert kind(path, tmp_path / "missing") is None
    monkeypatch.setattr(journal_mode, "network_file_system", lambda path: "nfs4")
    with pytest.warns(UserWarning, match=r"\(nfs4\)"):
        journal = Journal.create(path, {}, task)
    with journal:
        assert journal._db.execute("PRAGMA journal_mode").fetchone() == ("delete",)
