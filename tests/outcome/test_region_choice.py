"""How a region tree chooses goals and modes: eq. 4.4, the three rules, and contexts."""

from collections import Counter
from typing import Any

import numpy as np
import pytest
from tests.helpers import PlainProgress, report

from sgim.outcome.region_tree import RegionTree
from sgim.records import Goal
from sgim.spaces import Box
from sgim.streams import Streams

SPACES = {"place": Box(0, 10), "throw": Box([-1, 0], [1, 2])}
MODES = {"alone": 1.0, "ask": 2.0}
UNIFORM, INTERESTING, WORST_POINT = (1, 0, 0), (0, 1, 0), (0, 0, 1)
COUNT = 4000


def tree_with(rules: tuple[float, ...], **options: Any) -> RegionTree:
    options = {"spaces": SPACES, "modes": MODES, "capacity": 3, **options}
    spaces, modes = options.pop("spaces"), options.pop("modes")
    return RegionTree(spaces, modes, PlainProgress(), Streams(0), probabilities=rules, **options)


def chosen(
    tree: RegionTree, modes: list[str] | None = None, context: Any = None, count: int = COUNT
) -> list[tuple[Goal, str]]:
    rng = np.random.default_rng(0)
    return [tree.choose(rng, modes or list(MODES), context) for _ in range(count)]


def set_interest(tree: RegionTree, kind: str, mode: str, value: float) -> None:
    middle = SPACES[kind].decode(np.full(SPACES[kind].dimension, 0.5))
    tree.update(report(middle, mode, kind=kind, before=-1.0, after=-1.0 + value * MODES[mode]))


def shares(tree: RegionTree, modes: list[str] | None = None) -> dict[tuple[str, str], float]:
    counted = Counter((goal.kind, mode) for goal, mode in chosen(tree, modes))
    return {pair: number / COUNT for pair, number in counted.items()}


def test_pairs_are_chosen_in_proportion_to_their_interest_above_the_least() -> None:
    tree = tree_with(INTERESTING)
    set_interest(tree, "place", "alone", 0.1)
    set_interest(tree, "place", "ask", 0.2)
    set_interest(tree, "throw", "alone", 0.4)
    set_interest(tree, "throw", "ask", 0.3)
    # Above the least, 0.1: nothing, 0.1, 0.3 and 0.2; together 0.6.
    expected = {("place", "ask"): 1 / 6, ("throw", "alone"): 1 / 2, ("throw", "ask"): 1 / 3}
    assert shares(tree) == pytest.approx(expected, abs=0.03)


def test_the_least_is_that_of_the_modes_offered() -> None:
    tree = tree_with(INTERESTING)
    set_interest(tree, "place", "alone", 0.1)
    set_interest(tree, "place", "ask", 0.0)
    set_interest(tree, "throw", "alone", 0.4)
    set_interest(tree, "throw", "ask", 0.0)
    assert shares(tree, ["alone"]) == {("throw", "alone"): 1.0}


def test_negative_interests_are_counted_from_the_least_as_well() -> None:
    tree = tree_with(INTERESTING, modes={"alone": 1.0})
    set_interest(tree, "place", "alone", -0.4)
    assert shares(tree, ["alone"]) == {("throw", "alone"): 1.0}


def test_equal_interests_are_chosen_uniformly() -> None:
    tree = tree_with(INTERESTING)
    for kind in SPACES:
        for mode in MODES:
            set_interest(tree, kind, mode, 0.25)
    pairs = [(kind, mode) for kind in SPACES for mode in MODES]
    assert shares(tree) == pytest.approx(dict.fromkeys(pairs, 0.25), abs=0.03)


def test_the_uniform_rule_draws_kinds_goals_and_modes_alike() -> None:
    tree = tree_with(UNIFORM)
    set_interest(tree, "throw", "alone", 0.9)
    pairs = [(kind, mode) for kind in SPACES for mode in MODES]
    assert shares(tree) == pytest.approx(dict.fromkeys(pairs, 0.25), abs=0.03)
    places = [goal.point[0] for goal, _ in chosen(tree) if goal.kind == "place"]
    assert np.quantile(places, [0.25, 0.5, 0.75]) == pytest.approx([2.5, 5, 7.5], abs=0.4)


def test_the_interesting_rule_draws_goals_anywhere_in_the_region() -> None:
    tree = tree_with(INTERESTING, spaces={"place": Box(0, 10)}, modes={"alone": 1.0})
    for x, after in ((1, -1.0), (2, -1.0), (8, 0.0), (9, 0.0)):
        tree.update(report([x], "alone", before=-1.0, after=after))
    region = tree.region_of("place", np.array([0.85]))
    low, high = 10 * region.low[0], 10 * region.high[0]
    drawn = [goal.point[0] for goal, _ in chosen(tree, ["alone"])]
    assert low <= min(drawn) < low + 0.05
    assert high - 0.05 < max(drawn) <= high
    assert np.mean(drawn) == pytest.approx((low + high) / 2, abs=0.1)


def test_the_worst_point_rule_draws_goals_near_the_least_competent_one() -> None:
    tree = tree_with(WORST_POINT, spaces={"place": Box(0, 10)}, modes={"alone": 1.0})
    for x, after in ((2.0, -0.3), (6.0, -0.8), (9.0, -0.1)):
        tree.update(report([x], "alone", before=-1.0, after=after))
    drawn = np.array([goal.point[0] for goal, _ in chosen(tree, ["alone"])])
    # A tenth of the way from 6 to anywhere in the region.
    assert drawn.min() == pytest.approx(5.4, abs=0.01)
    assert drawn.max() == pytest.approx(6.4, abs=0.01)


