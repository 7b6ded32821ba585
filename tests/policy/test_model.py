import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from hypothesis.extra.numpy import arrays
from tests.helpers import PLANE, plane, random_policies, remember

from sgim.memory import Memory
from sgim.policy.competence import InverseModel, NoAnswerError
from sgim.policy.model import NearestModel
from sgim.records import Goal, Trial
from sgim.spaces import Box, Choices
from sgim.task import Task

POINTS = arrays(np.float64, 2, elements=st.floats(-5, 15))
WINDY = Task(Box(0, 1), {"x": Box(0, 10)}, context_space=Box(0, 2))
TWO_KINDS = Task(Box(0, 1), {"x": Box(0, 10), "word": Choices(["ba", "da"])})


def place(*coordinates: float) -> Goal:
    return Goal("place", np.array(coordinates))


@given(st.lists(POINTS, min_size=1, max_size=30), POINTS)
def test_competence_is_minus_the_scaled_distance_to_the_nearest_outcome(
    outcomes: list[np.ndarray], goal: np.ndarray
) -> None:
    model = NearestModel(Memory(PLANE))
    for outcome in outcomes:
        model.update(Trial(np.zeros(2), {"place": outcome}))
    nearest = min(np.linalg.norm((outcome - goal) / 10) for outcome in outcomes)
    competence = model.competence(place(*goal), None)
    assert competence == pytest.approx(-min(1.0, nearest), abs=1e-12)


def test_competence_is_minus_one_for_a_kind_never_produced() -> None:
    model = NearestModel(Memory(TWO_KINDS))
    assert model.competence(Goal("x", np.array([5.0])), None) == -1.0
    model.update(Trial(np.array([0.5]), {"word": "ba"}))
    model.update(Trial(np.array([0.5]), {}))
    assert model.competence(Goal("x", np.array([5.0])), None) == -1.0
    assert model.competence(Goal("word", "ba"), None) == 0.0
    assert model.competence(Goal("word", "da"), None) == pytest.approx(-1.0)


def test_competence_follows_every_new_trial_for_the_same_goal() -> None:
    model, goal = NearestModel(Memory(PLANE)), place(5, 5)
    for gap in (4.0, 2.0, 3.0, 1.0, 0.0):
        model.update(Trial(np.zeros(2), {"place": np.array([5 + gap, 5.0])}))
        expected = -0.2 if gap == 3.0 else -gap / 10
        assert model.competence(goal, None) == pytest.approx(expected)


@given(POINTS, POINTS)
def test_a_trial_shows_what_it_alone_would_make_of_a_fresh_model(
    outcome: np.ndarray, goal: np.ndarray
) -> None:
    trial = Trial(np.zeros(2), {"place": outcome})
    model = NearestModel(Memory(PLANE))
    shown = model.shown_by(trial, place(*goal), None)
    model.update(trial)
    assert shown == pytest.approx(model.competence(place(*goal), None), abs=1e-12)


def test_a_trial_of_another_kind_shows_the_least_competence() -> None:
    trial = Trial(np.array([0.5]), {"word": "ba"})
    assert NearestModel(Memory(TWO_KINDS)).shown_by(trial, Goal("x", np.array([1.0])), None) == -1.0


def test_a_trial_in_another_context_shows_less() -> None:
    model = NearestModel(Memory(WINDY))
    trial = Trial(np.array([0.5]), {"x": np.array([4.0])}, np.array([1.0]))
    goal = Goal("x", np.array([4.0]))
    assert model.shown_by(trial, goal, np.array([1.0])) == 0.0
    assert model.shown_by(trial, goal, np.array([1.4])) == pytest.approx(-0.2)


@given(st.lists(POINTS, min_size=1, max_size=30), POINTS)
def test_the_best_policy_is_that_of_the_nearest_outcome_the_oldest_of_equals(
    outcomes: list[np.ndarray], goal: np.ndarray
) -> None:
    model = NearestModel(Memory(PLANE))
    for number, outcome in enumerate(outcomes):
        model.update(Trial(np.array([number / 100, 0]), {"place": outcome}))
    differences = [(outcome - goal) / 10 for outcome in outcomes]
    squares = [d[0] * d[0] + d[1] * d[1] for d in differences]
    chosen = round(model.best_policy(place(*goal), None)[0] * 100)
    assert squares[chosen] <= min(squares) + 1e-15
    assert not any((outcomes[i] == outcomes[chosen]).all() for i in range(chosen))


def test_the_best_policy_depends_on_the_context() -> None:
    model = NearestModel(Memory(WINDY))
    for policy, wind in ((0.1, 0.0), (0.2, 2.0)):
        model.update(Trial(np.array([policy]), {"x": np.array([4.0])}, np.array([wind])))
    goal = Goal("x", np.array([4.0]))
    assert model.best_policy(goal, np.array([0.3])).tolist() == [0.1]
    assert model.best_policy(goal, np.array([1.7])).tolist() == [0.2]


