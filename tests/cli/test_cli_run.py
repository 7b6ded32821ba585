"""Running, going on and extending from the command line."""

from __future__ import annotations

import signal
import sqlite3
import subprocess
import sys
import time
from pathlib import Path
from typing import Any

import pytest

from sgim.environments.throwing import ThrowingArm
from sgim.errors import JournalError
from sgim.runs.summary import read_run


def rows(path: Path) -> list[tuple[object, ...]]:
    """All events but those that only say which process wrote."""
    with sqlite3.connect(path) as db:
        found = db.execute("SELECT * FROM events WHERE event != 'session' ORDER BY seq").fetchall()
    db.close()
    return [row[1:] for row in found]


@pytest.fixture
def interrupt_at(monkeypatch: pytest.MonkeyPatch) -> Any:
    """Presses Ctrl-C at the n-th movement."""

    def arrange(n: int) -> None:
        execute, count = ThrowingArm.execute, 0

        def executed(self: ThrowingArm, *arguments: Any) -> Any:
            nonlocal count
            count += 1
            if count == n:
                signal.raise_signal(signal.SIGINT)
            return execute(self, *arguments)

        monkeypatch.setattr(ThrowingArm, "execute", executed)

    return arrange


def test_a_run_says_its_errors_its_choices_and_what_to_do_next(sgim, tmp_path) -> None:
    said = sgim("run", "throwing", "--movements", "200")
    assert said.code == 0
    path = tmp_path / "runs" / "throwing-sgim-acts-0.sgim"
    assert read_run(path).movements == 200
    assert "errors (share of the outcome space)" in said.out
    assert [line.split()[0] for line in said.out.splitlines()[2:7]] == [
        "0",
        "50",
        "100",
        "150",
        "200",
    ]
    assert "mode autonomous" in said.out
    assert "goal place" in said.out
    assert "sgim plot runs/throwing-sgim-acts-0.sgim" in said.out
    assert "sgim answer runs/throwing-sgim-acts-0.sgim --goal throw=" in said.out


@pytest.mark.parametrize(
    ("words", "name"),
    [
        (["throwing", "--learner", "mimicry:T1"], "throwing-mimicry-T1-0"),
        (["throwing", "--learner", "mimicry", "--teacher", "T1"], "throwing-mimicry-T1-0"),
        (["throwing", "--learner", "random", "--seed", "7"], "throwing-random-7"),
        (["throwing", "--configuration", "thesis"], "throwing-sgim-acts-thesis-0"),
        (["arm"], "arm-sagg-riac-0"),
        (["throwing", "--teacher", "none"], "throwing-sagg-riac-0"),
        (["vocal", "--batch", "10"], "vocal-sagg-riac-gmm-0"),
        (["vocal", "--teacher", "3"], "vocal-sgim-acts-gmm-3-0"),
    ],
)
def test_a_journal_is_named_after_its_run(sgim, tmp_path, words: list[str], name: str) -> None:
    assert sgim("run", *words, "--movements", "20").code == 0
    assert (tmp_path / "runs" / f"{name}.sgim").exists()


def test_a_finished_run_is_left_as_it_is(sgim, tmp_path) -> None:
    sgim("run", "throwing", "--movements", "100")
    path = tmp_path / "runs" / "throwing-sgim-acts-0.sgim"
    before = path.read_bytes()
    again = sgim("run", "throwing", "--movements", "100")
    assert again.code == 0
    assert "is finished: 100 movements" in again.out
    assert "sgim resume runs/throwing-sgim-acts-0.sgim --movements 200" in again.out
    assert "is finished" in sgim("resume", path).out
    more = sgim("run", "throwing", "--movements", "150")
    assert more.code == 1
    assert "sgim resume runs/throwing-sgim-acts-0.sgim --movements 150" in more.err
    assert sgim("resume", path, "--movements", "90").code == 2
    assert path.read_bytes() == before


def test_a_journal_of_another_run_is_never_written_to(sgim, tmp_path) -> None:
    path = tmp_path / "a.sgim"
    sgim("run", "throwing", "--movements", "50", "--journal", path)
    before = path.read_bytes()
    for words, difference in [
        (["arm"], "its experiment is throwing, but here it is arm"),
        (["throwing", "--learner", "random"], "its learner is sgim-acts, but here it is random"),
        (["throwing", "--teacher", "T1"], "but here it is sgim-acts:T1"),
        (["throwing", "--seed", "1"], "its seed is 0, but here it is 1"),
        (["throwing", "--configuration", "thesis"], "its configuration is modern"),
        (["throwing", "--batch", "2"], "its batch is 1, but here it is 2"),
        (["throwing", "--warm-start", "b.sgim"], "its warm start is None"),
    ]:
        said = sgim("run", *words, "--movements", "50", "--journal", path)
        assert said.code == 1
        assert difference in said.err
    assert path.read_bytes() == before


def test_extending_a_run_is_the_same_as_a_longer_one(sgim, tmp_path) -> None:
    every = ["--evaluate-every", "50", "--batch", "4"]
    sgim("run", "throwing", "--movements", "100", "--journal", "a.sgim", *every)
    assert sgim("resume", "a.sgim", "--movements", "200").code == 0
    sgim("run", "throwing", "--movements", "200", "--journal", "b.sgim", *every)
    assert rows(tmp_path / "a.sgim") == rows(tmp_path / "b.sgim")


