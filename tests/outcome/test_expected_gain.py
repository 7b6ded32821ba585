"""How expected gain weighs goals and modes: by what lacks, by shares, by volume, by mode."""

from collections import Counter
from collections.abc import Callable, Sequence
from typing import Any

import numpy as np
import pytest
from tests.helpers import report

from sgim.outcome.expected_gain import ExpectedGain
from sgim.outcome.within_reach import WithinReach
from sgim.records import Goal
from sgim.spaces import BoolArray, Box, FloatArray
from sgim.streams import Streams

SPACES = {"place": Box(0, 10), "throw": Box([-1, 0], [1, 2])}
MODES = {"alone": 1.0, "ask": 2.0}
COUNT = 3000


def all_lack_alike(kind: str, places: FloatArray, context: Any) -> FloatArray:
    return np.ones(len(places))


def map_of(**options: Any) -> ExpectedGain:
    options = {"spaces": SPACES, "modes": MODES, "lacks": all_lack_alike, "uniform": 0, **options}
    spaces, modes, lacks = (options.pop(name) for name in ("spaces", "modes", "lacks"))
    return ExpectedGain(spaces, modes, lacks, Streams(0), **options)


def chosen(
    one: ExpectedGain, modes: Sequence[str] = tuple(MODES), context: Any = None, count: int = COUNT
) -> list[tuple[Goal, str]]:
    rng = np.random.default_rng(0)
    return [one.choose(rng, list(modes), context) for _ in range(count)]


def attempt(
    one: ExpectedGain, point: Any, mode: str, before: float, after: float, n: int = 1
) -> None:
    for _ in range(n):
        one.update(report(point, mode, before=-before, after=-after))


def share_of(choices: list[tuple[Goal, str]], **wanted: Any) -> float:
    kind, mode = wanted.get("kind"), wanted.get("mode")
    found = [g.kind == (kind or g.kind) and m == (mode or m) for g, m in choices]
    return sum(found) / len(choices)


def test_before_anything_is_known_goals_are_uniform_and_dear_modes_are_rarer() -> None:
    choices = chosen(map_of(goals=1, sharpness=1.0))
    assert share_of(choices, kind="place") == pytest.approx(0.5, abs=0.03)
    assert share_of(choices, mode="ask") == pytest.approx(1 / 3, abs=0.03)
    points = np.array([g.point[0] for g, _ in choices if g.kind == "place"])
    assert np.histogram(points, 4, (0, 10))[0] / len(points) == pytest.approx(0.25, abs=0.04)


def test_the_gain_expected_is_what_is_lacking_times_the_share_removed_by_cost() -> None:
    one = map_of(confidence=1e-9)
    attempt(one, [3.0], "alone", 0.4, 0.3, n=20)
    attempt(one, [3.0], "ask", 0.4, 0.1, n=20)
    gains = one.gains()[one.roots["place"].leaf]
    assert gains == pytest.approx([0.4 * 0.25, 0.4 * 0.75 / 2])


def test_shares_are_a_movement() -> None:
    one = map_of(confidence=1e-9)
    one.update(report([3.0], before=-0.4, after=-0.2, movements=5))
    assert one.gains()[0, 0] == pytest.approx(0.4 * 0.1)


def test_a_mode_is_judged_alike_whether_it_was_tried_early_or_late() -> None:
    one = map_of(confidence=1e-9, window=5, kind_window=5)
    attempt(one, [3.0], "ask", 0.8, 0.4, n=5)  # early: half of much
    attempt(one, [3.0], "alone", 0.01, 0.01, n=5)  # meanwhile it was learned otherwise
    attempt(one, [3.0], "alone", 0.01, 0.005, n=5)  # late: half of little
    alone, ask = one.gains()[one.roots["place"].leaf]
    assert ask == pytest.approx(alone / 2)  # it costs twice as much


def test_gains_on_what_is_nearly_reached_count_little() -> None:
    one = map_of(confidence=1e-9)
    attempt(one, [3.0], "alone", 0.4, 0.2, n=5)
    attempt(one, [3.0], "alone", 1e-6, 0.0, n=5)
    assert one.roots["place"].records[5].share < 1e-4


