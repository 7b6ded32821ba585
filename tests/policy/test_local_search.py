import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from tests.helpers import PLANE, episode_for, plane, random_policies, remember, tell

from sgim.environments import PlanarArm
from sgim.memory import Memory
from sgim.policy.local_search import LocalSearch
from sgim.policy.model import NearestModel
from sgim.records import Goal, Trial
from sgim.spaces import Box, Choices
from sgim.task import Task

CENTRE = np.array([0.5, 0.5])


def goal_at(policy: np.ndarray) -> Goal:
    return Goal("place", plane(policy)["place"])


def proposals(
    search: LocalSearch,
    goal: Goal,
    context: np.ndarray | None = None,
    count: int = 8,
    seed: int = 0,
) -> list[np.ndarray]:
    """What is proposed again and again while nothing is told: steps of every sort."""
    episode = episode_for(search.model, goal, context, seed)
    search.begin(episode)
    return [search.propose([episode])[0] for _ in range(count)]


@pytest.mark.parametrize("seed", range(5))
def test_in_a_linear_world_the_linear_step_lands_on_the_goal(seed: int) -> None:
    model = remember(PLANE, plane, random_policies(PLANE, 20, seed))
    goal = goal_at(np.array([0.4, 0.6]))
    before = -model.competence(goal, None)
    landed = [plane(policy)["place"] for policy in proposals(LocalSearch(model), goal)]
    gaps = [np.linalg.norm(place - goal.point) / 10 for place in landed]
    assert sorted(gaps)[1] < 0.05 * before  # More than one of the steps does.


def test_joints_that_act_alike_share_the_step() -> None:
    task = Task(Box(0, 1, names=["a", "b", "c"]), {"sum": Box(0, 3)})

    def world(policy: np.ndarray) -> dict[str, np.ndarray]:
        return {"sum": policy.sum(keepdims=True)}

    start = np.array([0.5, 0.4, 0.6])
    model = remember(task, world, [start, *(start - 0.1 * np.eye(3))])
    drawn = proposals(LocalSearch(model), Goal("sum", np.array([1.56])))
    assert any(np.allclose(policy - start, [0.02, 0.02, 0.02], atol=1e-3) for policy in drawn)


def test_local_steps_are_no_longer_than_the_neighbourhood_is_wide() -> None:
    around = CENTRE + 0.03 * np.array([[0, 0], [1, 0], [0, 1], [-1, 0]])
    model = remember(PLANE, plane, around)
    goal = Goal("place", plane(CENTRE)["place"] + [0.0, 2.5])
    share = 1 + model.competence(goal, None)
    assert share == pytest.approx(0.75, abs=0.05)  # Of local steps; the others are random.
    drawn = np.array(
        [p for seed in range(100) for p in proposals(LocalSearch(model), goal, seed=seed)]
    )
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
    drawn = proposals(LocalSearch(model), Goal("x", np.array([0.8])), np.array([0.5]))
    assert min(abs(policy[0] - 0.3) for policy in drawn) < 0.005


def test_differential_steps_add_a_share_of_the_difference_of_two_policies_to_the_best() -> None:
    remembered = [0.4 + 0.2 * policy for policy in random_policies(PLANE, 6)]  # Far from bounds.
    model, goal = remember(PLANE, plane, remembered), goal_at(remembered[2] + 0.001)
    differences = [one - other for one in remembered for other in remembered if one is not other]
    drawn = proposals(LocalSearch(model, least_global=0.0), goal, count=20)
    steps = [policy - remembered[2] for policy in drawn]
    differential = [s for s in steps if any(_is_share(s, d) for d in differences)]
    assert len(differential) >= 6
    assert any(step.any() for step in differential)


def _is_share(step: np.ndarray, difference: np.ndarray) -> bool:
    """Whether a step is the difference times a number from 0 to 0.7."""
    share = step @ difference / (difference @ difference)
    return bool(0 <= share <= 0.7 and np.allclose(step, share * difference, atol=1e-12))


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
    # Two remembered policies: local steps stay on the line through them.
    on_line = [np.array([0.5, 0.5]), np.array([0.5, 0.4])]
    model = remember(PLANE, plane, on_line)
    search = LocalSearch(model, least_global=least)
    goal = Goal("place", plane(on_line[0])["place"] - [0.0, 5.0])
    assert model.competence(goal, None) == pytest.approx(-0.5, abs=0.03)
    episodes = [episode_for(model, goal, seed=seed) for seed in range(500)]
    for episode in episodes:
        search.begin(episode)
    off_line = [policy[0] != 0.5 for policy in search.propose(episodes)]
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
