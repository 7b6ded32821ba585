"""Comparisons say what the numbers say, and refuse what does not compare."""

from __future__ import annotations

import json
from collections.abc import Callable, Sequence
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from scipy.stats import mannwhitneyu, wilcoxon

from sgim.configurations import CONFIGURATIONS
from sgim.errors import SgimError, UnknownNameError
from sgim.events import Evaluated
from sgim.runs.comparison import compare
from sgim.runs.measured import MeasuredRun
from sgim.statistics import interquartile_mean

GOALS = {"goals": {"spot": 3}, "distance": "scaled", "digest": "00"}


def run(
    learner: str,
    seed: int | None,
    errors: Sequence[float],
    *,
    target: int | None = None,
    benchmark: dict[str, Any] | None = GOALS,
    every: int = 1000,
    header: dict[str, Any] | None = None,
    **configuration: Any,
) -> MeasuredRun:
    recipe = {"configuration": {"name": "modern", **configuration}, "seed": seed}
    evaluations = tuple(
        Evaluated(i * every, {"spot": e, "word": 2 * e, "total": 1.5 * e})
        for i, e in enumerate(errors)
    )
    about = {"experiment": "made up", "learner": learner, "recipe": recipe, "batch": 1}
    if target is None:
        target = every * (len(errors) - 1)
    path = Path(f"{learner}-{seed}.sgim")
    return MeasuredRun(path, {**about, **(header or {})}, target, benchmark, evaluations)


def several(
    learner: str, last: Sequence[float], seeds: Sequence[int] | None = None, **more: Any
) -> list[MeasuredRun]:
    seeds = range(len(last)) if seeds is None else seeds
    return [run(learner, s, [1, 0.5, e], **more) for s, e in zip(seeds, last, strict=True)]


LOW = [0.10, 0.12, 0.11, 0.09, 0.14, 0.13, 0.105, 0.115]
HIGH = [0.20, 0.26, 0.21, 0.27, 0.22, 0.19, 0.29, 0.23]


def test_each_learner_has_its_errors_at_the_last_evaluation_the_lowest_first() -> None:
    found = compare([*several("random", HIGH), *several("good", LOW)], kind="spot")
    good, random = found.groups
    assert (good.name, random.name) == ("good", "random")
    assert good.median == np.median(LOW)
    assert good.middle.value == interquartile_mean(LOW)
    assert good.middle.low < good.middle.value < good.middle.high
    np.testing.assert_allclose(good.curve.value, [1, 0.5, interquartile_mean(LOW)])
    areas = [(0.75 + (0.5 + e) / 2) / 2 for e in LOW]
    assert good.area.value == pytest.approx(interquartile_mean(areas))
    assert found.movements.tolist() == [0, 1000, 2000]


def test_learners_are_paired_by_seed_whatever_their_order() -> None:
    runs = [*several("random", HIGH), *several("good", LOW)]
    found = compare([*runs[::-1]], kind="spot", against="random")
    (contrast,) = found.contrasts
    difference = np.array(LOW) - HIGH
    assert contrast.seeds == list(range(8))
    assert contrast.p == pytest.approx(wilcoxon(difference).pvalue)
    assert contrast.p_holm == contrast.p
    expected = interquartile_mean(LOW) - interquartile_mean(HIGH)
    assert contrast.difference.value == pytest.approx(float(expected))
    assert contrast.difference.high < 0
    ratio = interquartile_mean(LOW) / interquartile_mean(HIGH)
    assert contrast.ratio.value == pytest.approx(float(ratio))
    assert contrast.lower == 1
    assert contrast.rank_biserial == -1
    assert contrast.verdict == "lower"
    other_way = compare(runs, kind="spot", against="good").contrasts[0]
    assert other_way.verdict == "higher"


def test_learners_with_other_seeds_are_not_paired_and_that_is_noted() -> None:
    runs = [*several("random", HIGH), *several("good", LOW, seeds=range(20, 28))]
    found = compare(runs, kind="spot", against="random")
    (contrast,) = found.contrasts
    assert contrast.seeds is None
    assert contrast.p == pytest.approx(mannwhitneyu(LOW, HIGH, method="exact").pvalue)
    assert any("0 in common: not paired" in note for note in found.notes)


