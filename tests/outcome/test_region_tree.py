"""How a region tree divides the goal space: partition, lists, capacity, interests."""

from collections.abc import Mapping
from typing import Any

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from tests.helpers import PlainProgress, report

from sgim.outcome.interest import EpisodeReport
from sgim.outcome.partition import Region
from sgim.outcome.progress import CompetenceChange, Record
from sgim.outcome.region_tree import RegionTree
from sgim.records import Goal
from sgim.spaces import Box, Choices
from sgim.streams import Streams

MODES = {"alone": 1.0, "ask": 2.0}
PLACE = Box([0, 0], [10, 20])
NUMBERS = st.sampled_from([0.0, 0.1, 0.25, 0.5, 0.50001, 0.9, 1.0]) | st.floats(0, 1)


def tree_over(modes: Mapping[str, float] = MODES, **options: Any) -> RegionTree:
    spaces = options.pop("spaces", {"place": PLACE})
    options = {"capacity": 3, "candidates": 8, **options}
    measure = PlainProgress(window=options["capacity"])
    return RegionTree(spaces, modes, measure, Streams(0), **options)


@st.composite
def reports(draw: st.DrawFn, coordinates: st.SearchStrategy[float] = NUMBERS) -> EpisodeReport:
    share = np.array([draw(coordinates), draw(coordinates)])
    before, after = sorted(draw(st.tuples(st.floats(-1, 0), st.floats(-1, 0))))
    mode = draw(st.sampled_from(["alone", "ask"]))
    return report(PLACE.decode(share), mode, before=before, after=after)


HISTORIES = st.lists(reports(), max_size=60)


def grown(history: list[EpisodeReport], **options: Any) -> RegionTree:
    tree = tree_over(**options)
    for episode in history:
        tree.update(episode)
    return tree


def holds(region: Region, place: np.ndarray) -> bool:
    """Whether a place lies in a region: borders belong to the region below."""
    above = (region.low < place) | ((region.low == 0) & (place == 0))
    return bool((above & (place <= region.high)).all())


@given(HISTORIES, st.lists(st.tuples(NUMBERS, NUMBERS), max_size=20))
def test_every_place_lies_in_exactly_one_leaf_the_one_that_is_looked_up(
    history: list[EpisodeReport], places: list[tuple[float, float]]
) -> None:
    tree = grown(history)
    for place in map(np.array, places):
        holding = [leaf for leaf in tree.leaves if holds(leaf, place)]
        assert len(holding) == 1
        assert tree.region_of("place", place) is holding[0]


@given(HISTORIES)
def test_leaves_fill_the_box_and_know_their_row(history: list[EpisodeReport]) -> None:
    tree = grown(history)
    assert sum(np.prod(r.high - r.low) for r in tree.leaves) == pytest.approx(1.0)
    assert [r.leaf for r in tree.leaves] == list(range(len(tree.leaves)))
    assert all(tree.region_of("place", r.high) is r for r in tree.leaves)
    assert tree.interests().shape == (len(tree.leaves), 2)


@given(HISTORIES)
def test_children_inherit_exactly_the_lists_of_their_parent(history: list[EpisodeReport]) -> None:
    tree = tree_over()
    for episode in history:
        place = PLACE.encode(episode.chosen.point)
        region = tree.region_of("place", place)
        lists = [list(records) for records in region.records]
        tree.update(episode)
        if region.children is None:
            continue
        mode = tree.modes[episode.mode]
        lists[mode].append(Record(tuple(place), episode.after - episode.before, episode.after))
        lower, upper = region.children
        for i, records in enumerate(lists):
            below = [r for r in records if r.place[region.axis] <= region.cut]
            above = [r for r in records if r.place[region.axis] > region.cut]
            assert lower.records[i] == below
            assert upper.records[i] == above
        assert lower.records[mode]
        assert upper.records[mode]