def test_a_useless_mode_is_given_up_everywhere_after_a_few_attempts() -> None:
    one = map_of(capacity=10, goals=1)
    rng = np.random.default_rng(1)
    for _ in range(200):
        attempt(one, [10 * rng.random()], "alone", 0.1, 0.05)
    assert len(one.leaves) > 8
    for _ in range(12):
        attempt(one, [10 * rng.random()], "ask", 0.1, 0.1)
    for _ in range(100):  # every region hears of it with its next attempt
        attempt(one, [10 * rng.random()], "alone", 0.1, 0.05)
    choices = [c for c in chosen(one) if c[0].kind == "place"]
    assert share_of(choices, mode="ask") < 0.05


def test_to_emulate_what_is_mastered_gains_nothing() -> None:
    one = map_of(confidence=1e-9)
    attempt(one, [3.0], "alone", 0.4, 0.2, n=10)
    mastered = Goal("place", np.array([5.0]))
    for _ in range(10):
        one.update(report([3.0], "ask", pursued=mastered, before=-1e-6, after=-1e-9))
    assert one.gains()[one.roots["place"].leaf, 1] < 1e-5


def test_emulation_does_not_change_what_is_known_to_be_lacking() -> None:
    one = map_of(confidence=1e-9)
    attempt(one, [3.0], "alone", 0.4, 0.4)
    one.update(report([3.0], "ask", pursued=Goal("place", np.array([5.0])), before=0, after=0))
    one.update(report([3.0], "alone", pursued=Goal("place", np.array([3.0])), before=-0.2))
    attempts = one.roots["place"].records
    assert [a.lack for a in attempts] == pytest.approx([0.4, 0.4, 0.2])


def split_in_two() -> ExpectedGain:
    """Places below 2 are out of reach, those above are learned."""
    one = map_of(capacity=20, goals=1, spaces={"place": SPACES["place"]})
    rng = np.random.default_rng(5)
    for _ in range(300):
        x = 10 * rng.random()
        attempt(one, [x], "alone", 0.4, 0.4 if x < 2 else 0.2)
    return one


def test_where_nothing_is_gained_goals_become_rare_and_elsewhere_they_are_even() -> None:
    points = np.array([g.point[0] for g, _ in chosen(split_in_two())])
    low, *others = np.histogram(points, 5, (0, 10))[0] / len(points)
    assert low < 0.13  # Some regions lie across the border.
    assert others == pytest.approx([0.22] * 4, abs=0.05)


def test_weights_follow_volume_however_regions_are_split() -> None:
    one = split_in_two()
    gains = one.gains().max(axis=1)
    volumes = np.array([region.high[0] - region.low[0] for region in one.leaves])
    assert volumes.sum() == pytest.approx(1.0)
    counts = Counter(one.region_of("place", g.point / 10).leaf for g, _ in chosen(one))
    expected = gains * volumes / (gains * volumes).sum()
    assert [counts[i] / COUNT for i in range(len(expected))] == pytest.approx(expected, abs=0.04)


def test_of_several_goals_the_one_where_most_is_lacking_now_is_taken() -> None:
    def lacks(kind: str, places: FloatArray, context: Any) -> FloatArray:
        return places[:, 0]

    spaces = {"place": SPACES["place"]}
    one, three = (
        [g.point[0] for g, _ in chosen(map_of(spaces=spaces, lacks=lacks, goals=n))] for n in (1, 3)
    )
    assert np.mean(one) == pytest.approx(5.0, abs=0.2)
    assert np.mean(three) == pytest.approx(7.5, abs=0.2)  # the largest of three


def amid(places: FloatArray) -> BoolArray:
    """Outcomes lie where the first coordinate is in the lower half."""
    return places[:, 0] < 0.5


def noisy(
    *kinds: str, among: Callable[[FloatArray], BoolArray] = amid, deviation: float = 0.1
) -> WithinReach:
    """Outcomes of some kinds have noise."""
    return WithinReach(
        lambda kind: deviation if kind in kinds else None,
        lambda kind, places, context: among(places),
        least=1.0,
    )