def test_learners_that_share_enough_seeds_are_paired_on_those() -> None:
    runs = [*several("random", HIGH), *several("good", LOW, seeds=range(1, 9))]
    found = compare(runs, kind="spot", against="random")
    (contrast,) = found.contrasts
    assert contrast.seeds == [1, 2, 3, 4, 5, 6, 7]
    expected = wilcoxon(np.array(LOW[:7]) - HIGH[1:]).pvalue
    assert contrast.p == pytest.approx(expected)
    assert any("compared on the 7 they share" in note for note in found.notes)


def test_runs_without_a_seed_are_not_paired() -> None:
    runs = [*several("good", LOW), *(run("own", None, [1, 0.5, e]) for e in HIGH)]
    found = compare(runs)
    assert found.contrasts[0].seeds is None
    assert any("do not say their seed" in note for note in found.notes)


def test_p_values_are_corrected_for_the_number_of_comparisons() -> None:
    runs = [*several("sgim-acts", LOW)]
    for i in range(4):
        runs += several(f"other {i}", HIGH)
    found = compare(runs)
    assert found.reference == "sgim-acts"
    assert [c.p for c in found.contrasts] == [pytest.approx(2 / 2**8)] * 4
    assert [c.p_holm for c in found.contrasts] == [pytest.approx(4 * 2 / 2**8)] * 4


def test_learners_that_are_close_are_equivalent_and_those_unlike_neither_are_undecided() -> None:
    close = [e * f for e, f in zip(LOW, [1.02, 0.97, 1.01, 0.99, 1.03, 0.98, 1, 1], strict=True)]
    wild = [e * f for e, f in zip(LOW, [3, 0.3, 2, 0.5, 1.1, 0.8, 1.5, 0.6], strict=True)]
    runs = [*several("sgim-acts", LOW), *several("close", close), *several("wild", wild)]
    verdicts = {c.name: c.verdict for c in compare(runs).contrasts}
    assert verdicts == {"close": "equivalent", "wild": "undecided"}
    assert {c.verdict for c in compare(runs, margin=0.001).contrasts} == {"undecided"}


def test_a_difference_smaller_than_the_margin_is_both() -> None:
    runs = [*several("sgim-acts", LOW), *several("close", [0.95 * e for e in LOW])]
    assert compare(runs).contrasts[0].verdict == "lower but equivalent"


def test_few_seeds_are_said_to_decide_nothing() -> None:
    found = compare([*several("sgim-acts", LOW[:4]), *several("random", HIGH[:4])])
    assert found.contrasts[0].verdict == "undecided"
    assert any("6 seeds or more are needed" in note for note in found.notes)


def test_one_run_has_no_interval_and_that_is_noted() -> None:
    found = compare([*several("sgim-acts", LOW), *several("random", HIGH[:1])])
    assert np.isnan(found.groups[1].middle.low)
    assert any("random has one run" in note for note in found.notes)
    json.dumps(found.as_json(), allow_nan=False)


def test_one_learner_alone_is_compared_with_nobody() -> None:
    found = compare(several("random", HIGH))
    assert found.reference is None
    assert found.contrasts == ()


def test_without_sgim_acts_the_lowest_is_the_reference_and_that_is_noted() -> None:
    found = compare([*several("random", HIGH), *several("good", LOW)])
    assert found.reference == "good"
    assert any("flatters it" in note for note in found.notes)


def test_configurations_and_batches_are_learners_of_their_own() -> None:
    runs = [
        *several("sgim-acts", LOW),
        *several("sgim-acts", HIGH, name="thesis"),
        *several("sgim-acts", HIGH, header={"batch": 8}),
    ]
    names = {group.name for group in compare(runs).groups}
    assert names == {
        "sgim-acts (modern, batch 1)",
        "sgim-acts (thesis, batch 1)",
        "sgim-acts (modern, batch 8)",
    }
    with pytest.raises(SgimError, match="may be 'sgim-acts"):
        compare(runs, against="sgim-acts")
    assert compare(runs, against="sgim-acts (thesis, batch 1)").reference is not None


def test_another_seed_of_the_bootstrap_changes_intervals_and_nothing_else() -> None:
    runs = several("random", np.random.default_rng(0).uniform(0.1, 0.4, 12).tolist())
    runs += several("good", np.random.default_rng(1).uniform(0.1, 0.2, 12).tolist())
    one, same, other = compare(runs), compare(runs), compare(runs, seed=1)
    assert one.as_json() == same.as_json()
    assert one.groups[0].middle.value == other.groups[0].middle.value
    assert one.groups[0].middle.low != other.groups[0].middle.low
    assert one.contrasts[0].p == other.contrasts[0].p