def test_a_run_that_was_stopped_goes_on_as_if_it_had_not_been(sgim, tmp_path, interrupt_at) -> None:
    interrupt_at(130)
    stopped = sgim("run", "throwing", "--movements", "200", "--journal", "a.sgim")
    assert stopped.code == 130
    assert "stopped at 130 of 200 movements" in stopped.err
    assert stopped.err.splitlines()[-1].split() == ["sgim", "resume", "a.sgim"]
    assert not read_run(tmp_path / "a.sgim").finished
    assert sgim("resume", "a.sgim").code == 0
    sgim("run", "throwing", "--movements", "200", "--journal", "b.sgim")
    assert rows(tmp_path / "a.sgim") == rows(tmp_path / "b.sgim")


def test_the_same_command_goes_on_with_what_was_stopped(sgim, interrupt_at) -> None:
    interrupt_at(130)
    sgim("run", "throwing", "--movements", "200")
    again = sgim("run", "throwing")
    assert again.code == 0
    assert "has this run already, with 130 movements: going on" in again.out
    assert "(200 movements" in again.out


def test_ctrl_c_in_a_terminal_stops_and_keeps_everything(sgim, tmp_path) -> None:
    path = tmp_path / "a.sgim"
    command = [sys.executable, "-m", "sgim.cli", "run", "throwing", "--movements", "1000000"]
    process = subprocess.Popen(
        [*command, "--journal", str(path)],
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        text=True,
    )
    for _ in range(600):
        time.sleep(0.1)
        try:
            if read_run(path).movements:
                break
        except JournalError:  # it has not been made yet
            continue
    process.send_signal(signal.SIGINT)
    _, err = process.communicate(timeout=60)
    assert process.returncode == 130
    made = read_run(path).movements
    assert f"stopped at {made} of 1000000 movements" in err
    assert f"sgim resume {path}" in err
    assert "Traceback" not in err
    target = str(made + 200)
    assert sgim("resume", path, "--movements", target).code == 0
    whole = tmp_path / "whole.sgim"
    words = ["--movements", target, "--evaluate-every", "1000", "--journal", whole]
    assert sgim("run", "throwing", *words).code == 0
    assert rows(path) == rows(whole)


def _last_event(path: Path) -> str:
    with sqlite3.connect(path) as db:
        (last,) = db.execute(
            "SELECT event FROM events WHERE event != 'session' ORDER BY seq DESC LIMIT 1"
        ).fetchone()
    db.close()
    return str(last)


def test_a_decision_that_comes_out_otherwise_is_adopted_only_when_told(
    sgim, tmp_path, interrupt_at
) -> None:
    interrupt_at(132)
    sgim("run", "throwing", "--movements", "200", "--journal", "a.sgim")
    for _ in range(20):
        if _last_event(tmp_path / "a.sgim") != "closed":
            break  # Only decisions of episodes that go on are made again.
        interrupt_at(1)
        sgim("resume", "a.sgim")
    assert _last_event(tmp_path / "a.sgim") != "closed"
    with sqlite3.connect(tmp_path / "a.sgim") as db:
        db.execute(
            "UPDATE events SET policy = zeroblob(112) WHERE seq = "
            "(SELECT max(seq) FROM events WHERE event = 'planned' AND policy IS NOT NULL)"
        )
    db.close()
    refused = sgim("resume", "a.sgim")
    assert refused.code == 1
    assert "cannot be resumed exactly: plan" in refused.err
    assert refused.err.splitlines()[-1].split() == ["sgim", "resume", "a.sgim", "--adopt"]
    adopted = sgim("resume", "a.sgim", "--adopt")
    assert adopted.code == 0
    assert "adopted the recorded decisions" in adopted.err
    assert "(200 movements" in adopted.out


@pytest.mark.filterwarnings("default")
def test_a_world_that_keeps_failing_ends_the_run_with_its_reason(
    sgim, monkeypatch: pytest.MonkeyPatch
) -> None:
    def broken(*arguments: Any) -> Any:
        raise OSError("motor 3 is off")

    monkeypatch.setattr(ThrowingArm, "execute", broken)
    said = sgim("run", "throwing", "--learner", "random", "--movements", "50")
    assert said.code == 1
    assert "sgim: warning: the world failed" in said.err
    assert "motor 3 is off" in said.err
    assert "sgim resume runs/throwing-random-0.sgim" in said.err
    assert "Traceback" not in said.err


def test_a_warm_start_begins_with_what_another_run_knows(sgim, finished, tmp_path) -> None:
    said = sgim(
        "run", "throwing", "--movements", "40", "--warm-start", finished, "--journal", "a.sgim"
    )
    assert said.code == 0
    warm, cold = read_run(tmp_path / "a.sgim"), read_run(finished)
    assert warm.evaluations[0].errors == cold.evaluations[-1].errors
    assert warm.movements == 40
    assert sgim("resume", "a.sgim", "--movements", "60").code == 0


def test_a_warm_start_from_nothing_leaves_nothing_behind(sgim, tmp_path) -> None:
    said = sgim("run", "throwing", "--warm-start", "no.sgim", "--movements", "10")
    assert said.code == 1
    assert "there is no journal no.sgim" in said.err
    assert not list(tmp_path.rglob("*.sgim"))


def test_every_is_short_for_a_setting_of_the_configuration(sgim, tmp_path) -> None:
    words = ("run", "hockey", "--learner", "sgim-d", "--movements", "40")
    assert sgim(*words, "--every", "20").code == 0
    (path,) = (tmp_path / "runs").iterdir()
    assert path.name == "hockey-sgim-d-modern,demonstration_every=20-0.sgim"
    with sqlite3.connect(path) as db:
        (asked,) = db.execute("SELECT count(*) FROM events WHERE event = 'answered'").fetchone()
    db.close()
    assert asked == 2
    said = sgim(*words, "--configuration", "modern,demonstration_every=20")
    assert "is finished: 40 movements" in said.out