def at_the_edge(gain: float, reach: WithinReach | None, **options: Any) -> ExpectedGain:
    """Attempts at places beyond 5 have gained as much; those below nothing."""
    one = map_of(spaces={"place": SPACES["place"]}, noisy=reach, capacity=20, **options)
    rng = np.random.default_rng(1)
    for _ in range(400):
        x = 10 * rng.random()
        attempt(one, [x], "alone", 0.6, 0.6 - (gain if x > 5 else 0.0))
    return one


# The chance of an attempt beyond is 1/22, or 21/22.
@pytest.mark.parametrize(("gain", "beyond"), [(0.09, 0.043), (0.11, 0.49)])
def test_where_outcomes_are_noisy_goals_beyond_them_are_taken_if_more_than_noise_is_gained(
    gain: float, beyond: float
) -> None:
    points = np.array([g.point[0] for g, _ in chosen(at_the_edge(gain, noisy("place")))])
    assert np.mean(points > 5) == pytest.approx(beyond, abs=0.02)
    below = points[points < 5]
    assert np.percentile(below, [10, 50, 90]) == pytest.approx([0.5, 2.5, 4.5], abs=0.3)


def test_where_nothing_lies_within_reach_goals_are_drawn_evenly_all_the_same() -> None:
    nowhere = noisy("place", among=lambda places: np.zeros(len(places), dtype=np.bool_))
    points = np.array([g.point[0] for g, _ in chosen(at_the_edge(0.0, nowhere))])
    assert np.histogram(points, 4, (0, 10))[0] / len(points) == pytest.approx(0.25, abs=0.04)


def test_without_noise_goals_follow_gains_wherever_outcomes_lie() -> None:
    def points(reach: WithinReach | None) -> list[float]:
        one = at_the_edge(0.09, reach, modes={"alone": 1.0})
        return [float(g.point[0]) for g, _ in chosen(one, ["alone"], count=200)]

    assert points(noisy("throw")) == points(None)
    assert np.mean(np.array(points(None)) > 5) > 0.9


def test_of_several_kinds_only_the_goals_of_noisy_ones_are_drawn_within_reach() -> None:
    one = map_of(noisy=noisy("throw"), capacity=20)
    rng = np.random.default_rng(1)
    for _ in range(400):  # both gain at the edge only, throws no more than by luck
        x = 10 * rng.random()
        attempt(one, [x], "alone", 0.6, 0.5 if x > 5 else 0.6)
        x, y = 2 * rng.random(2)
        one.update(
            report([x - 1, y], "alone", before=-0.6, after=-0.55 if x > 1 else -0.6, kind="throw")
        )
    choices = chosen(one, ["alone"])
    assert share_of(choices, kind="throw") > 0.2
    throws = np.array([g.point[0] for g, _ in choices if g.kind == "throw"])
    places = np.array([g.point[0] for g, _ in choices if g.kind == "place"])
    assert np.mean(throws > 0) < 0.1
    assert np.mean(places > 5) > 0.5


def test_under_noise_the_mode_follows_gains() -> None:
    one = at_the_edge(0.09, noisy("place", among=lambda places: places[:, 0] < 2))
    attempt(one, [7.0], "ask", 0.6, 0.1, n=20)
    asked = [m for g, m in chosen(one) if 6.9 < g.point[0] < 7.1]
    assert asked.count("ask") > 0.8 * len(asked)


def test_what_is_gained_at_a_goal_shown_does_not_count_where_another_was_chosen() -> None:
    one = at_the_edge(0.0, noisy("place"))
    for x in np.linspace(5, 10, 200):
        one.update(
            report([x], "ask", before=-0.6, after=-0.1, pursued=Goal("place", np.array([2.0])))
        )
    assert np.mean(np.array([g.point[0] for g, _ in chosen(one)]) > 5) == pytest.approx(
        0.1, abs=0.1
    )