def test_the_intervals_of_a_learner_do_not_depend_on_who_else_is_there() -> None:
    alone = compare(several("random", HIGH)).groups[0]
    among = compare([*several("good", LOW), *several("random", HIGH)]).groups[1]
    assert alone.middle == among.middle


def test_an_evaluation_may_be_chosen_and_who_lacks_it_is_left_out() -> None:
    runs = [*several("random", HIGH), *several("good", LOW), run("good", 99, [1.0], target=2000)]
    found = compare(runs, at=1000)
    assert found.movements.tolist() == [0, 1000]
    assert [len(group.runs) for group in found.groups] == [8, 8]
    assert any("not evaluated at 1000 movements: good-99.sgim" in note for note in found.notes)


def test_a_run_that_is_not_finished_holds_the_others_back_and_that_is_noted() -> None:
    runs = [*several("random", HIGH), run("random", 99, [1, 0.5], target=2000)]
    found = compare(runs)
    assert found.movements.tolist() == [0, 1000]
    assert any("not finished: random-99.sgim" in note for note in found.notes)


def test_evaluations_that_only_some_have_are_passed_over() -> None:
    runs = [*several("random", HIGH), run("random", 99, [1, 0.8, 0.6, 0.5, 0.3], every=500)]
    assert compare(runs).movements.tolist() == [0, 1000, 2000]


def test_journals_that_do_not_say_how_they_were_measured_are_noted() -> None:
    found = compare([*several("good", LOW), *several("random", HIGH, benchmark=None)])
    assert any("8 of 16 journals do not say" in note for note in found.notes)


OTHER_GOALS = {**GOALS, "digest": "01"}


def test_runs_of_before_a_setting_existed_are_of_the_same_learner() -> None:
    now = dict(CONFIGURATIONS["thesis"].describe())
    before = {key: value for key, value in now.items() if key not in ("feeds_map", "beyond_noise")}
    runs = [
        run("random", seed, [1, 0.5], **configuration)
        for seed, configuration in enumerate((before, now))
    ]
    (found,) = compare(runs).groups
    assert len(found.runs) == 2
    with pytest.raises(SgimError, match="both called random, but"):
        compare([runs[0], run("random", 2, [1, 0.5], **{**now, "beyond_noise": 2.0})])


@pytest.mark.parametrize(
    ("runs", "options", "message"),
    [
        (lambda: [], {}, "no run to compare"),
        (lambda: several("a", LOW, header={"experiment": "arm"}), {}, "runs of arm, made up"),
        (lambda: several("a", LOW, header={"task": {"x": 1}}), {}, "different tasks"),
        (lambda: several("a", LOW, benchmark=OTHER_GOALS), {}, "different goals"),
        (lambda: [run("a", 0, [1, 0.5])], {}, "1000 .*2000 .*--at 1000"),
        (lambda: [], {"at": 1500}, "evaluated at 1500 movements; there are some at 1000, 2000"),
        (lambda: [run("a", 0, [1] * 3, every=667, target=2000)], {}, "no evaluation in common"),
        (lambda: several("random", [0.1]), {}, "both random with seed 0"),
        (lambda: several("random", [0.1], seeds=[50], gamma=2), {}, "both called random, but"),
        (lambda: [], {"margin": 1.5}, "share between 0 and 1"),
    ],
)
def test_what_does_not_compare_is_refused_with_what_to_do(
    runs: Callable[[], list[MeasuredRun]], options: dict[str, Any], message: str
) -> None:
    more = runs()
    together = [] if "no run" in message else [*several("random", HIGH), *more]
    with pytest.raises(SgimError, match=message):
        compare(together, **options)


def test_unknown_kinds_and_learners_are_answered_with_the_nearest() -> None:
    runs = several("random", HIGH)
    with pytest.raises(UnknownNameError, match="Did you mean 'spot'"):
        compare(runs, kind="spt")
    with pytest.raises(UnknownNameError, match="Did you mean 'random'"):
        compare(runs, against="radnom")


def test_runs_that_were_never_evaluated_are_not_compared() -> None:
    with pytest.raises(SgimError, match="no run was evaluated after a movement; let them go on"):
        compare([run("random", 0, [], target=100), run("random", 1, [1.0], target=100)])