def test_the_worst_point_is_that_of_the_mode_chosen_or_of_any_if_it_has_none() -> None:
    tree = tree_with(WORST_POINT, spaces={"place": Box(0, 10)})
    tree.update(report([2.0], "alone", before=-1.0, after=-0.3))
    tree.update(report([8.0], "ask", before=-1.0, after=-0.9))
    assert all(1.8 <= goal.point[0] <= 2.8 for goal, _ in chosen(tree, ["alone"], count=200))
    assert all(7.2 <= goal.point[0] <= 8.2 for goal, _ in chosen(tree, ["ask"], count=200))
    untried = tree_with(WORST_POINT, spaces={"place": Box(0, 10)})
    untried.update(report([8.0], "ask", before=-1.0, after=-0.9))
    assert all(7.2 <= goal.point[0] <= 8.2 for goal, _ in chosen(untried, ["alone"], count=200))


def test_without_any_attempt_the_worst_point_rule_draws_anywhere() -> None:
    tree = tree_with(WORST_POINT, spaces={"place": Box(0, 10)})
    drawn = [goal.point[0] for goal, _ in chosen(tree)]
    assert np.quantile(drawn, [0.25, 0.5, 0.75]) == pytest.approx([2.5, 5, 7.5], abs=0.4)


def test_the_three_rules_share_the_choices() -> None:
    rules = (0.3, 0.5, 0.2)
    tree = tree_with(rules, spaces={"place": Box(0, 10)}, modes={"alone": 1.0}, candidates=200)
    for x, after in ((0.5, -1.0), (1.0, -1.0), (9.9, 0.0), (9.95, -0.05)):
        tree.update(report([x], "alone", before=-1.0, after=after))
    border = 10 * tree.roots["place"].cut
    width = 10 - border
    drawn = np.array([goal.point[0] for goal, _ in chosen(tree, ["alone"])])
    # Only the uniform rule ever aims below the border.
    assert np.mean(drawn <= border) == pytest.approx(0.3 * border / 10, abs=0.025)
    worst = 9.95
    near = (drawn >= worst - 0.1 * (worst - border)) & (drawn <= worst + 0.1 * (10 - worst))
    anywhere = (0.3 / 10 + 0.5 / width) * 0.1 * width
    assert np.mean(near) == pytest.approx(0.2 + anywhere, abs=0.025)


def test_choosing_changes_nothing() -> None:
    tree = tree_with((0.3, 0.5, 0.2))
    set_interest(tree, "throw", "ask", 0.7)
    before = tree.interests().tobytes()
    first, again = chosen(tree, count=50), chosen(tree, count=50)
    assert [(g.kind, g.point.tobytes(), m) for g, m in first] == [
        (g.kind, g.point.tobytes(), m) for g, m in again
    ]
    assert tree.interests().tobytes() == before


def with_contexts(rules: tuple[float, ...]) -> RegionTree:
    """Low goals bring progress in the wind from 0 to 1, high goals in the wind from 1 to 2."""
    tree = tree_with(
        rules, spaces={"place": Box(0, 10)}, modes={"alone": 1.0}, context_space=Box(0, 2)
    )
    rng = np.random.default_rng(1)
    for episode in range(400):
        place, wind = 10 * rng.random(1), 2 * rng.random(1)
        after = 0.0 if (place[0] < 5) == (wind[0] < 1) else -1.0
        tree.update(report(place, "alone", context=wind, before=-1.0, after=after, episode=episode))
    return tree


@pytest.mark.parametrize(("wind", "low_goals"), [(0.3, True), (0.7, True), (1.6, False)])
def test_goals_come_from_regions_that_bring_progress_in_the_present_context(
    wind: float, low_goals: bool
) -> None:
    tree = with_contexts(INTERESTING)
    context = np.array([wind])
    drawn = [goal.point[0] for goal, _ in chosen(tree, ["alone"], context, 500)]
    assert np.mean([(x < 5) == low_goals for x in drawn]) > 0.9


def test_a_goal_and_its_context_lie_in_one_of_the_regions_of_that_context() -> None:
    tree = with_contexts((0.0, 0.5, 0.5))
    for wind in (0.0, 0.4, 1.0, 2.0):
        regions = [r for r in tree.leaves if r.low[1] <= wind / 2 <= r.high[1]]
        assert 1 < len(regions) < len(tree.leaves)
        interesting = [r for r in regions if tree.interests()[r.leaf, 0] > 0]
        for goal, _ in chosen(tree, ["alone"], np.array([wind]), 200):
            place = goal.point[0] / 10
            assert any(r.low[0] - 1e-9 <= place <= r.high[0] + 1e-9 for r in interesting)


def test_contexts_outside_their_box_choose_as_at_its_border_and_teach_nothing() -> None:
    tree = with_contexts(INTERESTING)
    outside, border = (chosen(tree, ["alone"], np.array([wind]), 50) for wind in (2.5, 2.0))
    assert [g.point.tobytes() for g, _ in outside] == [g.point.tobytes() for g, _ in border]
    before = tree.interests().tobytes()
    tree.update(report([5.0], "alone", context=np.array([2.5]), before=-1.0, after=0.0))
    assert tree.interests().tobytes() == before
