"""Sweeps from the command line."""

from pathlib import Path

from sgim.runs.summary import read_run

SWEEP = ["sweep", "throwing", "--learners", "random,mimicry:T2", "--movements", "60"]


def test_a_sweep_makes_a_journal_a_run_and_repeats_none(sgim, tmp_path) -> None:
    said = sgim(*SWEEP, "--seeds", "0-1", "--out", "out", "--jobs", "1")
    assert said.code == 0
    assert "4 of 4 runs are finished: out" in said.out
    names = {path.name for path in Path(tmp_path, "out").iterdir()}
    assert names == {
        f"throwing-{learner}-{seed}.sgim" for learner in ("random", "mimicry-T2") for seed in (0, 1)
    }
    again = sgim(*SWEEP, "--seeds", "0-2", "--out", "out", "--jobs", "1")
    assert "6 of 6 runs are finished, 4 of them before: out" in again.out


def test_a_run_that_fails_is_reported_and_does_not_stop_the_others(sgim, tmp_path) -> None:
    broken = tmp_path / "out" / "throwing-random-0.sgim"
    broken.parent.mkdir()
    broken.write_text("not a journal")
    said = sgim(*SWEEP, "--seeds", "0-1", "--out", "out", "--jobs", "2")
    assert said.code == 1
    assert "3 of 4 runs are finished" in said.out
    assert "throwing-random-0.sgim failed" in said.err
    assert "Traceback" in said.err
    assert "is not a journal" in said.err
    assert read_run(tmp_path / "out" / "throwing-mimicry-T2-1.sgim").finished


def test_a_file_is_swept_and_the_command_line_has_the_last_word(sgim, tmp_path) -> None:
    lines = ["experiments = 'throwing'", "learners = 'random'", "seeds = 0", "movements = 40"]
    Path(tmp_path, "mine.toml").write_text("\n".join([*lines, "out = 'here'", "jobs = 1"]))
    assert "1 of 1 runs are finished: here\n" in sgim("sweep", "mine.toml").out
    assert "1 of 1 runs are finished: there\n" in sgim("sweep", "mine.toml", "--out", "there").out
    for words, hint in (
        (["mine.toml", "--seeds", "1"], "--seeds: what to run is said by mine.toml"),
        (["throwing"], "say which --learners and --seeds"),
        (["mine.toml", "--scheduler", "tcp://a:1"], "--scheduler goes with --backend dask"),
    ):
        said = sgim("sweep", *words)
        assert said.code == 2
        assert hint in said.err
