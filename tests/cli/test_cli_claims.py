"""Claims from the command line, over journals of real runs."""

import io
import json
import shutil
from pathlib import Path

import numpy as np
import pytest

from sgim.claims import CHAPTERS, Claim, report
from sgim.claims.claim import Chapter
from sgim.claims.components import lower
from sgim.claims.measures import Error
from sgim.claims.throwing import THROWING
from sgim.cli import main
from sgim.cli.claims_text import print_report
from sgim.runs.summary import find_journals, read_run

LEARNERS = "sgim-acts,random,uniform-choice,round-robin"
SWEEP = f"--learners {LEARNERS} --seeds 0-5 --movements 80 --jobs 1 --out"


@pytest.fixture(scope="module")
def swept(tmp_path_factory: pytest.TempPathFactory) -> Path:
    folder = tmp_path_factory.mktemp("swept")
    assert main(["sweep", "throwing", *SWEEP.split(), str(folder)]) == 0
    return folder


@pytest.fixture(scope="module")
def worlds(swept: Path, tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The runs, and some of two variants."""
    folder = tmp_path_factory.mktemp("worlds")
    shutil.copytree(swept, folder, dirs_exist_ok=True)
    few = SWEEP.replace("0-5", "0-1").split()
    assert main(["sweep", "throwing-5", *few, str(folder)]) == 0
    settings = ["--configuration", "modern,prior=0.1"]
    assert main(["sweep", "throwing", *settings, *few, str(folder)]) == 0
    return folder


def test_without_runs_the_claims_are_listed_with_their_tests_and_the_sweep(sgim) -> None:
    said = sgim("claims", "throwing")
    assert said.code == 0
    for claim in THROWING.claims:
        assert claim.sentence.split()[0] in said.out
        assert all(f"  {component}\n" in said.out for component in claim.components)
    assert "sgim sweep throwing --learners sgim-acts,random,sagg-riac" in said.out
    every = sgim("claims").out
    assert said.out in every
    assert all(f"{name}: {one.title}" in every for name, one in CHAPTERS.items())


def test_a_folder_of_journals_is_a_table_of_verdicts(sgim, swept: Path) -> None:
    said = sgim("claims", "--runs", swept)
    assert said.code == 0
    lines = said.out.splitlines()
    assert lines[0].startswith("throwing, modern, at 80 movements")
    assert lines[2].split()[:2] == ["claim", "verdict"]
    rows = {line.split()[0]: line for line in lines[3:16]}
    assert [*rows] == [claim.id for claim in THROWING.claims]
    assert "no runs" in rows["T3"]
    assert "needs sagg-riac, mimicry:T1" in rows["T3"]
    assert "needs demonstrations-first" in rows["S2"]
    assert "total error: sgim-acts < " in rows["S1"]
    assert "6 pairs" in rows["S1"]
    assert "plausible" not in said.out
    assert "\x1b" not in said.out
    assert said.err == ""


def test_json_has_the_numbers_that_the_journals_have(sgim, swept: Path) -> None:
    facts = json.loads(sgim("claims", "throwing", "--runs", swept, "--json", "--details").out)
    (table,) = facts["tables"]
    claims = {claim["id"]: claim for claim in table["claims"]}
    runs = [read_run(swept / f"throwing-sgim-acts-{seed}.sgim") for seed in range(6)]
    first, second = claims["S1"]["components"]
    assert first["one"] == [run.evaluations[-1].errors["total"] for run in runs]
    assert second["learners"] == ["sgim-acts", "round-robin"]
    (grows,) = claims["T6"]["components"]
    for name, quarter in (("one", 0), ("other", 3)):
        shares = [run.choices[quarter]["modes"].get("autonomous", 0.0) for run in runs]
        assert grows[name] == pytest.approx(shares)
    (seldom,) = claims["T7"]["components"]
    modes = [run.openings.modes for run in runs]
    assert seldom["one"] == pytest.approx([np.mean([m == "mimic T3" for m in n]) for n in modes])
    assert claims["T3"]["verdict"] == "no runs"
    assert claims["T3"]["p"] is None


def test_details_have_every_sentence_and_test(sgim, swept: Path) -> None:
    said = sgim("claims", "--runs", swept, "--details").out
    assert "T3 is seldom mimicked." in said
    assert "(Seldom: less than an even share" in said
    assert "total error: sgim-acts < uniform-choice" in said
    assert "total error: sgim-acts < round-robin" in said


def test_variants_are_tables_of_their_own_and_counted_together(sgim, worlds: Path) -> None:
    said = sgim("claims", "--runs", worlds).out
    for title in ("throwing, modern,", "throwing-5, modern,", "throwing, modern,prior=0.1,"):
        assert f"{title} at 80 movements" in said
    assert "in 3 plausible worlds: throwing, throwing-5, throwing with prior=0.1" in said
    (row,) = [line for line in said.splitlines() if line.split()[:1] == ["S1"] and " of 3" in line]
    assert "throwing-5" in row
    facts = json.loads(sgim("claims", "--runs", worlds, "--json").out)
    assert facts["plausible"][0]["configuration"] == "modern"
    assert len(facts["plausible"][0]["claims"]) == len(THROWING.claims)


def test_one_configuration_can_be_chosen_alone_or_with_its_variants(sgim, worlds: Path) -> None:
    alone = sgim("claims", "--runs", worlds, "--configuration", "modern,prior=0.1").out
    assert "throwing, modern,prior=0.1, at 80 movements" in alone
    assert "throwing, modern, at" not in alone
    assert sgim("claims", "--runs", worlds, "--configuration", "modern").out == (
        sgim("claims", "--runs", worlds).out
    )


def test_runs_of_which_nothing_is_claimed_are_noted(sgim, tmp_path: Path, swept: Path) -> None:
    mixed = tmp_path / "mixed"
    shutil.copytree(swept, mixed)
    words = "run arm --learner random --movements 80 --journal"
    assert sgim(*words.split(), mixed / "arm.sgim").code == 0
    assert "no claims are about arm: left out 1 run" in sgim("claims", "--runs", mixed).out
    (tmp_path / "arms").mkdir()
    shutil.move(mixed / "arm.sgim", tmp_path / "arms")
    said = sgim("claims", "--runs", "arms")
    assert said.code == 2
    known = ", ".join(sorted(CHAPTERS))
    assert f"only runs of arm, and claims about {known}; make some" in said.err


@pytest.mark.parametrize(
    ("words", "code", "hint"),
    [
        (["throwin", "--runs", "SWEPT"], 2, "Did you mean 'throwing'?"),
        (["--runs", "SWEPT", "--configuration", "moder"], 2, "Did you mean 'modern'?"),
        (["--runs", "SWEPT", "--at", "70"], 2, "there are some at 20, 40, 60, 80"),
        (["--runs", "SWEPT", "--seed", "-1"], 2, "seed is -1, expected 0 or more"),
        (["--runs", "nowhere"], 1, "there is no journal nowhere"),
    ],
)
def test_a_mistake_is_named_with_what_to_do(
    sgim, swept: Path, words: list[str], code: int, hint: str
) -> None:
    said = sgim("claims", *(str(swept) if word == "SWEPT" else word for word in words))
    assert said.code == code
    assert hint in said.err
    assert said.out == ""


def test_claims_can_be_decided_at_an_earlier_evaluation(sgim, swept: Path) -> None:
    words = ["claims", "--runs", swept, "--at", "40"]
    (table,) = json.loads(sgim(*words, "--json", "--details").out)["tables"]
    run = read_run(swept / "throwing-sgim-acts-0.sgim")
    claims = {claim["id"]: claim for claim in table["claims"]}
    assert claims["S1"]["components"][0]["one"][0] == run.evaluations[2].errors["total"]


def test_what_holds_almost_by_construction_is_marked_and_a_terminal_has_a_table(
    swept: Path,
) -> None:
    class Terminal(io.StringIO):
        def isatty(self) -> bool:
            return True

    component = lower(Error("sgim-acts"), Error("random"))
    claim = Claim("X1", "It is.", (component,), by_construction=True)
    found = report(find_journals([swept]), [Chapter("x", "X", "throwing", (claim,))])
    plain, terminal = io.StringIO(), Terminal()
    print_report(found, plain, details=False)
    print_report(found, terminal, details=True)
    assert "* holds almost by construction" in plain.getvalue()
    assert f"{found.verdicts[0].verdicts[0].word} *" in plain.getvalue()
    assert "───" in terminal.getvalue()
    assert found.as_json(details=False)["tables"][0]["claims"][0]["by_construction"] is True


def test_every_chapter_is_about_an_experiment_with_learners_that_exist() -> None:
    from sgim.experiments import EXPERIMENTS

    for chapter in CHAPTERS.values():
        assert EXPERIMENTS[chapter.experiment].variant_of is None
        for (name, settings), learners in chapter.sweeps.items():
            configuration = f"modern,{settings}" if settings else "modern"
            for learner in learners:
                EXPERIMENTS[name].learner(learner, configuration=configuration)


def test_runs_of_other_worlds_that_a_chapter_needs_are_proposed(sgim) -> None:  # type: ignore[no-untyped-def]
    said = sgim("claims", "fishing").out
    assert "sgim sweep fishing-wide --learners sgim-d:D3,sagg-riac --seeds" in said
    assert "--configuration modern,demonstration_every=80" in said
