import math
from dataclasses import replace

import numpy as np
import pytest

from sgim.environments.fishing.floor import DURATION
from sgim.environments.fishing.movement import FISHING
from sgim.errors import SgimError
from sgim.experiments import experiment
from sgim.experiments.even_spread import by_tile, mean_miss
from sgim.experiments.make_fishing_goals import tiled
from sgim.experiments.make_fishing_kinaesthetic import (
    floor_search,
    most_repeatable,
    rod_search,
    search,
)
from sgim.experiments.make_fishing_learned import choose
from sgim.experiments.make_fishing_pool import Pool, explore, read_pool, write_pool


def test_explored_movements_are_those_that_landed() -> None:
    policies, landings = explore("random", 1, 15)
    assert 5 <= len(policies) == len(landings) <= 15
    assert landings.shape[1] == 2


def test_a_pool_is_read_as_it_was_written(tmp_path) -> None:  # type: ignore[no-untyped-def]
    rng = np.random.default_rng(0)
    pool = Pool(rng.random((6, 25)), rng.random((6, 2)), np.array([0, 0, 1, 1, 1, 0]))
    write_pool(tmp_path / "pool.npz", pool)
    again = read_pool(tmp_path / "pool.npz")
    np.testing.assert_array_equal(again.policies, pool.policies)
    np.testing.assert_array_equal(again.of("sagg-riac").landings, pool.landings[2:5])


def test_goals_are_tiles_that_were_reached_three_times() -> None:
    rng = np.random.default_rng(0)
    radius, angle = np.sqrt(rng.random(30_000)), rng.uniform(0, 2 * np.pi, 30_000)
    goals, along = tiled(np.stack([radius * np.cos(angle), radius * np.sin(angle)], axis=1))
    assert abs(len(goals) - 358) < 25
    tiles = np.floor((goals + 1) / 2 * along)
    assert len(np.unique(tiles, axis=0)) == len(goals)
    assert len(tiled(np.array([[0.1, 0.1], [0.1, 0.1], [0.9, 0.9]]))[0]) == 0


def test_landings_are_grouped_by_the_coarsest_tiles_that_are_enough() -> None:
    landings = np.array([[-0.9, -0.9], [-0.1, -0.1], [0.5, 0.5], [0.6, 0.6], [1.5, 0.0]])
    assert by_tile(landings, 2) == [[0, 1], [2, 3]]
    assert by_tile(landings, 3) == [[0], [1], [2, 3]]
    with pytest.raises(SgimError, match="fewer than 5 tiles"):
        by_tile(landings, 5)


def test_a_movement_that_fails_or_does_not_land_misses_by_one_metre() -> None:
    def broken() -> dict[str, np.ndarray]:  # type: ignore[type-arg]
        raise SgimError("unstable")

    executions = [broken, dict, lambda: {"float": np.array([0.0, 0.4])}]
    assert mean_miss(executions, np.zeros(2)) == pytest.approx(0.8)


def test_a_mean_miss_that_is_too_great_is_not_measured_to_the_end() -> None:
    made: list[int] = []

    def execute() -> dict[str, np.ndarray]:  # type: ignore[type-arg]
        made.append(1)
        return {"float": np.array([0.0, 0.5])}

    assert mean_miss([execute] * 4, np.zeros(2), least=0.2) == math.inf
    assert len(made) == 2
    assert mean_miss([execute] * 4, np.zeros(2), least=0.6) == pytest.approx(0.5)


def test_the_search_finds_movements_where_few_land() -> None:
    found = search(rod_search(), np.random.default_rng(3), 150)
    assert len(found) > 10
    assert all(np.abs(candidate.landing).max() < 1 for candidate in found)
    for candidate in found:
        assert np.abs(candidate.end).max() <= 1
        assert 0.4 <= candidate.duration <= 3
        assert candidate.recording.times[-1] == max(candidate.duration, 0.8)
        fitted, _ = FISHING.fit(candidate.recording)
        np.testing.assert_array_equal(candidate.copy, fitted)


def test_of_those_in_a_tile_the_one_is_chosen_whose_copy_replays_best() -> None:
    found = search(rod_search(), np.random.default_rng(3), 40)
    good, bad = found[0], replace(found[0], copy=np.full(25, 0.5))
    sought = replace(rod_search(), count=1, replays=(2, 0))
    for pair in ([good, bad], [bad, good]):
        [(missed, chosen)] = most_repeatable(sought, pair, np.random.default_rng(0))
        assert chosen is good
        assert missed < 0.2


def test_the_search_of_the_floor_finds_balls_that_rest_in_view() -> None:
    found = search(floor_search(), np.random.default_rng(0), 30)
    assert found
    assert all((candidate.landing >= 0).all() for candidate in found)
    assert all((candidate.landing <= 1).all() for candidate in found)
    assert all(candidate.duration == DURATION for candidate in found)


def test_the_learned_demonstrations_are_one_a_tile() -> None:
    policies, landings = explore("random", 2, 60)
    pool = Pool(policies, landings, np.zeros(len(policies), dtype=np.int64))
    chosen = choose(pool, np.random.default_rng(0), count=4, several=2)
    assert len(set(chosen)) == 4


@pytest.mark.parametrize("name", ["fishing", "fishing-still", "fishing-wide"])
def test_a_run_of_the_experiment_measures_both_errors(name: str) -> None:
    declared = experiment(name)
    assert declared.movements == 5000
    with declared.run(declared.learner("mimicry:D1", seed=1), evaluate_every=20) as run:
        [before, after] = run.go(20)
    assert list(after.errors) == ["float", "float relative", "total"]
    assert before.errors["total"] == 1.0
    assert after.errors["total"] == after.errors["float"] < 1.0
    assert 0 < after.errors["float relative"] <= 1.0


@pytest.mark.parametrize("name", ["fishing-full", "fishing-noisy", "fishing-floor"])
def test_every_variant_is_an_experiment_whose_movements_can_be_made(name: str) -> None:
    declared = experiment(name)
    world = declared.environment()
    learner = declared.learner("random", seed=1)
    assert declared.benchmark(world).goals
    with declared.run(learner, evaluate_every=1000) as run:
        run.benchmark = None
        run.go(3)
    assert run.movements == 3
