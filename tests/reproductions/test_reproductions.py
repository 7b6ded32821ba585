"""A chapter made again is one folder, with a report that needs nothing else."""

from __future__ import annotations

import json
import re
from dataclasses import replace
from pathlib import Path

import pytest

from sgim.claims import CHAPTERS
from sgim.cli import main
from sgim.experiments.sweep_plan import Part, plan
from sgim.reproductions import REPRODUCTIONS, Quick, Reproduction
from sgim.reproductions.throwing import REPRODUCTION as THROWING

TINY = replace(
    THROWING,
    name="tiny",
    parts=(Part(("throwing",), ("sgim-acts", "random", "mimicry:T1"), (), ("modern", "thesis")),),
    worlds=(Part(("throwing-5",), ("sgim-acts", "random"), (), movements=60),),
    world_seeds=(0, 1),
    quick=Quick((0, 1), 60),
)
"""A chapter that takes seconds."""


@pytest.fixture(scope="module")
def folder(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The tiny chapter, made with one run that cannot be."""
    out = tmp_path_factory.mktemp("reproduced") / "tiny"
    (out / "runs").mkdir(parents=True)
    (out / "runs" / "throwing-random-1.sgim").write_text("<not a journal>")
    with pytest.MonkeyPatch.context() as patch:
        patch.setitem(REPRODUCTIONS, "tiny", TINY)
        code = main(["reproduce", "tiny", "--quick", "--out", str(out), "--jobs", "1"])
    assert code == 1
    return out


@pytest.fixture(scope="module")
def report(folder: Path) -> str:
    return (folder / "report.html").read_text("utf-8")


def test_the_folder_has_report_verdicts_figures_and_journals(folder: Path) -> None:
    names = {path.name for path in folder.iterdir()}
    assert names == {"report.html", "claims.json", "figures", "runs"}
    (table,) = json.loads((folder / "claims.json").read_text("utf-8"))["tables"]
    assert [claim["id"] for claim in table["claims"]] == [c.id for c in CHAPTERS["throwing"].claims]
    figures = {path.name for path in (folder / "figures").iterdir()}
    assert figures == {f"throwing-modern-{drawing.name}.svg" for drawing in TINY.drawings}


def test_the_report_needs_no_other_file_and_no_network(report: str) -> None:
    without_names = re.sub(r'xmlns(:\w+)?="[^"]*"', "", report)
    for word in ("http:", "https:", "<script", "<link", "<img", "@import", "src="):
        assert word not in without_names
    assert all(link.startswith("#") for link in re.findall(r'href="([^"]*)"', without_names))


def test_every_link_and_reference_of_the_report_leads_to_one_place(report: str) -> None:
    anchors = re.findall(r'\bid="([^"]+)"', report)
    assert len(anchors) == len({*anchors})
    assert {*re.findall(r'(?:href="|url\()#([^")]+)', report)} <= {*anchors}


def test_the_report_says_what_was_run_found_and_drawn(report: str) -> None:
    for words in (
        "sgim reproduce tiny --quick --out",
        "5 of 6 runs finished, 1 failed",
        "first look",
        "numpy",
        *(f"<b>{claim.id}</b>" for claim in CHAPTERS["throwing"].claims),
        *(drawing.title for drawing in TINY.drawings),
    ):
        assert words in report
    assert report.count("<svg") == 2 * len(TINY.drawings)
    assert 'name="viewport"' in report
    assert "prefers-color-scheme: dark" in report


def test_a_run_that_failed_is_in_the_report_with_its_traceback(report: str) -> None:
    assert "random, seed 1 (throwing-random-1.sgim), tried 3 times" in report
    assert "Traceback" in report.partition("Runs that failed</h2>")[2]
    assert "is not a journal" in report


def test_worlds_are_counted_if_they_are_asked_for() -> None:
    main_parts, others = TINY.to_run([0], quick=False, worlds=True)
    assert {run.seed for run in plan(main_parts)} == {0}
    assert len(plan(others)) == 4
    assert TINY.to_run(None, quick=False, worlds=False)[1] == []
    (short,), _ = TINY.to_run(None, quick=True, worlds=True)
    assert (short.movements, short.seeds, short.configurations) == (60, (0, 1), ("modern",))


def test_a_chapter_that_is_not_there_is_answered_with_those_that_are(
    capsys: pytest.CaptureFixture[str],
) -> None:
    assert main(["reproduce", "thowing"]) == 2
    said = capsys.readouterr().err
    assert "Did you mean 'throwing'?" in said
    assert "Known: " + ", ".join(sorted(REPRODUCTIONS)) in said


@pytest.mark.parametrize("it", REPRODUCTIONS.values(), ids=REPRODUCTIONS)
def test_a_declaration_runs_what_its_claims_and_figures_need(it: Reproduction) -> None:
    main_parts, worlds = it.to_run(None, quick=False, worlds=True)
    runs = plan([*main_parts, *worlds])
    assert {run.seed for run in runs} <= {*range(1000)}
    learners = {run.learner for run in runs}
    assert it.chapters
    for chapter in it.chapters:
        assert chapter is CHAPTERS[chapter.name]
        for (world, settings), needed in chapter.sweeps.items():
            made = {
                run.learner
                for run in runs
                if run.path("").name.startswith(f"{world}-{run.learner.replace(':', '-')}-")
                and run.configuration in ("modern", f"modern,{settings}")
                and bool(settings) == ("," in run.configuration)
            }
            assert {*needed} <= made, (world, settings)
    for drawing in it.drawings:
        assert {*drawing.learners} <= learners
    names = [drawing.name for drawing in it.drawings]
    assert len(names) == len({*names})
    short = plan(it.to_run(None, quick=True, worlds=False)[0])
    assert sum(run.movements for run in short) < sum(run.movements for run in plan(main_parts)) / 8
