"""A run that is cut off anywhere and resumed ends as one that never was."""

from __future__ import annotations

import itertools
import os
import random
import shutil
import signal
import sqlite3
import subprocess
import sys
import time
from pathlib import Path

import numpy as np
import pytest

from sgim import algorithms
from sgim.environments.arm import PlanarArm
from sgim.environments.benchmark_goals import throwing_goals
from sgim.environments.throwing import ThrowingArm
from sgim.environments.throwing_teachers import throwing_teachers
from sgim.errors import JournalError, MismatchError
from sgim.policy.local_search import LocalSearch
from sgim.records import Demonstration
from sgim.runs import Benchmark, Run
from sgim.teachers import LeastExplored

Rows = list[tuple[object, ...]]


def throwing_run(
    path: Path,
    name: str = "sgim-acts",
    *,
    batch: int = 1,
    configuration: str = "modern",
    seed: int = 3,
    adopt: bool = False,
) -> Run:
    world = ThrowingArm()
    teachers = ["T1", "T2", "T3"] if name == "sgim-acts" else ["T1"]
    learner = algorithms.make(name, world.task, teachers, configuration=configuration, seed=seed)
    return Run(
        learner,
        world,
        throwing_teachers(),
        journal=path,
        benchmark=Benchmark(throwing_goals()[::20], world),
        evaluate_every=50,
        batch=batch,
        adopt=adopt,
    )


def rows(path: Path) -> Rows:
    """All events but those that only say which process wrote."""
    with sqlite3.connect(path) as db:
        found = db.execute("SELECT * FROM events WHERE event != 'session' ORDER BY seq").fetchall()
    return [row[1:] for row in found]


def cut(source: Path, target: Path, events: int) -> None:
    """A journal as it would be had the process died after so many events."""
    shutil.copy(source, target)
    with sqlite3.connect(target) as db:
        db.execute("DELETE FROM events WHERE seq > ?", (events,))
    db.close()


def whole_outcomes(path: Path) -> list[int]:
    """Where a group of rows ends that is written together."""
    with sqlite3.connect(path) as db:
        found = db.execute("SELECT seq, event FROM events ORDER BY seq").fetchall()
    return [a[0] for a, b in itertools.pairwise(found) if b[1] != "also"]


@pytest.mark.parametrize(("batch", "configuration"), [(1, "modern"), (1, "thesis"), (16, "modern")])
def test_a_run_cut_off_after_any_event_ends_as_one_that_never_was(
    tmp_path: Path, batch: int, configuration: str
) -> None:
    whole = tmp_path / "whole.sgim"
    with throwing_run(whole, batch=batch, configuration=configuration) as run:
        run.go(240)
    expected = rows(whole)
    places = whole_outcomes(whole)
    for place in random.Random(0).sample(places, 40) + places[:8]:
        part = tmp_path / f"{place}.sgim"
        cut(whole, part, place)
        with throwing_run(part, batch=batch, configuration=configuration) as run:
            run.go(240)
        assert rows(part) == expected, f"cut after event {place}"


@pytest.mark.parametrize("batch", [1, 16])
@pytest.mark.parametrize("configuration", ["modern", "thesis,demonstration_every=13"])
@pytest.mark.parametrize("name", sorted({*algorithms.ALGORITHMS} - {"sgim-acts"}))
def test_every_learner_goes_on_as_if_it_had_not_been_cut_off(
    tmp_path: Path, name: str, configuration: str, batch: int
) -> None:
    whole = tmp_path / "whole.sgim"
    with throwing_run(whole, name, batch=batch, configuration=configuration) as run:
        run.go(120)
    for place in random.Random(0).sample(whole_outcomes(whole), 6):
        part = tmp_path / f"{place}.sgim"
        cut(whole, part, place)
        with throwing_run(part, name, batch=batch, configuration=configuration) as run:
            run.go(120)
        assert rows(part) == rows(whole), f"cut after event {place}"