@given(HISTORIES)
def test_no_list_is_longer_than_the_capacity(history: list[EpisodeReport]) -> None:
    tree = tree_over()
    for episode in history:
        tree.update(episode)
        assert all(len(records) <= 3 for leaf in tree.leaves for records in leaf.records)


@given(HISTORIES)
def test_interests_are_those_of_the_lists_over_the_cost(history: list[EpisodeReport]) -> None:
    tree = grown(history)
    for leaf, interests in zip(tree.leaves, tree.interests(), strict=True):
        for records, interest, cost in zip(leaf.records, interests, (1.0, 2.0), strict=True):
            if records:
                mean = sum(r.progress for r in records) / len(records)
                assert interest == pytest.approx(mean / cost, abs=1e-12)


@given(HISTORIES)
def test_the_same_history_grows_the_same_tree(history: list[EpisodeReport]) -> None:
    one, other = grown(history), grown(history)
    assert one.interests().tobytes() == other.interests().tobytes()
    for mine, its in zip(one.leaves, other.leaves, strict=True):
        assert mine.low.tobytes() == its.low.tobytes()
        assert mine.records == its.records


@given(st.lists(reports(st.sampled_from([-0.5, -1e-9, 1 + 1e-9, 2.0])), max_size=20))
def test_goals_outside_the_box_leave_the_map_as_it_is(history: list[EpisodeReport]) -> None:
    tree = grown(history)
    assert len(tree.leaves) == 1
    assert tree.interests().tolist() == [[0.3, 0.15]]


def test_reports_of_unknown_modes_and_kinds_leave_the_map_as_it_is() -> None:
    tree = grown([report([5, 5], "dance", after=0), report([5, 5], kind="throw", after=0)])
    assert tree.interests().tolist() == [[0.3, 0.15]]


def test_pairs_not_yet_tried_start_at_the_prior_over_the_cost() -> None:
    spaces = {"place": PLACE, "throw": Box(0, 1)}
    assert tree_over(spaces=spaces).interests().tolist() == [[0.3, 0.15]] * 2
    assert tree_over(prior=0.8).interests().tolist() == [[0.8, 0.4]]


def test_a_region_splits_once_one_list_exceeds_the_capacity() -> None:
    tree = tree_over()
    gains = [(1, "alone"), (2, "ask"), (3, "alone"), (4, "ask"), (5, "alone"), (6, "ask")]
    for x, mode in gains:
        tree.update(report([x, 10], mode, after=-0.5))
    assert len(tree.leaves) == 1
    tree.update(report([9, 10], "alone", after=-0.5))
    assert len(tree.leaves) == 2


def test_a_split_separates_different_interests() -> None:
    tree = tree_over({"alone": 1.0}, capacity=7, candidates=100)
    for x in range(8):
        # Progress 0.8 on the left, none on the right; the second coordinate tells nothing.
        gain = 0.8 if x < 4 else 0.0
        tree.update(report([0.5 + x, 2 + 16 * (x % 2)], "alone", before=-1, after=-1 + gain))
    root = tree.roots["place"]
    assert root.axis == 0
    assert 0.35 < root.cut <= 0.45
    assert sorted(tree.interests()[:, 0].tolist()) == pytest.approx([0.0, 0.8])


def test_a_split_weighs_how_many_records_it_separates() -> None:
    tree = tree_over({"alone": 1.0}, capacity=7, candidates=200)
    # The first alone differs most from the others; four and four separate more.
    for x, gain in enumerate((1.0, 0.6, 0.6, 0.6, 0.0, 0.0, 0.0, 0.0)):
        tree.update(report([0.5 + x, 10], "alone", before=-1, after=-1 + gain))
    assert sorted(tree.interests()[:, 0].tolist()) == pytest.approx([0.0, 0.7])


