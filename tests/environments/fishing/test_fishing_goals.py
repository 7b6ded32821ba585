import numpy as np

from sgim.environments import FishingRod, fishing_goals
from sgim.environments.fishing.goals import floor_goals, noise_floor
from sgim.spaces import FloatArray


def goals() -> FloatArray:
    return np.array([goal.point for goal in fishing_goals()])


def test_about_358_goals_lie_in_different_tiles_of_the_box() -> None:
    points = goals()
    assert abs(len(points) - 358) <= 20
    assert (np.abs(points) < 1).all()
    apart = np.linalg.norm(points[:, None] - points, axis=2)
    np.fill_diagonal(apart, np.inf)
    assert apart.min() > 0.005
    assert np.median(apart.min(axis=1)) > 0.05


def test_goals_lie_on_all_sides_of_the_base() -> None:
    points = goals()
    for x in (-1, 1):
        for y in (-1, 1):
            assert ((points * [x, y]) > 0.1).all(axis=1).sum() > 30


def test_goals_of_the_floor_fill_the_view_evenly() -> None:
    points = np.array([goal.point for goal in floor_goals()])
    assert points.shape == (100, 2)
    np.testing.assert_allclose(points.mean(axis=0), 0.5)
    np.testing.assert_allclose(np.unique(points[:, 0]), np.arange(0.05, 1, 0.1))


def test_without_noise_the_floor_is_the_distance_to_the_nearest_landing() -> None:
    still = FishingRod(0.0)
    policies = np.random.default_rng(0).random((12, 25))
    outcomes = still.execute_batch(policies)
    landed = [i for i, outcome in enumerate(outcomes) if outcome]
    landings = np.array([outcomes[i]["float"] for i in landed])
    wanted = np.array([[0.2, 0.5], [-0.3, 0.3]])
    rng = np.random.default_rng(0)
    errors = noise_floor(still, wanted, policies[landed], landings, rng, repetitions=1)
    nearest = np.linalg.norm(landings - wanted[:, None], axis=2).min(axis=1)
    np.testing.assert_allclose(errors, nearest)


def test_a_lucky_memory_is_found_out_when_its_neighbours_are_compared() -> None:
    still = FishingRod(0.0)
    policies = np.random.default_rng(0).random((12, 25))
    honest = next(p for p in policies if still.execute(p))
    landing = still.execute(honest)["float"]
    lucky = next(p for p in policies if not still.execute(p))
    remembered = np.array([landing + np.array([0.01, 0.0]), landing])
    memory = (np.array([honest, lucky]), remembered, np.random.default_rng(0))
    [one] = noise_floor(still, landing[None], *memory, neighbours=1, repetitions=1)
    [two] = noise_floor(still, landing[None], *memory, neighbours=2, repetitions=1)
    assert one == 1.0
    assert two == 0.0
