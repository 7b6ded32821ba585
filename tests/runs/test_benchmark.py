import numpy as np
import pytest

from sgim import algorithms
from sgim.environments import PlanarArm
from sgim.records import Goal, Trial
from sgim.runs import Benchmark
from sgim.streams import Streams

ARM = PlanarArm(2, noise=0.0, low=(-1.0, -1.0))
ORIGIN = np.array([1.0, 0.0])
GOALS = [Goal("hand", np.array(p)) for p in ([0.0, 1.0], [0.5, 0.0], [1.0, 0.25], [1.0, 0.0])]


def test_with_an_origin_errors_are_also_given_relative_to_the_way_from_it() -> None:
    learner = algorithms.make("random", ARM.task)
    learner.observe(Trial(np.zeros(2), {"hand": ORIGIN}))
    benchmark = Benchmark(GOALS, ARM, "metric", {"hand": ORIGIN})
    distances = benchmark.distances(learner, "hand", Streams(0), 0)
    np.testing.assert_allclose(distances, [np.sqrt(2), 0.5, 0.25, 0.0], atol=1e-12)
    # The hand stays at the origin: it is off by the whole way to each goal.
    np.testing.assert_allclose(benchmark.relative("hand", distances)[:3], 1.0)
    np.testing.assert_allclose(
        benchmark.relative("hand", np.array([2.0, 0.25, 0.05, 0.1])), [1.0, 0.5, 0.2, 1.0]
    )
    errors = benchmark.evaluate(learner, Streams(0), 0)
    assert list(errors) == ["hand", "hand relative", "total"]
    assert errors["total"] == errors["hand"] == pytest.approx(distances.mean())


def test_the_origin_is_scaled_as_the_goals_are() -> None:
    learner = algorithms.make("random", ARM.task)
    learner.observe(Trial(np.array([np.pi / 3, 0.0]), {"hand": ARM.hands([[np.pi / 3, 0.0]])[0]}))
    metric = Benchmark(GOALS[:1], ARM, "metric", {"hand": ORIGIN})
    scaled = Benchmark(GOALS[:1], ARM, "scaled", {"hand": ORIGIN})
    one, other = (b.evaluate(learner, Streams(0), 0) for b in (metric, scaled))
    assert one["hand"] == pytest.approx(2 * other["hand"])
    assert one["hand relative"] == pytest.approx(other["hand relative"])


def test_without_origins_nothing_is_added() -> None:
    learner = algorithms.make("random", ARM.task)
    assert Benchmark(GOALS, ARM).evaluate(learner, Streams(0), 0) == {"hand": 1.0, "total": 1.0}
