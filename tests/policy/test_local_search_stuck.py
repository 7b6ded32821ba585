"""What the local search does where its maps end: wide variations, and those of a rare kind."""

import numpy as np
import pytest
from tests.helpers import PLANE, episode_for, plane, proposals, random_policies, remember

from sgim.policy.local_search import LocalSearch
from sgim.records import Goal
from sgim.spaces import Box
from sgim.task import Task

CENTRE = np.array([0.5, 0.5])
STRAIGHT = (1e-9, 2e-9)
"""A variation too small to matter: steps alone."""


def goal_at(policy: np.ndarray) -> Goal:
    return Goal("place", plane(policy)["place"])


@pytest.mark.parametrize(
    ("share", "lacking", "expected"), [(0.0, 0.02, 0.0), (0.4, 0.02, 0.4), (0.4, 1e-4, 0.0)]
)
def test_the_best_policy_is_varied_widely_where_something_is_lacking(
    share: float, lacking: float, expected: float
) -> None:
    on_line = [np.array([0.5, 0.5]), np.array([0.5, 0.4]), np.array([0.5, 0.3])]
    search = LocalSearch(
        remember(PLANE, plane, on_line), least_global=0.0, wide_share=share, variation=STRAIGHT
    )
    goal = goal_at(on_line[0] + [lacking, 0.0])  # beside the line, where no step leads
    drawn = np.array([p for seed in range(100) for p in proposals(search, goal, seed=seed)])
    wide = drawn[np.abs(drawn[:, 0] - 0.5) > 1e-6]
    assert len(wide) / len(drawn) == pytest.approx(expected, abs=0.06 if expected else 0.025)
    if share and lacking == 0.02:  # among them a few random policies
        assert np.median(wide, axis=0) == pytest.approx(on_line[0], abs=0.02)
        assert wide.std(axis=0) == pytest.approx(0.1, abs=0.02)


@pytest.mark.parametrize(("others", "varied"), [(5, False), (60, True)])
@pytest.mark.parametrize("count", [1, 2])
def test_what_is_known_of_a_rare_kind_is_varied(others: int, varied: bool, count: int) -> None:
    task = Task(Box(0, 1, names=["a", "b"]), {"x": Box(0, 1), "rare": Box(0, 1)})
    known = [CENTRE, CENTRE + 0.25][:count]

    def world(policy: np.ndarray) -> dict[str, np.ndarray]:
        return {"rare" if any((policy == one).all() for one in known) else "x": policy[:1]}

    model = remember(task, world, [*known, *random_policies(task, others)])
    search = LocalSearch(model, least_global=0.0)
    goal = Goal("rare", np.array([0.9]))
    drawn = np.array([p for seed in range(50) for p in proposals(search, goal, seed=seed)])
    around, everywhere = 0.05, 12**-0.5
    assert drawn.std(axis=0) == pytest.approx(around if varied else everywhere, rel=0.1)
    if varied:  # the better one
        assert drawn.mean(axis=0) == pytest.approx(known[-1], abs=0.02)


def test_nothing_is_varied_widely_where_variations_feed_a_map() -> None:
    rng = np.random.default_rng(0)

    def noisy(policy: np.ndarray) -> dict[str, np.ndarray]:
        return {"place": plane(policy)["place"] + rng.normal(0, 0.1, 2)}

    model = remember(PLANE, noisy, random_policies(PLANE, 300))
    assert model.map_of_noisy(model.memory.kinds["place"]) is not None
    drawn = []
    for share in (0.0, 0.9):
        search = LocalSearch(model, least_global=0.0, wide_share=share, feeds_map=True)
        goals = [goal_at(policy) for policy in random_policies(PLANE, 40, 1)]
        drawn.append([[p.tolist() for p in proposals(search, goal)] for goal in goals])
    best = [model.nearest(goal, None)[0][0] for goal in goals]
    assert max(best) < 0.1  # no random policies, but for a few
    sizes = [np.std(np.array(some), axis=1).mean() for some in drawn]
    assert sizes[1] == pytest.approx(sizes[0], rel=0.1)


def test_batches_with_a_rare_kind_are_decided_as_one_by_one() -> None:
    task = Task(Box(0, 1, names=["a", "b"]), {"x": Box(0, 1), "rare": Box(0, 1)})

    def world(policy: np.ndarray) -> dict[str, np.ndarray]:
        return {"rare" if (policy == CENTRE).all() else "x": policy[:1]}

    model = remember(task, world, [CENTRE, *random_policies(task, 60)])
    some = [Goal(kind, np.array([place])) for place in (0.1, 0.5, 0.9) for kind in ("x", "rare")]
    together = [episode_for(model, goal, seed=i) for i, goal in enumerate(some * 10)]
    apart = [episode_for(model, goal, seed=i) for i, goal in enumerate(some * 10)]
    search = LocalSearch(model)
    search.begin_all(together)
    for episode in apart:
        search.begin(episode)
    for _ in range(3):
        expected = [search.propose([episode])[0].tolist() for episode in apart]
        assert [policy.tolist() for policy in search.propose(together)] == expected


@pytest.mark.parametrize(("noise", "share"), [(0.03, 0.0), (0.2, 0.05)])
def test_where_noise_may_be_jumps_the_best_policy_is_tried_again(
    noise: float, share: float
) -> None:
    task = Task(Box(-1, 1, names=list("abcd")), {"x": Box(-2, 2, names=["u", "v"])})
    rng = np.random.default_rng(5)

    def noisy(p: np.ndarray) -> dict[str, np.ndarray]:
        smooth = np.array([p[0] + p[1] * p[2], p[3] - p[0] * p[1]])
        return {"x": smooth + rng.normal(0, noise, 2)}

    model = remember(task, noisy, random_policies(task, 300))
    memory = model.memory.kinds["x"]
    known = model.map_of_noisy(memory)
    assert known is not None
    assert known.may_jump == (share > 0)
    search = LocalSearch(model, least_global=0.0, feeds_map=True)
    again = []
    for goal in [Goal("x", noisy(policy)["x"]) for policy in random_policies(task, 100, 1)]:
        _, rows = model.neighbours([goal], [None])
        best = memory.encoded_policies(rows[0, :1])[0]
        drawn = np.array([task.policy_space.encode(p) for p in proposals(search, goal, count=20)])
        again.append(np.abs(drawn - best).max(axis=1) < 1e-12)
    assert np.mean(again) == pytest.approx(share, abs=0.02)
