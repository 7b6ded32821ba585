import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from tests.helpers import (
    PLANE,
    episode_for,
    plane,
    proposals,
    random_policies,
    remember,
    tell,
)

from sgim.environments import PlanarArm
from sgim.memory import Memory
from sgim.policy.local_search import LocalSearch
from sgim.policy.model import NearestModel
from sgim.records import Goal, Trial
from sgim.spaces import Box, Choices
from sgim.task import Task

CENTRE = np.array([0.5, 0.5])
STRAIGHT = (1e-9, 2e-9)
"""A variation too small to matter: steps alone."""


def goal_at(policy: np.ndarray) -> Goal:
    return Goal("place", plane(policy)["place"])


@pytest.mark.parametrize("seed", range(5))
def test_in_a_linear_world_the_linear_step_lands_on_the_goal(seed: int) -> None:
    model = remember(PLANE, plane, random_policies(PLANE, 20, seed))
    goal = goal_at(np.array([0.4, 0.6]))
    before = -model.competence(goal, None)
    landed = [
        plane(policy)["place"] for policy in proposals(LocalSearch(model, variation=STRAIGHT), goal)
    ]
    gaps = [np.linalg.norm(place - goal.point) / 10 for place in landed]
    assert sorted(gaps)[4] < 0.01 * before  # More than half do: the others are random.


def test_joints_that_act_alike_share_the_step() -> None:
    task = Task(Box(0, 1, names=["a", "b", "c"]), {"sum": Box(0, 3)})

    def world(policy: np.ndarray) -> dict[str, np.ndarray]:
        return {"sum": policy.sum(keepdims=True)}

    start = np.array([0.5, 0.4, 0.6])
    model = remember(task, world, [start, *(start - 0.1 * np.eye(3))])
    search = LocalSearch(model, variation=STRAIGHT)
    drawn = proposals(search, Goal("sum", np.array([1.56])))
    assert any(np.allclose(policy - start, [0.02, 0.02, 0.02], atol=1e-3) for policy in drawn)


def test_local_steps_are_no_longer_than_the_neighbourhood_is_wide() -> None:
    around = CENTRE + 0.03 * np.array([[0, 0], [1, 0], [0, 1], [-1, 0]])
    model = remember(PLANE, plane, around)
    search = LocalSearch(model, variation=STRAIGHT, wide_share=0.0)
    goal = Goal("place", plane(CENTRE)["place"] + [0.0, 2.5])
    share = 1 + model.competence(goal, None)
    assert share == pytest.approx(0.75, abs=0.05)  # Of local steps; the others are random.
    drawn = np.array([p for seed in range(100) for p in proposals(search, goal, seed=seed)])
    gaps = np.linalg.norm(drawn[:, None] - around, axis=2).min(axis=1)
    assert np.mean(gaps <= 0.06 + 1e-9) > share - 0.05


def test_a_linear_step_makes_up_for_the_present_context() -> None:
    task = Task(Box(0, 1), {"x": Box(0, 2)}, context_space=Box(0, 1))
    model = NearestModel(Memory(task))
    for policy in np.linspace(0.1, 0.9, 9):
        for wind in (0.0, 0.3):
            trial = Trial(np.array([policy]), {"x": np.array([policy + wind])}, np.array([wind]))
            model.update(trial)
    # In a wind of 0.5, a policy of 0.3 produces 0.8.
    search = LocalSearch(model, variation=STRAIGHT)
    drawn = proposals(search, Goal("x", np.array([0.8])), np.array([0.5]))
    assert min(abs(policy[0] - 0.3) for policy in drawn) < 0.005


def test_the_map_is_fitted_to_near_policies_not_to_like_outcomes_of_unlike_ones() -> None:
    # Two ways to the same places, the second one mirrored: together they would mislead.
    task = Task(Box(0, 1, names=["a", "b"]), {"x": Box(0, 1)})

    def world(policy: np.ndarray) -> dict[str, np.ndarray]:
        a, b = policy
        return {"x": np.array([a if b < 0.5 else 1 - a])}

    ways = [np.array([a, b]) for a in np.linspace(0.3, 0.7, 9) for b in (0.1, 0.12, 0.9, 0.88)]
    model = remember(task, world, ways)
    for target in (0.33, 0.48, 0.62):
        search = LocalSearch(model, variation=STRAIGHT, within=6, least_global=0.0)
        goal = Goal("x", np.array([target]))
        landed = [world(policy)["x"][0] for policy in proposals(search, goal)]
        assert sorted(abs(x - target) for x in landed)[4] < 0.005