def test_several_choices_under_noise_are_those_made_one_by_one() -> None:
    one = map_of(noisy=noisy("throw"))
    attempt(one, [7.0], "ask", 0.6, 0.1, n=20)
    several = 40
    together = one.choose_all(
        [np.random.default_rng(i) for i in range(several)], list(MODES), [None] * several
    )
    alone = [one.choose(np.random.default_rng(i), list(MODES), None) for i in range(several)]
    assert {goal.kind for goal, _ in together} == set(SPACES)
    assert [(g.kind, g.point.tolist(), m) for g, m in together] == [
        (g.kind, g.point.tolist(), m) for g, m in alone
    ]


def test_sharpness_prefers_the_best_mode_of_a_region() -> None:
    shares = []
    for sharpness in (1.0, 3.0):
        one = map_of(sharpness=sharpness, confidence=1e-9, goals=1, spaces={"place": Box(0, 10)})
        attempt(one, [3.0], "alone", 0.4, 0.2, n=10)
        attempt(one, [3.0], "ask", 0.4, 0.2, n=10)
        shares.append(share_of(chosen(one), mode="ask"))
    assert shares == pytest.approx([1 / 3, 1 / 9], abs=0.03)


def test_the_uniform_rule_goes_where_nothing_was_gained() -> None:
    one = map_of(uniform=0.5, goals=1, spaces={"place": SPACES["place"]}, confidence=1e-9)
    rng = np.random.default_rng(5)
    for _ in range(300):
        x = 10 * rng.random()
        attempt(one, [x], "alone", 0.4, 0.4 if x < 2 else 0.2)
    points = np.array([g.point[0] for g, _ in chosen(one)])
    assert np.mean(points < 2) == pytest.approx(0.5 * 0.2, abs=0.05)


def test_modes_not_offered_are_never_chosen() -> None:
    assert share_of(chosen(split_in_two(), ["ask"]), mode="ask") == 1.0


def test_only_regions_of_the_present_context_are_chosen_from() -> None:
    wind = Box(0, 1)
    one = map_of(spaces={"place": SPACES["place"]}, context_space=wind, capacity=30, goals=1)
    rng = np.random.default_rng(5)
    for _ in range(3000):  # where the wind is above the goal, nothing is gained
        x, w = rng.random(), rng.random()
        gained = 0.0 if w > 0.5 and x > 0.5 else 0.2
        one.update(report([10 * x], context=np.array([w]), before=-0.4, after=-0.4 + gained))
    still, windy = (
        np.mean([g.point[0] > 5 for g, _ in chosen(one, context=np.array([w]))]) for w in (0.1, 0.9)
    )
    assert still == pytest.approx(0.5, abs=0.08)
    assert windy < 0.36


def test_reports_of_unknown_modes_and_goals_out_of_bounds_change_nothing() -> None:
    one, other = map_of(), map_of()
    other.update(report([3.0], "a stranger"))
    other.update(report([11.0], "alone"))
    other.update(report([3.0], "alone", kind="nothing known"))
    assert (one.gains() == other.gains()).all()
    assert not other.roots["place"].records


def test_nothing_expected_anywhere_is_no_lock() -> None:
    one = map_of(prior=0.0, goals=1)
    choices = chosen(one)
    assert share_of(choices, kind="place") == pytest.approx(0.5, abs=0.05)
    assert share_of(choices, mode="ask") == pytest.approx(0.5, abs=0.05)


def test_a_first_emulation_of_what_is_known_does_not_hide_a_kind() -> None:
    one = map_of()
    known = Goal("place", np.array([5.0]))
    one.update(report([0.0, 1.0], "ask", kind="throw", pursued=known, before=0.0, after=0.0))
    assert share_of(chosen(one), kind="throw") > 0.2


def test_contexts_measured_a_little_outside_their_box_count_at_its_border() -> None:
    one = map_of(spaces={"place": SPACES["place"]}, context_space=Box(0, 1))
    one.update(report([3.0], context=np.array([1.05]), before=-0.4, after=-0.2))
    assert one.roots["place"].records[0].place == (0.3, 1.0)