def test_a_child_without_records_of_a_mode_keeps_its_parents_interest() -> None:
    tree = tree_over(capacity=2, candidates=50)
    tree.update(report([1, 1], "ask", before=-1, after=-0.2))
    for x, after in ((1, -1.0), (2, -1.0), (9, 0.0)):
        tree.update(report([x, 1], "alone", before=-1, after=after))
    left = tree.region_of("place", np.array([0.1, 0.05]))
    right = tree.region_of("place", np.array([0.9, 0.05]))
    assert left is not right
    ask = tree.modes["ask"]
    assert left.records[ask]
    assert not right.records[ask]
    assert tree.interests()[left.leaf, ask] == tree.interests()[right.leaf, ask] == 0.4


def test_goals_that_cannot_be_separated_push_out_the_oldest() -> None:
    tree = tree_over({"alone": 1.0})
    for gain in (0.9, 0.1, 0.2, 0.3, 0.4):
        tree.update(report([5, 5], before=-1, after=-1 + gain))
    assert len(tree.leaves) == 1
    assert [r.progress for r in tree.leaves[0].records[0]] == pytest.approx([0.2, 0.3, 0.4])


def emulated() -> EpisodeReport:
    """A goal chosen on the left; what was pursued lies on the right."""
    return report([1, 1], "ask", pursued=Goal("place", np.array([9.0, 1.0])), after=0.0)


@pytest.mark.parametrize(("credit", "place"), [("chosen", 0.1), ("pursued", 0.9)])
def test_an_episode_counts_where_its_goal_was_chosen_or_at_what_it_pursued(
    credit: str, place: float
) -> None:
    tree = tree_over(credit=credit)
    tree.update(emulated())
    ((record,),) = [records for records in tree.leaves[0].records if records]
    assert record.place[0] == pytest.approx(place)


def test_credit_for_what_was_chosen_takes_the_progress_on_what_was_pursued() -> None:
    tree = tree_over(spaces={"place": PLACE, "throw": Box(0, 1)}, credit="chosen")
    far = Goal("throw", np.array([7.0]))  # Outside its box, which does not matter here.
    tree.update(report([1, 1], "ask", pursued=far, before=-1.0, after=-0.4))
    root = tree.roots["place"]
    assert tree.interests()[root.leaf].tolist() == pytest.approx([0.3, 0.3])
    assert tree.interests()[tree.roots["throw"].leaf].tolist() == [0.3, 0.15]


def test_pairs_left_alone_regain_interest_with_age_over_the_cost() -> None:
    tree = tree_over(staleness=0.02, patience=100.0)
    tree.update(report([5, 5], "alone", before=-1, after=-1, episode=0))
    assert tree.interests()[0, 0] == 0.0
    tree.update(report([5, 5], "ask", before=-1, after=-1, episode=100))
    # Half of it after as many episodes as the patience says, and in the end nearly all.
    assert tree.interests()[0].tolist() == pytest.approx([0.01, 0.0], abs=1e-12)
    tree.update(report([5, 5], "alone", before=-1, after=-1, episode=1_000_000))
    assert tree.interests()[0].tolist() == pytest.approx([0.0, 0.02 / 2], abs=1e-5)


def test_a_map_survives_more_leaves_than_it_has_room_for_at_first() -> None:
    tree = tree_over({"alone": 1.0}, capacity=1)
    rng = np.random.default_rng(0)
    for place in PLACE.decode(rng.random((300, 2))):
        tree.update(report(place, after=-0.5))
    assert len(tree.leaves) > 128
    assert np.isfinite(tree.interests()).all()


def test_the_measure_sees_each_list_oldest_first() -> None:
    tree = RegionTree({"place": PLACE}, {"alone": 1.0}, CompetenceChange(window=2), Streams(0))
    for after in (-0.9, -0.5, -0.2):
        tree.update(report([5, 5], after=after))
    assert tree.interests().tolist() == [[pytest.approx(0.15)]]


def test_goals_and_contexts_must_be_vectors() -> None:
    with pytest.raises(TypeError, match="needs boxes, but 'word' is Choices"):
        tree_over(spaces={"word": Choices(["ba"])})
    with pytest.raises(TypeError, match="needs boxes, but 'context' is Choices"):
        tree_over(context_space=Choices(["day"]))