@pytest.mark.parametrize("size", [0.01, 0.5])
def test_variations_change_the_outcome_by_about_the_share_asked_of_what_is_lacking(
    size: float,
) -> None:
    cloud = CENTRE + 0.05 * np.random.default_rng(3).standard_normal((40, 2))
    model = remember(PLANE, plane, cloud)
    goal = goal_at(np.array([0.502, 0.65]))
    lacking = -model.competence(goal, None)
    searches = [LocalSearch(model, variation=v, least_global=0) for v in (STRAIGHT, (size, size))]
    steps, varied = (
        np.array([proposals(s, goal, count=1, seed=seed)[0] for seed in range(200)])
        for s in searches
    )
    local = np.linalg.norm(steps - np.median(steps, axis=0), axis=1) < 1e-6
    effects = [
        np.linalg.norm(plane(one)["place"] - plane(other)["place"]) / 10
        for one, other in zip(steps[local], varied[local], strict=True)
    ]
    assert 0.4 * size * lacking < np.median(effects) < 1.6 * size * lacking


@pytest.mark.parametrize("deterministic", [False, True])
def test_where_there_is_noise_variations_are_of_a_size_that_feeds_the_map(
    deterministic: bool,
) -> None:
    rng = np.random.default_rng(4)

    def bent(policy: np.ndarray) -> dict[str, np.ndarray]:
        a, b = policy
        place = np.array([np.sin(3 * a) + b, np.cos(3 * b) - a]) + 3
        return {"place": place + 0.02 * rng.standard_normal(2)}

    model = remember(PLANE, bent, random_policies(PLANE, 400))
    if deterministic:
        model.memory.declare_deterministic()
    known = model.smoothness(model.memory.kinds["place"])
    assert known is not None
    assert known.trusted
    goal = Goal("place", np.array([3.9, 3.2]))  # nothing is lacking, within noise
    fed, plain, still = (
        [
            proposals(LocalSearch(model, least_global=0, **options), goal, count=1, seed=seed)[0]
            for seed in range(200)
        ]
        for options in ({"feeds_map": True}, {}, {"variation": STRAIGHT})
    )
    sizes = np.linalg.norm(np.array(fed) - np.array(still), axis=1) / known.length
    if deterministic:
        assert np.array_equal(fed, plain)
    else:
        assert 0.1 < np.median(sizes) < 0.3
        assert np.median(np.linalg.norm(np.array(plain) - np.array(still), axis=1)) < 0.05


def test_sizes_of_variations_are_spread_over_all_orders() -> None:
    cloud = CENTRE + 0.05 * np.random.default_rng(3).standard_normal((40, 2))
    model = remember(PLANE, plane, cloud)
    goal = goal_at(np.array([0.502, 0.65]))
    searches = [LocalSearch(model, variation=v, least_global=0) for v in (STRAIGHT, (0.001, 1.0))]
    steps, varied = (
        np.array([proposals(s, goal, count=1, seed=seed)[0] for seed in range(300)])
        for s in searches
    )
    local = np.linalg.norm(steps - np.median(steps, axis=0), axis=1) < 1e-6
    sizes = np.log10(np.linalg.norm(varied - steps, axis=1)[local])
    low, middle, high = np.percentile(sizes, [10, 50, 90])
    assert middle - low == pytest.approx(high - middle, abs=0.4)
    assert high - low == pytest.approx(0.8 * 3, abs=0.5)


@given(st.integers(0, 10**6), st.lists(st.floats(-50, 60), min_size=2, max_size=2))
@settings(max_examples=30, deadline=None)
def test_what_is_proposed_lies_within_the_bounds(seed: int, place: list[float]) -> None:
    model = remember(PLANE, plane, random_policies(PLANE, seed % 7, seed))
    search = LocalSearch(model)
    episode = episode_for(model, Goal("place", np.array(place)), seed=seed)
    search.begin(episode)
    for _ in range(25):
        policy = PLANE.check_policy(search.propose([episode])[0])
        tell(model, search, episode, Trial(policy, plane(policy)))


def test_in_a_deterministic_world_episodes_come_closer_to_their_goals() -> None:
    arm = PlanarArm(7, noise=0)
    model = remember(arm.task, arm.execute, random_policies(arm.task, 20))
    search = LocalSearch(model)
    ratios = []
    for seed in range(20):
        reachable = arm.execute(random_policies(arm.task, 1, 100 + seed)[0])["hand"]
        goal = Goal("hand", reachable)
        episode = episode_for(model, goal, seed=seed)
        assert episode.before is not None
        assert episode.best is not None
        search.begin(episode)
        for _ in range(20):
            policy = search.propose([episode])[0]
            tell(model, search, episode, Trial(policy, arm.execute(policy)))
        assert episode.best == pytest.approx(model.competence(goal, None), abs=1e-12)
        ratios.append(episode.best / episode.before)
    assert np.median(ratios) < 0.2