MIXTURES = "rest_trials=40,mixture_every=40,mixture_components=4,interest_every=30"


@pytest.mark.parametrize("batch", [1, 40])
@pytest.mark.parametrize("name", ["sagg-riac-gmm", "sgim-acts-gmm", "sagg-riac", "sgim-acts"])
def test_learners_with_mixtures_go_on_in_the_middle_of_a_batch_and_of_a_refit(
    tmp_path: Path, name: str, batch: int
) -> None:
    interest = "mixture" if batch == 1 else "alp-gmm"
    configuration = f"modern,{MIXTURES}"
    if not name.endswith("gmm"):
        configuration += f",interest={interest}"
    whole = tmp_path / "whole.sgim"
    with throwing_run(whole, name, batch=batch, configuration=configuration) as run:
        run.go(320)
    places = whole_outcomes(whole)
    for place in random.Random(0).sample(places, 8) + places[-1:]:
        part = tmp_path / f"{place}.sgim"
        cut(whole, part, place)
        with throwing_run(part, name, batch=batch, configuration=configuration) as run:
            run.go(320)
        assert rows(part) == rows(whole), f"cut after event {place}"


def test_a_noisy_world_with_contexts_resumes_exactly(tmp_path: Path) -> None:
    world = PlanarArm(3, vary_start=True)

    def go(path: Path) -> None:
        learner = algorithms.make("sagg-riac", world.task, seed=1)
        with Run(learner, world, journal=path, batch=4) as run:
            run.go(120)

    go(tmp_path / "whole.sgim")
    for place in (5, 60, 131, 200):
        part = tmp_path / f"{place}.sgim"
        cut(tmp_path / "whole.sgim", part, place)
        go(part)
        assert rows(part) == rows(tmp_path / "whole.sgim")


@pytest.mark.parametrize("batch", [1, 8])
def test_a_run_with_a_watching_teacher_resumes_exactly(tmp_path: Path, batch: int) -> None:
    arm = PlanarArm(3)
    postures = np.random.default_rng(0).uniform(-arm.limit, arm.limit, (40, 3))
    hands = arm.hands(postures)
    demonstrations = [
        Demonstration({"hand": hand}, policy=posture)
        for hand, posture in zip(hands, postures, strict=True)
    ]

    def go(path: Path) -> None:
        learner = algorithms.make("mimicry", arm.task, "watcher", seed=2)
        watcher = LeastExplored(demonstrations, arm.task, kind="hand", tile=0.2)
        with Run(learner, arm, {"watcher": watcher}, journal=path, batch=batch) as run:
            run.go(90)

    whole = tmp_path / "whole.sgim"
    go(whole)
    for place in whole_outcomes(whole)[::9]:
        part = tmp_path / f"{place}.sgim"
        cut(whole, part, place)
        go(part)
        assert rows(part) == rows(whole), f"cut after event {place}"


SCRIPT = """
import sys
from pathlib import Path
sys.path.insert(0, {tests!r})
from tests.runs.test_resume import throwing_run
with throwing_run(Path(sys.argv[1]), batch=int(sys.argv[2])) as run:
    run.go(6000)
"""


@pytest.mark.parametrize("batch", [1, 64])
def test_a_run_killed_again_and_again_ends_as_one_that_never_was(
    tmp_path: Path, batch: int
) -> None:
    root = str(Path(__file__).parents[2])
    command = [sys.executable, "-c", SCRIPT.format(tests=root)]
    with throwing_run(tmp_path / "whole.sgim", batch=batch) as run:
        run.go(6000)
    chance = random.Random(batch)
    part, kills = tmp_path / "part.sgim", 0
    for _ in range(200):
        process = subprocess.Popen([*command, str(part), str(batch)], cwd=root)
        # Whenever the journal has grown by a random amount, wherever that is in a batch.
        size = part.stat().st_size if part.exists() else 0
        more, wait = chance.randrange(1_000, 100_000), chance.random() * 0.2
        while process.poll() is None:
            wal = Path(f"{part}-wal")
            grown = sum(f.stat().st_size for f in (part, wal) if f.exists())
            if grown > size + more and kills < 3:
                time.sleep(wait)
                os.kill(process.pid, signal.SIGKILL)
                kills += 1
                break
            time.sleep(0.002)
        if process.wait() == 0:
            break
    assert kills >= 2
    assert rows(part) == rows(tmp_path / "whole.sgim")


