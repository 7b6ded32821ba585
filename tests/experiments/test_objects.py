"""The experiment as it comes with the library: its pictures, its runs, and what they record."""

from pathlib import Path

import numpy as np
import pytest

from sgim.environments.objects import ToyTable, kept_pictures
from sgim.environments.objects.pictures import evaluation_pictures
from sgim.errors import SgimError
from sgim.experiments import experiment
from sgim.experiments.recognition_benchmark import RecognitionBenchmark
from sgim.recognition import FEATURES, Eye, Features
from sgim.runs import Journal
from sgim.runs.measured import read_measured
from sgim.runs.summary import read_run
from sgim.streams import Streams

OBJECTS = experiment("objects")


def test_there_are_64_pictures_of_each_toy_and_they_are_made_as_is_said() -> None:
    kept, table = kept_pictures(), ToyTable()
    assert {toy: len(several) for toy, several in kept.items()} == dict.fromkeys(
        table.toys.labels, 64
    )
    for toy, several in kept.items():
        (picture,) = evaluation_pictures(table, toy, 1)
        assert several[0].digest.tobytes() == picture.digest()
        assert (
            np.abs(several[0].colours.mean(axis=0) - Eye().look(picture).colours.mean(axis=0)).max()
            < 1
        )


def test_random_lands_where_there_is_something_left_to_learn(tmp_path: Path) -> None:
    path = tmp_path / "random.sgim"
    with OBJECTS.start("random:unbiased", path, evaluate_every=105) as run:
        run.go(105)
        errors = run.evaluations[-1].errors
    assert 45 <= 64 * (1 - errors["total"]) <= 58
    toys = list(kept_pictures())
    assert errors["total"] == pytest.approx(np.mean([errors[toy] for toy in toys]))
    taken = sum(errors[f"taken for {toy}"] for toy in toys)
    assert taken <= sum(errors[toy] for toy in toys) + 1e-9
    with Journal.open(path, append=False) as journal:
        (views,) = zip(*journal.columns("told", "point"), strict=True)
    assert path.stat().st_size < 3_000_000  # a picture would take 540 kB
    assert max(map(len, views)) < 16_000
    again = Features.of(FEATURES.unpack(views[0]))
    assert len(again.digest.tobytes()) == 16


def test_runs_are_the_same_again_and_go_on_exactly(tmp_path: Path) -> None:
    for parts, name in (((12,), "whole"), ((5, 7, 12), "parts")):
        for target in parts:
            with OBJECTS.start(
                "sgim-acts:biased", tmp_path / name, seed=1, evaluate_every=1
            ) as run:
                run.go(target)
    whole, again = (read_measured(tmp_path / name) for name in ("whole", "parts"))
    assert len(whole.evaluations) == 13
    assert [e.errors for e in whole.evaluations] == [e.errors for e in again.evaluations]
    labels = read_run(tmp_path / "whole").openings.labels
    assert labels[:5] == list(kept_pictures())


def test_the_caregiver_is_unbiased_unless_another_is_named() -> None:
    for name, asked in (("random", "unbiased"), ("random:biased", "biased")):
        learner = OBJECTS.learner(name)
        assert learner.teachers == (asked,)
        assert OBJECTS.label(learner) == f"random:{asked}"
    assert OBJECTS.learner("sgim-acts:none").teachers == ()
    assert OBJECTS.learner_name() == "sgim-acts:unbiased"


def test_a_benchmark_says_what_it_measures_by() -> None:
    pictures = {toy: several[:2] for toy, several in kept_pictures().items()}
    described = RecognitionBenchmark(pictures).describe()
    assert described["pictures"] == dict.fromkeys(pictures, 2)
    fewer = {toy: several[:1] for toy, several in pictures.items()}
    assert RecognitionBenchmark(fewer).describe()["digest"] != described["digest"]
    with pytest.raises(SgimError, match="as many pictures of each label"):
        RecognitionBenchmark({**pictures, "dog": []})


def test_only_learners_that_recognise_are_measured_by_pictures() -> None:
    throwing = experiment("throwing").learner("random")
    benchmark = RecognitionBenchmark(kept_pictures())
    with pytest.raises(SgimError, match="NearestModel recognises no pictures"):
        benchmark.evaluate(throwing, Streams(0), 0)
    untaught = benchmark.evaluate(OBJECTS.learner("random"), Streams(0), 0)
    assert untaught["total"] == 1.0
    assert untaught["taken for dog"] == 0.0