def test_without_an_outcome_of_the_kind_there_is_no_answer() -> None:
    model = NearestModel(Memory(TWO_KINDS))
    goal = Goal("x", np.array([5.0]))
    model.update(Trial(np.array([0.5]), {"word": "ba"}))
    assert isinstance(model, InverseModel)
    with pytest.raises(NoAnswerError, match="no trial has produced an outcome of kind 'x'"):
        model.best_policy(goal, None)
    with pytest.raises(NoAnswerError, match="kind 'x'"):
        model.solve(goal, None)
    assert model.best_policies([goal, goal], [None, None]) == [None, None]
    assert model.best_policies([], []) == []


def test_many_goals_at_once_get_the_policies_that_each_gets_alone() -> None:
    model = remember(PLANE, plane, random_policies(PLANE, 200))
    goals = [place(*point) for point in np.random.default_rng(1).uniform(-2, 12, (50, 2))]
    together = model.best_policies(goals, [None] * 50)
    alone = [model.best_policy(goal, None) for goal in goals]
    assert [b.tobytes() for b in together] == [b.tobytes() for b in alone]


def test_changing_an_answer_changes_no_memory() -> None:
    model = remember(PLANE, plane, [np.zeros(2)])
    model.best_policy(place(1, 4), None)[:] = 9.0
    assert model.best_policy(place(1, 4), None).tolist() == [0.0, 0.0]


def test_a_solution_says_what_its_policy_produced_and_how_far_that_is() -> None:
    policies = random_policies(PLANE, 50)
    model = remember(PLANE, plane, policies)
    goal = place(4, 5)
    solution = model.solve(goal, None)
    assert (solution.policy == model.best_policy(goal, None)).all()
    assert (solution.expected == plane(solution.policy)["place"]).all()
    assert solution.cost == -model.competence(goal, None)
    assert solution.cost == pytest.approx(np.linalg.norm(solution.expected - goal.point) / 10)


def test_the_spread_of_a_linear_world_without_noise_is_none() -> None:
    solution = remember(PLANE, plane, random_policies(PLANE, 50)).solve(place(4, 5), None)
    np.testing.assert_allclose(solution.spread, [0, 0], atol=1e-9)


def test_the_spread_is_the_noise_in_the_units_of_the_outcome() -> None:
    rng, spreads = np.random.default_rng(0), []
    noise = np.array([0.3, 0.05])
    for seed in range(40):

        def noisy(policy: np.ndarray) -> dict[str, np.ndarray]:
            return {"place": plane(policy)["place"] + noise * rng.standard_normal(2)}

        model = remember(PLANE, noisy, random_policies(PLANE, 60, seed))
        spreads.append(model.solve(place(4, 5), None).spread)
    np.testing.assert_allclose(np.sqrt(np.mean(np.square(spreads), axis=0)), noise, rtol=0.25)


def test_one_trial_alone_says_nothing_of_the_spread() -> None:
    solution = remember(PLANE, plane, [np.zeros(2)]).solve(place(1, 4), None)
    assert solution.spread.tolist() == [0.0, 0.0]
    assert solution.cost == 0.0


def test_a_goal_within_the_tolerance_seems_reachable_and_a_far_one_does_not() -> None:
    model = remember(PLANE, plane, random_policies(PLANE, 300))
    produced = plane(random_policies(PLANE, 300)[7])["place"]
    assert model.solve(Goal("place", produced), None).reachable
    assert model.solve(Goal("place", produced + 0.05), None).reachable
    assert not model.solve(place(10, 0), None).reachable


def test_where_outcomes_scatter_a_goal_within_two_spreads_seems_reachable() -> None:
    policies = random_policies(PLANE, 60)
    rng = np.random.default_rng(0)
    model = remember(
        PLANE, lambda b: {"place": plane(b)["place"] + rng.standard_normal(2)}, policies
    )
    answer = model.solve(place(6, 5), None)
    assert answer.spread.max() > 0.3
    beyond = answer.expected + 1.5 * answer.spread * [1, 0]
    assert model.solve(Goal("place", beyond), None).reachable


def test_labels_are_solved_for_too() -> None:
    model = remember(TWO_KINDS, lambda b: {"word": "ba" if b[0] < 0.5 else "da"}, [[0.2], [0.8]])
    solution = model.solve(Goal("word", "da"), None)
    assert solution.policy.tolist() == [0.8]
    assert (solution.expected, solution.cost, solution.reachable) == ("da", 0.0, True)
