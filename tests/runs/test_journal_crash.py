"""A killed process leaves whole events, and no lock."""

import gc
import os
import random
import signal
import subprocess
import sys

import numpy as np
import pytest

from sgim import events as e
from sgim.errors import JournalError
from sgim.records import Plan
from sgim.runs import journal_file
from sgim.runs.journal import Journal
from sgim.spaces import Box
from sgim.task import Task

TASK = Task(Box(np.zeros(5), 1), {"a": Box([0, 0], 1), "b": Box(0, 1)})

WRITER = """
import random, sys
from test_journal_crash import TASK, planned, told
from sgim.runs.journal import Journal

path, seed, durable = sys.argv[1], int(sys.argv[2]), sys.argv[3] == "durable"
draw = random.Random(seed)
journal = Journal.open(path, TASK, append=True, durable=durable)
i = len(journal) // 2
while True:
    for _ in range(draw.randrange(1, 4 if durable else 40)):
        journal.append(planned(i))
        journal.append(told(i))
        i += 1
    if draw.random() < 0.3:
        journal.commit()
        print(2 * i, flush=True)
"""


def planned(i):
    return e.Planned(Plan(i, i // 20, "random", None, np.full(5, i / 7), None, None))


def told(i):
    return e.Told(i, {"a": np.array([i, -i]) / 3, "b": np.array([i / 11])})


def start(path, seed, durable=False):
    environment = {
        **os.environ,
        "PYTHONPATH": os.pathsep.join([os.path.dirname(__file__), *sys.path]),
    }
    return subprocess.Popen(
        [sys.executable, "-c", WRITER, str(path), str(seed), "durable" if durable else "grouped"],
        stdout=subprocess.PIPE,
        text=True,
        env=environment,
    )


def kill(process):
    """Kill it, and return the last number of events that it said were committed."""
    process.send_signal(signal.SIGKILL)
    heard = process.stdout.read().splitlines()
    process.stdout.close()
    process.wait()
    return heard


def intact(events):
    """Whether events are the writer's, in order from the first, each as it was made."""
    expected = (make(i) for i in range(10**9) for make in (planned, told))
    for event, made in zip(events, expected, strict=False):
        if isinstance(made, e.Planned):
            assert event.id == made.plan.id
            assert event.policy.tolist() == made.plan.policy.tolist()
        else:
            assert event.plan == made.plan
            assert {k: v.tolist() for k, v in event.outcome.items()} == {
                k: v.tolist() for k, v in made.outcome.items()
            }
    return True


@pytest.mark.parametrize("durable", [False, True], ids=["grouped", "durable"])
def test_kills_at_random_moments_leave_a_prefix_of_whole_events(tmp_path, durable):
    path = tmp_path / "a.sgim"
    Journal.create(path, {}, TASK).close()
    draw = random.Random(3)
    for seed in range(4):
        process = start(path, seed, durable)
        for _ in range(draw.randrange(1, 20)):
            line = process.stdout.readline()
        rest = kill(process)
        committed = [int(text) for text in (line, *rest[:-1])][-1]
        with Journal.open(path, append=False) as journal:
            events = list(journal.events())
            assert intact(events)
            assert len(events) >= committed
        with Journal.open(path, TASK, append=True) as journal:  # nobody holds the lock
            assert len(journal) == len(events)
            if len(events) % 2:  # killed between a plan and its outcome
                journal.append(told(len(events) // 2))


def test_a_live_writer_keeps_others_from_writing_but_not_from_reading(tmp_path):
    path = tmp_path / "a.sgim"
    Journal.create(path, {}, TASK).close()
    process = start(path, 0)
    committed = int(process.stdout.readline())
    try:
        message = f"is being written by process {process.pid} on .*append=False"
        for _ in range(2):
            with pytest.raises(JournalError, match=message):
                Journal.open(path, TASK, append=True)
        with Journal.open(path, append=False) as reader:
            events = list(reader.events())
            assert len(events) >= committed
            assert intact(events)
    finally:
        kill(process)
    with Journal.open(path, TASK, append=True) as journal:
        assert len(journal) >= len(events)


def test_one_process_does_not_write_twice(tmp_path):
    path = tmp_path / "a.sgim"
    link = tmp_path / "link.sgim"
    link.symlink_to(path)
    with Journal.create(path, {}, TASK):
        for name in (path, link):
            with pytest.raises(JournalError, match=f"written by process {os.getpid()}"):
                Journal.open(name, TASK, append=True)
    Journal.open(link, TASK, append=True).close()


def test_a_forgotten_journal_does_not_keep_the_lock(tmp_path):
    path = tmp_path / "a.sgim"
    journal = Journal.create(path, {}, TASK)
    journal._db.close()  # newer Pythons warn of a connection that is forgotten
    del journal
    gc.collect()
    Journal.open(path, TASK, append=True).close()


def test_what_is_left_of_a_killed_and_deleted_journal_does_not_get_into_a_new_one(tmp_path):
    path = tmp_path / "a.sgim"
    Journal.create(path, {}, TASK).close()
    process = start(path, 0)
    process.stdout.readline()
    kill(process)
    path.unlink()
    assert (tmp_path / "a.sgim-wal").exists()
    with Journal.create(path, {}, TASK) as journal:
        journal.append(told(5))
        assert [event.plan for event in journal.events()] == [5]


class Killing(tuple):
    """Statements that kill the process that goes through them, before one of them."""

    def __iter__(self):
        for i, statement in enumerate(super().__iter__()):
            if i == 1:
                os.kill(os.getpid(), signal.SIGKILL)
            yield statement


def test_a_kill_while_a_journal_is_made_leaves_none_and_the_next_makes_it(tmp_path, monkeypatch):
    path = tmp_path / "a.sgim"
    child = os.fork()
    if not child:
        monkeypatch.setattr(journal_file, "SCHEMA", Killing(journal_file.SCHEMA))
        try:
            Journal.create(path, {}, TASK)
        finally:
            os._exit(0)
    assert os.WTERMSIG(os.waitpid(child, 0)[1]) == signal.SIGKILL
    assert not path.exists()
    with Journal.create(path, {}, TASK) as journal:
        journal.append(told(5))
    with Journal.open(path, TASK, append=False) as journal:
        assert [event.plan for event in journal.events()] == [5]
    left = [p.name for p in tmp_path.iterdir() if not p.name.endswith((".lock", ".new-journal"))]
    assert len(left) == 2  # and a hidden file, of no use
    assert all(name == "a.sgim" or name.startswith(".") for name in left)


def test_a_journal_made_and_left_by_another_meanwhile_loses_nothing(tmp_path, monkeypatch):
    path, there = tmp_path / "a.sgim", os.path.lexists

    def overtaken(asked):
        monkeypatch.setattr(os.path, "lexists", there)
        child = os.fork()
        if not child:
            journal = Journal.create(path, {}, TASK)
            journal.append(told(5))
            journal.commit()
            os.kill(os.getpid(), signal.SIGKILL)
        os.waitpid(child, 0)
        return False

    monkeypatch.setattr(os.path, "lexists", overtaken)
    with pytest.raises(JournalError, match="exists"):
        Journal.create(path, {}, TASK)
    with Journal.open(path, TASK, append=True) as journal:
        assert [event.plan for event in journal.events()] == [5]


def test_a_file_system_without_links_will_do(tmp_path, monkeypatch):
    def refused(*paths):
        raise PermissionError(1, "Operation not permitted")

    monkeypatch.setattr(os, "link", refused)
    with Journal.create(tmp_path / "a.sgim", {}, TASK) as journal:
        journal.append(told(5))
    assert [p.name for p in tmp_path.iterdir() if not p.name.endswith(".lock")] == ["a.sgim"]
    with pytest.raises(JournalError, match="exists"):
        Journal.create(tmp_path / "a.sgim", {}, TASK)


def test_a_forked_worker_does_not_keep_the_lock(tmp_path):
    path = tmp_path / "a.sgim"
    journal = Journal.create(path, {}, TASK)
    read, write = os.pipe()
    worker = os.fork()
    if worker == 0:
        os.read(read, 1)  # outlives the writer
        os._exit(0)
    try:
        journal.close()
        Journal.open(path, TASK, append=True).close()
    finally:
        os.write(write, b".")
        os.waitpid(worker, 0)
        os.close(read)
        os.close(write)