def test_a_finished_run_can_be_extended(tmp_path: Path) -> None:
    with throwing_run(tmp_path / "a.sgim") as run:
        run.go(100)
    with throwing_run(tmp_path / "a.sgim") as run:
        run.go(200)
    with throwing_run(tmp_path / "b.sgim") as run:
        run.go(200)
    assert rows(tmp_path / "a.sgim") == rows(tmp_path / "b.sgim")


def test_a_journal_of_another_learner_is_refused(tmp_path: Path) -> None:
    with throwing_run(tmp_path / "a.sgim") as run:
        run.go(20)
    with pytest.raises(JournalError, match=r"another run: recipe.seed is 3 as recorded and 4 here"):
        throwing_run(tmp_path / "a.sgim", seed=4)


def longest(planned: list[tuple[int, int]]) -> int:
    """The episode with the most plans; only a search has so many."""
    episodes = [episode for episode, _ in planned]
    return max(set(episodes), key=episodes.count)


def open_cut(tmp_path: Path) -> tuple[Path, Rows]:
    """A run cut off in the middle of an episode of local search."""
    whole, part = tmp_path / "whole.sgim", tmp_path / "part.sgim"
    with throwing_run(whole) as run:
        run.go(200)
    with sqlite3.connect(whole) as db:
        planned = db.execute("SELECT episode, plan FROM events WHERE event = 'planned'").fetchall()
        tried = [plan for episode, plan in planned if episode == longest(planned)]
        (place,) = db.execute(
            "SELECT seq FROM events WHERE event = 'told' AND plan = ?", (tried[len(tried) // 2],)
        ).fetchone()
    cut(whole, part, place)
    return part, rows(part)


def test_decisions_that_come_out_differently_are_refused_with_the_first_difference(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    part, before = open_cut(tmp_path)
    changed_library(monkeypatch)
    with pytest.raises(MismatchError, match=r"(?s)plan \d+ comes out as .* here, but as .* there"):
        throwing_run(part)
    assert rows(part) == before


def test_adopting_keeps_every_trial_and_decides_anew(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    part, before = open_cut(tmp_path)
    changed_library(monkeypatch)
    with throwing_run(part, adopt=True) as run:
        assert run.difference is not None
        run.go(200)
        assert len(run.learner.model.memory) == 200  # type: ignore[attr-defined]
    after = rows(part)
    assert after[: len(before)] == before
    with throwing_run(part) as run:  # what was adopted folds without a question
        assert run.movements == 200
    assert rows(part) == after


def changed_library(monkeypatch: pytest.MonkeyPatch) -> None:
    propose = LocalSearch.propose

    def other(self: LocalSearch, episodes: list[object]) -> list[object]:
        return [policy * 0.999 for policy in propose(self, episodes)]  # type: ignore[arg-type]

    monkeypatch.setattr(LocalSearch, "propose", other)


def test_a_warm_start_knows_what_the_other_run_tried(tmp_path: Path) -> None:
    with throwing_run(tmp_path / "a.sgim") as run:
        run.go(100)
    with throwing_run(tmp_path / "b.sgim", seed=9) as run:
        assert run.warm_start(tmp_path / "a.sgim") == 100
        run.go(50)
    with throwing_run(tmp_path / "b.sgim", seed=9) as run:
        assert run.movements == 50
        assert len(run.learner.model.memory) == 150  # type: ignore[attr-defined]
