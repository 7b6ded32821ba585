from pathlib import Path

import numpy as np
import pytest

from sgim.environments import tables
from sgim.environments.tables import read_table, write_table
from sgim.errors import SgimError


@pytest.fixture
def folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    monkeypatch.setattr(tables, "files", lambda package: tmp_path)
    (tmp_path / "data").mkdir()
    return tmp_path / "data"


def test_numbers_come_back_exactly_as_written(folder: Path) -> None:
    rows = np.random.default_rng(0).normal(size=(5, 3))
    write_table(folder / "a.csv", "two\nlines", ["x", "y", "z"], rows)
    np.testing.assert_array_equal(read_table("a.csv"), rows)
    assert (folder / "a.csv").read_text().startswith("# two\n# lines\nx,y,z\n")


def test_numbers_can_be_rounded(folder: Path) -> None:
    write_table(folder / "a.csv", "", ["x"], [[1 / 3]], decimals=2)
    assert read_table("a.csv") == [[0.33]]


def test_a_table_that_is_not_there_is_named() -> None:
    with pytest.raises(SgimError, match=r"no table 'absent\.csv'"):
        read_table("absent.csv")


@pytest.mark.parametrize("body", ["1,2\n3", "1,word", "1,nan", ""])
def test_a_damaged_table_is_refused(folder: Path, body: str) -> None:
    (folder / "a.csv").write_text(f"# made by hand\nx,y\n{body}\n")
    with pytest.raises(SgimError, match=r"'a\.csv' is damaged"):
        read_table("a.csv")
