"""What is not a journal, or may not be written, is refused with what was found and what to do."""

import os
import shutil
import sqlite3
import tempfile
from pathlib import Path

import numpy as np
import pytest

from sgim import events as e
from sgim.errors import JournalError
from sgim.runs.journal import Journal
from sgim.runs.journal_file import APPLICATION_ID
from sgim.runs.journal_reading import first_difference
from sgim.spaces import Box
from sgim.task import Task


@pytest.fixture
def path(tmp_path, task):
    """A finished journal of a thousand events."""
    path = tmp_path / "a.sgim"
    with Journal.create(path, {"seed": 7}, task) as journal:
        for i in range(1000):
            journal.append(e.Told(i, {"throw": np.full(2, i)}))
    return path


def refuses(path, message, task=None, append=None):
    for choice in (False, True) if append is None else (append,):
        with pytest.raises(JournalError, match=message):
            Journal.open(path, task, append=choice)
        assert not Path(f"{path}.lock").exists()


def change(path, statement):
    db = sqlite3.connect(path)
    db.execute(statement)
    db.commit()
    db.close()


def test_an_existing_file_is_never_overwritten(path, task):
    before = path.read_bytes()
    with pytest.raises(JournalError, match=r"exists already.*`sgim resume .*another path"):
        Journal.create(path, {}, task)
    assert path.read_bytes() == before


def test_a_place_where_nothing_can_be_made(path, task):
    with pytest.raises(JournalError, match=r"cannot be made.*another path"):
        Journal.create(path / "below" / "b.sgim", {}, task)


def test_a_header_that_is_not_json(tmp_path, task):
    with pytest.raises(JournalError, match=r"header must be JSON-compatible.*object"):
        Journal.create(tmp_path / "b.sgim", {"seed": object()}, task)
    assert list(tmp_path.iterdir()) == []


def test_a_missing_file(tmp_path):
    refuses(tmp_path / "b.sgim", "there is no journal .*check the path")
    assert list(tmp_path.iterdir()) == []


def test_a_directory(tmp_path):
    refuses(tmp_path, "is a directory")


def test_a_file_that_is_not_sqlite(tmp_path):
    path = tmp_path / "b.sgim"
    path.write_text("time,reward\n" * 1000)
    refuses(path, "is not a journal: it is no SQLite file")


def test_an_empty_file(tmp_path):
    path = tmp_path / "b.sgim"
    path.touch()
    refuses(path, "is empty.*delete it")


def test_somebody_elses_sqlite_file(tmp_path):
    path = tmp_path / "b.sgim"
    change(path, "CREATE TABLE events(seq INTEGER PRIMARY KEY)")
    refuses(path, rf"not a journal of sgim .*application_id is 0, expected {APPLICATION_ID}")


def test_a_newer_schema(path):
    change(path, "PRAGMA user_version = 2")
    refuses(path, "has schema 2, and this version of sgim reads up to 1.*upgrade")


def test_a_header_changed_by_hand(path):
    change(path, "UPDATE header SET value = 'seven' WHERE key = 'seed'")
    refuses(path, "header of journal .* is not JSON")


def test_a_header_without_task(path):
    change(path, "DELETE FROM header WHERE key = 'task'")
    refuses(path, "cannot be made from the journal alone")


@pytest.mark.parametrize("lost", [0.999, 0.9, 0.5, 0.1, 0.001])
def test_a_file_cut_short(path, lost):
    os.truncate(path, int(path.stat().st_size * (1 - lost)))
    refuses(path, "damaged or cut short|is no SQLite file")


