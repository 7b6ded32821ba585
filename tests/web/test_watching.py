"""What the page shows of a run is what its journal says, read bit by bit or at once."""

import asyncio
import json
from collections import Counter
from pathlib import Path

import numpy as np
import pytest

import sgim
from sgim.errors import SgimError
from sgim.runs.summary import read_run
from sgim.web import serve, watching
from sgim.web.messages import text_of
from sgim.web.protocol import RunFacts
from sgim.web.regions import FoldedRegions, regions_of
from sgim.web.watching import Watched

from .conftest import ARM, Site, taught_run


@pytest.fixture(scope="module")
def path(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A run with demonstrations, answered from a script."""
    made: Path = tmp_path_factory.mktemp("watch") / "run.sgim"
    experiment = sgim.experiments.experiment("throwing")
    with experiment.start("sgim-acts", made, seed=2, evaluate_every=200) as run:
        run.go(600)
    return made


def whole(path: Path) -> Watched:
    watched = Watched(0, path)
    while watched.look():
        pass
    return watched


def test_facts_are_those_of_the_journal(path: Path) -> None:
    run, facts = read_run(path), whole(path).facts()
    assert facts.movements == run.movements == 600
    assert (facts.target, facts.finished) == (600, True)
    assert [row[0] for row in facts.evaluations] == [e.movements for e in run.evaluations]
    assert facts.evaluations[-1][1:] == list(run.evaluations[-1].errors.values())
    opened = Counter(run.openings.modes)
    strip = np.sum([row[1:] for row in facts.strip], axis=0)
    assert dict(zip((m.name for m in facts.modes), strip.tolist(), strict=True)) == opened
    ended = read_run(path).movements - sum(mode.movements for mode in facts.modes)
    assert 0 <= ended <= 1, "all but the movements of the episode that is open"
    begun = len(run.openings.modes) - sum(mode.episodes for mode in facts.modes)
    assert 0 <= begun <= 1
    assert facts.requests["answered"] == len(facts.shown)
    assert {kind.kind for kind in facts.kinds} == {"throw", "place"}
    json.loads(text_of(facts))


def test_all_outcomes_of_a_short_run_are_shown_at_their_movements(path: Path) -> None:
    shown = {o.kind: o.points for o in whole(path).outcomes(all_=True)}
    with sgim.Journal.open(path, append=False) as journal:
        told = [event.outcome for event in journal.events(only=["told"])]  # type: ignore[union-attr]
    for kind, points in shown.items():
        of_kind = [(i, outcome[kind]) for i, outcome in enumerate(told) if kind in outcome]
        assert len(points) == len(of_kind)
        for (number, x, *_), (i, outcome) in zip(points, of_kind, strict=True):
            assert x == pytest.approx(outcome[0], rel=1e-3)
            assert abs(number - i) < 150


def test_a_run_that_grows_is_read_on_to_the_same_facts(tmp_path: Path) -> None:
    path = tmp_path / "a.sgim"
    with taught_run(path) as run:
        watched = Watched(0, path, run.learner.task)
        for target in (40, 90, 200):
            run.go(target)
            assert watched.look()
        assert not watched.look()
        steps, once = watched.facts(), whole(path).facts()
    for name in ("movements", "evaluations", "requests", "shown", "target"):
        assert getattr(steps, name) == getattr(once, name), name
    modes = [{m.name: (m.episodes, m.movements) for m in facts.modes} for facts in (steps, once)]
    assert modes[0] == modes[1]


def test_of_a_long_run_a_sample_is_shown(path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(watching, "MOST_POINTS", 50)
    watched = whole(path)
    counts = [len(o.points) for o in watched.outcomes(all_=True)]
    assert max(counts) <= 50
    assert sum(counts) > 20


def test_only_news_is_sent_until_the_sample_is_thinned(
    path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    watched = whole(path)
    assert all(o.afresh for o in watched.outcomes())
    assert watched.outcomes() == []


def test_regions_folded_from_the_journal_are_those_of_the_learner(tmp_path: Path) -> None:
    path = tmp_path / "a.sgim"
    with taught_run(path) as run:
        run.go(400)
        task, recipe = run.learner.task, dict(run.learner.recipe or {})
        live = regions_of(run.learner)
        run.journal.commit()  # type: ignore[union-attr]
        folded = FoldedRegions(path, task, recipe)()
    assert len(live) > 2
    assert [(r.kind, r.low, r.high) for r in folded] == [(r.kind, r.low, r.high) for r in live]
    assert np.allclose([r.interest for r in folded], [r.interest for r in live])


def test_a_journal_that_vanishes_is_said_and_found_again(tmp_path: Path, path: Path) -> None:
    copy = tmp_path / "copy.sgim"
    copy.write_bytes(path.read_bytes())
    watched = Watched(0, copy)
    away = copy.rename(tmp_path / "away.sgim")
    assert watched.look()
    assert "no journal" in watched.facts().problem
    away.rename(copy)
    assert watched.look()
    assert watched.facts().problem == ""


def test_the_best_movement_for_a_goal_is_recalled(path: Path) -> None:
    async def ask(site: Site) -> dict[str, object]:
        async with site.page("asker") as page:
            await page.send(what="recall", run=0, kind="throw", point=[5.0, 2.0])
            recalled: dict[str, object] = await page.get("recalled")
            await page.send(what="recall", run=0, kind="thrw", point=[5.0, 2.0])
            assert "Did you mean" in (await page.get("recalled"))["problem"]
            await page.send(what="recall", run=7, kind="throw", point=[5.0, 2.0])
            assert "no run 7" in (await page.get("recalled"))["problem"]
            return recalled

    with serve(path, port=0) as served:
        recalled = asyncio.run(ask(Site(served)))
    solution = sgim.open(path).solve("throw", [5.0, 2.0])
    assert np.allclose(recalled["expected"], solution.expected)  # type: ignore[arg-type]
    assert recalled["movement"]["frames"]  # type: ignore[index]
    assert recalled["shapes"]


def test_a_page_that_watches_cannot_teach(path: Path) -> None:
    async def ask(site: Site) -> str:
        async with site.page("watcher") as page:
            await page.send(what="control", take=True)
            await page.send(what="skip", id="s", plan=1)
            return str((await page.get("refused"))["words"])

    with serve(path, port=0) as served:
        assert "only watches" in asyncio.run(ask(Site(served)))


def test_several_runs_are_watched_on_one_page(path: Path, journal: Path) -> None:
    async def titles(site: Site) -> list[RunFacts]:
        async with site.page("two") as page:
            return [await page.get("runfacts", lambda m, i=i: m["run"] == i) for i in (0, 1)]  # type: ignore[misc]

    with serve(path, journal, port=0) as served:
        both = asyncio.run(titles(Site(served)))
    assert len({facts["title"] for facts in both}) == 2  # type: ignore[index]


def test_a_run_is_watched_from_its_own_process(tmp_path: Path) -> None:
    async def finished(site: Site) -> int:
        async with site.page("same") as page:
            facts = await page.get("runfacts", lambda m: m["movements"] >= 120)
            return int(facts["movements"])

    with taught_run(tmp_path / "a.sgim") as run, serve(run, port=0) as served:
        assert "127.0.0.1" in served._repr_html_()
        run.go(120)
        assert asyncio.run(finished(Site(served))) == 120


def test_a_run_without_a_journal_and_no_run_are_refused() -> None:
    learner = sgim.algorithms.make("random", ARM.task)
    with pytest.raises(SgimError, match="journal=PATH"):
        serve(sgim.Run(learner, ARM), port=0)
    with pytest.raises(SgimError, match="no run"):
        serve(port=0)
