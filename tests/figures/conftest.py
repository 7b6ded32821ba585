"""A few short runs to draw."""

from pathlib import Path

import pytest

from sgim.experiments import experiment


@pytest.fixture(scope="package")
def runs(tmp_path_factory: pytest.TempPathFactory) -> list[Path]:
    """Journals of three learners with three seeds each, seed by seed."""
    throwing = experiment("throwing")
    folder = tmp_path_factory.mktemp("figures")
    paths = []
    for learner in ("sgim-acts", "random", "mimicry:T2"):
        for seed in (0, 1, 2):
            path = throwing.journal_path(learner, seed, folder=folder)
            with throwing.start(learner, path, seed=seed, evaluate_every=50) as run:
                run.go(100)
            paths.append(path)
    return paths
