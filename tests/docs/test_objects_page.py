"""The page on recognising objects: its lines run, and its constants are those of the code."""

import re
from dataclasses import fields
from pathlib import Path

import pytest

from sgim.environments.objects import Nuisances
from sgim.recognition import Eye, Settings

PAGE = (Path(__file__).parent.parent.parent / "docs" / "objects.md").read_text("utf-8")


def test_its_lines_print_what_it_shows(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.chdir(tmp_path)
    code, shown = re.findall(r"```python\n(.*?)```\n\n```text\n(.*?)```", PAGE, re.DOTALL)[0]
    exec(code, {})
    assert capsys.readouterr().out == shown


def test_it_has_the_constants_of_the_recogniser() -> None:
    for part, names in ((Settings(), [f.name for f in fields(Settings)]), (Eye(), vars(Eye()))):
        for name in names:
            assert f"`{type(part).__name__}.{name}`" in PAGE
            assert re.search(rf"{name}`[^\n]*\b{getattr(part, name):g}\b", PAGE), name


def test_it_has_every_nuisance() -> None:
    for field in fields(Nuisances):
        assert f"`{field.name}`" in PAGE
    usual = Nuisances()
    for share in (usual.gain, usual.white_balance, usual.bar, usual.bar_probability, usual.zoom):
        assert f"{100 * share:.0f} %" in PAGE
