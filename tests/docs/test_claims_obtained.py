"""The page of claims as obtained shows what is kept, and says why each failed claim failed."""

import sys
from pathlib import Path

import pytest

from sgim.claims import CHAPTERS

DOCS = Path(__file__).parent.parent.parent / "docs"
sys.path.insert(0, str(DOCS))

from claims_obtained import main_tables, read_results, verdict_rows  # noqa: E402

RESULTS = read_results()


def test_there_are_results_and_each_is_of_a_chapter() -> None:
    assert {"throwing", "hockey"} <= {*RESULTS}
    endings = {".json", ".toml"}
    kept = {(path.stem, path.suffix) for path in (DOCS / "results").iterdir()}
    assert kept == {(name, ending) for name in RESULTS for ending in endings}


@pytest.mark.parametrize("name", RESULTS)
def test_results_have_every_claim_that_is_declared_and_a_row_for_each(name: str) -> None:
    found, _ = RESULTS[name]
    tables = main_tables(name, found)
    assert tables
    for table in tables:
        assert table["chapter"] == name
        assert [claim["id"] for claim in table["claims"]] == [c.id for c in CHAPTERS[name].claims]
        rows = verdict_rows(name, table)
        assert [row[1].split(" (")[0] for row in rows] == [c["verdict"] for c in table["claims"]]
        for row, claim in zip(rows, table["claims"], strict=True):
            assert len(row) == 6
            if claim["verdict"] == "reproduced":
                assert claim["p_holm"] < 0.05
                assert float(row[3]) < 0.05


@pytest.mark.parametrize("name", RESULTS)
def test_what_did_not_hold_has_a_reason_and_what_held_has_none(name: str) -> None:
    found, said = RESULTS[name]
    assert said["made"]
    assert any(command.startswith("sgim claims") for command in said["commands"])
    reasons = {(c, claim) for c, of in said["reasons"].items() for claim in of}
    failed = {
        (table["configuration"], claim["id"])
        for table in main_tables(name, found)
        for claim in table["claims"]
        if claim["verdict"] in ("not shown", "contradicted")
    }
    assert reasons == failed
