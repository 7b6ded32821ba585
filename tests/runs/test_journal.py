"""A journal keeps events in order, exactly, for a writer and its readers."""

import sqlite3
from concurrent.futures import ThreadPoolExecutor

import numpy as np
import pytest

from sgim import events as e
from sgim.errors import JournalError, UnknownNameError
from sgim.runs.journal import Journal
from sgim.spaces import Box
from sgim.task import Task

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


def test_every_event_comes_back_exactly_after_reopening(path, task, every_event, same):
    with Journal.create(path, {}, task) as journal:
        for event in every_event:
            journal.append(event)
        assert len(journal) == len(every_event)
    with Journal.open(path, task, append=False) as journal:
        assert len(journal) == len(every_event)
        assert all(map(same, every_event, journal.events()))


def test_reading_in_many_pages_is_the_same(path, task, every_event, same, monkeypatch):
    monkeypatch.setattr("sgim.runs.journal_reading.PAGE", 3)
    with Journal.create(path, {}, task) as journal:
        for event in every_event:
            journal.append(event)
        decoded = list(journal.events())
    assert len(decoded) == len(every_event)
    assert all(map(same, every_event, decoded))


def test_the_header_comes_back_with_schema_and_task(path, task):
    with Journal.create(path, {"seed": 7, "learner": {"k": [1, None]}}, task) as journal:
        written = journal.header
    with Journal.open(path, append=False) as journal:
        assert journal.header == written
        assert journal.header["seed"] == 7
        assert journal.header["learner"] == {"k": [1, None]}
        assert journal.header["schema"] == 1
        assert journal.task.describe() == task.describe()


def test_an_empty_journal_is_true(journal):
    assert journal
    assert len(journal) == 0
    assert list(journal.events()) == []


def test_a_stranger_reads_it_with_plain_sqlite(journal, path):
    journal.append(e.Told(3, BOTH, 2.5))
    journal.close()
    db = sqlite3.connect(path)
    rows = db.execute("SELECT seq, event, plan, kind, point, seconds FROM events").fetchall()
    header = dict(db.execute("SELECT * FROM header"))
    schema = "".join(
        text for (text,) in db.execute("SELECT sql FROM sqlite_schema WHERE sql != ''")
    )
    db.close()
    vector = np.array([0.25, 0.5]).tobytes()
    assert rows == [(1, "told", 3, "throw", vector, 2.5), (2, "also", 3, "word", b"da", None)]
    assert header["seed"] == "7"
    assert "little-endian float64" in schema


def test_appending_goes_on_where_the_last_process_ended(path, task):
    Journal.create(path, {}, task).close()
    for i in range(3):
        with Journal.open(path, task, append=True) as journal:
            journal.append(e.Told(i, BOTH))
    with Journal.open(path, task, append=False) as journal:
        assert told(journal.events()) == [0, 1, 2]


def test_a_closed_journal_is_a_single_file(journal, path):
    journal.append(e.Told(0, {}))
    journal.close()
    assert [file.name for file in path.parent.iterdir()] == [path.name]


def test_an_idle_reader_does_not_keep_a_writer_from_closing(journal, path, task):
    journal.append(e.Told(0, {}))
    journal.commit()
    with Journal.open(path, append=False) as reader:
        assert told(reader.events()) == [0]
        journal.append(e.Told(1, {}))
        journal.close()
        assert told(reader.events()) == [0, 1]
    with Journal.open(path, task, append=True) as again:
        assert len(again) == 2
    assert [file.name for file in path.parent.iterdir()] == [path.name]


def test_a_closed_journal_refuses_and_closing_again_is_nothing(journal):
    journal.close()
    journal.close()
    with pytest.raises(JournalError, match=r"closed; open it again"):
        journal.append(e.Told(0, {}))
    with pytest.raises(JournalError, match="closed"):
        journal.events()


def test_a_reader_sees_what_was_committed_while_the_writer_goes_on(journal, path):
    with Journal.open(path, append=False) as reader:
        journal.append(e.Told(0, BOTH))
        assert len(reader) == 0
        journal.commit()
        ((seq, event),) = reader.entries()
        assert (seq, event.plan) == (2, 0)
        journal.append(e.Told(1, {}))
        journal.commit()
        assert told(reader.events(after=seq)) == [1]


def test_reading_begins_behind_any_row(journal):
    for i in range(3):
        journal.append(e.Told(i, BOTH))
    assert [told(journal.events(after=k)) for k in range(7)] == [
        [0, 1, 2],
        [1, 2],
        [1, 2],
        [2],
        [2],
        [],
        [],
    ]


def test_reading_only_some_events(journal, every_event, same):
    for event in every_event:
        journal.append(event)
    wanted = [event for event in every_event if isinstance(event, e.Closed | e.Observed)]
    chosen = list(journal.events(only=("closed", "observed")))
    assert len(chosen) == len(wanted)
    assert all(map(same, wanted, chosen))
    with pytest.raises(UnknownNameError, match="Did you mean 'closed'"):
        journal.events(only=["close"])


def test_threads_may_pass_it_on(journal):
    with ThreadPoolExecutor(1) as pool:
        pool.submit(journal.append, e.Told(0, BOTH)).result()
        pool.submit(journal.commit).result()
    assert told(journal.events()) == [0]


def test_a_space_of_ones_own_needs_its_task(path):
    class Picture(Box):
        def describe(self):
            return {"space": "picture", "shape": (2, 2)}

    task = Task(Box(0, 1), {"picture": Picture(0, [1, 1, 1, 1])})
    with Journal.create(path, {}, task) as journal:
        journal.append(e.Told(0, {"picture": np.arange(4.0)}))
    with pytest.raises(JournalError, match=r"cannot be made from the journal alone.*pass it"):
        Journal.open(path, append=False)
    with Journal.open(path, task, append=False) as journal:
        (event,) = journal.events()
    assert event.outcome["picture"].tolist() == [0.0, 1.0, 2.0, 3.0]