def test_damage_in_the_middle(path):
    with path.open("r+b") as file:
        file.seek(path.stat().st_size // 2 // 4096 * 4096)
        file.write(b"\xff" * 4096)
    refuses(path, r"damaged or cut short .*\.recover", append=True)
    with (
        Journal.open(path, append=False) as journal,
        pytest.raises(JournalError, match="damaged or cut short"),
    ):
        list(journal.events())


def test_deleted_rows(path):
    change(path, "DELETE FROM events WHERE seq BETWEEN 10 AND 12")
    with (
        Journal.open(path, append=False) as journal,
        pytest.raises(JournalError, match="lacks 3 rows between 1 and 1000"),
    ):
        list(journal.events())


def test_another_task(path, task):
    spaces = {"throw": Box([0, 0], [1, 2], unit="m"), "word": task.outcome_spaces["word"]}
    other = Task(
        task.policy_space,
        spaces,
        goal_spaces=task.goal_spaces,
        context_space=task.context_space,
    )
    message = r"another task: outcomes\.throw\.high\[1\] is 1\.0 as recorded and 2\.0 here"
    refuses(path, message, other)


@pytest.mark.parametrize(
    ("recorded", "given", "difference"),
    [
        ({"a": [1, {"b": 2}]}, {"a": [1, {"b": 2}]}, None),
        ({"a": 1}, {"a": 1, "b": 2}, "b is here, but not recorded"),
        ({"a": {"b": 2}}, {"a": {}}, "a.b is recorded, but not here"),
        ({"a": [1, 2]}, {"a": [1]}, "a is [1, 2] as recorded and [1] here"),
        ({"a": None}, {"a": {"b": 1}}, "a is None as recorded and {'b': 1} here"),
    ],
)
def test_the_first_difference_is_named(recorded, given, difference):
    assert first_difference(recorded, given) == difference


def test_a_reader_does_not_write(path):
    with Journal.open(path, append=False) as journal:
        for write in (lambda: journal.append(e.Told(0, {})), journal.commit):
            with pytest.raises(JournalError, match="opened for reading"):
                write()


def test_another_program_that_writes_is_noticed(path, task):
    with Journal.open(path, task, append=True) as journal:
        change(path, "INSERT INTO events(event, plan) VALUES ('told', 1000)")
        journal.append(e.Told(1000, {"word": "ba"}))
        with pytest.raises(JournalError, match="1001 rows where this process left 1000"):
            journal.commit()
        change(path, "DELETE FROM events WHERE seq = 1001")


def test_what_sqlite_may_not_write_is_refused(path, task, monkeypatch):
    connect = sqlite3.connect
    monkeypatch.setattr(
        sqlite3, "connect", lambda place, **o: connect(place.replace("=rw", "=ro"), **o)
    )
    refuses(path, "readonly database; make it and its directory writable", task, append=True)


@pytest.fixture
def guarded():
    """A directory, and whoever may not write to it; permissions do not bind the superuser."""
    directory = Path(tempfile.mkdtemp())
    nobody, somebody = 65534, os.geteuid()
    if somebody == 0:
        directory.chmod(0o755)

    def protect():
        for file in directory.iterdir():
            file.chmod(0o444)
        directory.chmod(0o555)
        if somebody == 0:
            os.seteuid(nobody)

    yield directory, protect
    if somebody == 0:
        os.seteuid(somebody)
    directory.chmod(0o755)
    shutil.rmtree(directory)


def test_a_closed_journal_opens_where_nobody_may_write(path, guarded):
    directory, protect = guarded
    copy = shutil.copy(path, directory / "a.sgim")
    protect()
    with Journal.open(copy, append=False) as journal:
        assert len(list(journal.events())) == 1000
    refuses(copy, "cannot be written to: a.sgim.lock cannot be made.*append=False", append=True)


def test_a_log_that_was_emptied_is_no_obstacle(path, guarded):
    directory, protect = guarded
    copy = shutil.copy(path, directory / "a.sgim")
    change(copy, "PRAGMA journal_mode = WAL")
    assert copy.read_bytes()[18] == 2  # the file says that it has a log
    protect()
    with Journal.open(copy, append=False) as journal:
        assert len(list(journal.events())) == 1000


def test_a_log_that_cannot_be_read_is_not_passed_over(path, task, guarded):
    directory, protect = guarded
    with Journal.open(path, task, append=True) as journal:
        journal.append(e.Told(1000, {}))
        journal.commit()
        copy = shutil.copy(path, directory / "a.sgim")
        shutil.copy(f"{path}-wal", directory / "a.sgim-wal")
    protect()
    refuses(copy, r"was not closed, and a.sgim-wal .*copy both", append=False)


def test_a_commit_that_was_cut_off_is_undone_by_a_writer_only(path, task, tmp_path):
    copy = tmp_path / "copy.sgim"
    db = sqlite3.connect(path, isolation_level=None)
    db.execute("PRAGMA cache_size = 2")
    db.execute("BEGIN")
    db.executemany(
        "INSERT INTO events(event, plan) VALUES ('told', ?)", [(i,) for i in range(9999)]
    )
    shutil.copy(path, copy)
    shutil.copy(f"{path}-journal", f"{copy}-journal")
    db.execute("ROLLBACK")
    db.close()
    refuses(copy, r"was not closed, and copy.sgim-journal .*append=True", append=False)
    for append in (True, False):
        with Journal.open(copy, task, append=append) as journal:
            assert len(list(journal.events())) == 1000