def test_while_nothing_is_known_policies_are_random() -> None:
    search = LocalSearch(remember(PLANE, plane, []))
    episodes = [episode_for(search.model, goal_at(CENTRE), seed=seed) for seed in range(300)]
    for episode in episodes:
        search.begin(episode)
    drawn = np.array(search.propose(episodes))
    np.testing.assert_allclose(drawn.mean(axis=0), [0.5, 0.5], atol=0.06)
    np.testing.assert_allclose(drawn.std(axis=0), np.sqrt(1 / 12), atol=0.03)


@pytest.mark.parametrize(("least", "share"), [(0.02, 0.5), (0.8, 0.8)])
def test_the_share_of_random_policies_is_the_cost_or_the_least(least: float, share: float) -> None:
    # Remembered policies on a line: local steps stay on it.
    on_line = [np.array([0.5, 0.5]), np.array([0.5, 0.4]), np.array([0.5, 0.3])]
    model = remember(PLANE, plane, on_line)
    search = LocalSearch(model, least_global=least, wide_share=0.0, variation=STRAIGHT)
    goal = Goal("place", plane(on_line[0])["place"] - [0.0, 5.0])
    assert model.competence(goal, None) == pytest.approx(-0.5, abs=0.03)
    episodes = [episode_for(model, goal, seed=seed) for seed in range(500)]
    for episode in episodes:
        search.begin(episode)
    off_line = [abs(policy[0] - 0.5) > 1e-6 for policy in search.propose(episodes)]
    assert np.mean(off_line) == pytest.approx(share, abs=0.06)


def test_trials_of_other_kinds_and_refusals_teach_the_search_nothing() -> None:
    model = remember(PLANE, plane, random_policies(PLANE, 8))
    goal = goal_at(CENTRE)
    first, second = LocalSearch(model), LocalSearch(model)
    episodes = [episode_for(model, goal), episode_for(model, goal)]
    first.begin(episodes[0])
    second.begin(episodes[1])
    for _ in range(6):
        policy = first.propose(episodes[:1])[0]
        assert (policy == second.propose(episodes[1:])[0]).all()
        first.learn(episodes[0], Trial(policy, {}), -1.0)
        first.refuse(episodes[0])


@pytest.mark.parametrize(
    ("before", "best", "ended"),
    [
        (-0.3, -0.02, False),  # nearer, and not within the tolerance of 0.01
        (-0.3, -0.009, True),
        (-0.009, -0.009, False),  # within the tolerance all along: it must come much nearer
        (-0.009, -0.005, False),
        (-0.009, -0.004, True),
        (0.0, 0.0, True),
    ],
)
def test_a_search_ends_when_the_goal_is_reached_and_much_nearer_than_before(
    before: float, best: float, ended: bool
) -> None:
    model = remember(PLANE, plane, random_policies(PLANE, 8))
    search, episode = LocalSearch(model, reached_share=0.5), episode_for(model, goal_at(CENTRE))
    episode.before, episode.best = before, best
    assert search.finished(episode) is ended


def test_trials_of_the_episode_guide_its_next_steps() -> None:
    reached = []
    for seed in range(10):
        model = remember(PLANE, plane, [])
        search, episode = LocalSearch(model), episode_for(model, goal_at(CENTRE), seed=seed)
        search.begin(episode)
        for _ in range(20):
            (policy,) = search.propose([episode])
            tell(model, search, episode, Trial(policy, plane(policy)))
        reached.append(episode.best)
    assert np.median(reached) > -0.01


def test_an_episode_may_go_on_for_longer_than_its_usual_budget() -> None:
    model = remember(PLANE, plane, random_policies(PLANE, 30))
    search, episode = LocalSearch(model, budget=3), episode_for(model, goal_at(CENTRE))
    search.begin(episode)
    for _ in range(40):
        (policy,) = search.propose([episode])
        tell(model, search, episode, Trial(PLANE.check_policy(policy), plane(policy)))
    assert episode.best == pytest.approx(0.0, abs=1e-4)


def test_policies_must_be_vectors() -> None:
    task = Task(Choices(["look"]), PLANE.outcome_spaces)
    with pytest.raises(TypeError, match="local search needs a policy space that is a Box"):
        LocalSearch(remember(task, lambda _: {}, []))
