from pathlib import Path

from sgim import algorithms
from sgim.environments import ThrowingArm
from sgim.environments.benchmark_goals import throwing_goals
from sgim.runs import Benchmark, Run, evaluate, open_repertoire


def test_a_repertoire_can_be_opened_as_it_was_and_measured_in_any_way(tmp_path: Path) -> None:
    path, world = tmp_path / "a.sgim", ThrowingArm()
    benchmark = Benchmark(throwing_goals()[::30], world)
    with Run(
        algorithms.make("sagg-riac", world.task),
        world,
        journal=path,
        benchmark=benchmark,
        evaluate_every=60,
    ) as run:
        measured = {e.movements: e.errors for e in run.go(180)}
    for movements, errors in measured.items():
        early = open_repertoire(path, movements=movements)
        assert len(early.model.memory) == movements  # type: ignore[attr-defined]
        assert evaluate(early, benchmark) == errors
    kernel = evaluate(open_repertoire(path), benchmark, by="kernel")
    assert kernel["throw"] != measured[180]["throw"]
