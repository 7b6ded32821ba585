import numpy as np
import pytest

from sgim import algorithms
from sgim.environments import PlanarArm
from sgim.errors import SgimError
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
    nothing = benchmark.evaluate(algorithms.make("random", ARM.task), Streams(0), 0)
    assert nothing == {"hand": 1.0, "hand relative": 1.0, "total": 1.0}
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


def test_a_movement_that_fails_costs_1_and_the_others_are_measured() -> None:
    class Fragile(PlanarArm):
        def execute_batch(self, policies, contexts=None, rngs=None):  # type: ignore[no-untyped-def]
            if any(policy[0] > 1 for policy in policies):
                raise SgimError("too far")
            return super().execute_batch(policies, contexts, rngs)

    arm = Fragile(2, noise=0.0, low=(-1.0, -1.0), limit=1.5)
    learner = algorithms.make("random", arm.task)
    for angle in (0.0, 1.4):
        posture = np.array([angle, 0.0])
        learner.observe(Trial(posture, {"hand": arm.hands([posture])[0]}))
    benchmark = Benchmark(GOALS, arm, "metric")
    distances = benchmark.distances(learner, "hand", Streams(0), 0)
    np.testing.assert_allclose(distances, [1.0, 0.5, 0.25, 0.0], atol=1e-12)
