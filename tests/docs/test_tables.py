"""What the tables of the documentation say is true."""

from dataclasses import fields
from inspect import signature
from pathlib import Path

import pytest

from sgim.algorithms import ALGORITHMS
from sgim.configurations import CONFIGURATIONS, Configuration
from sgim.mixture_settings import MixtureSettings
from sgim.outcome.expected_gain import ExpectedGain
from sgim.outcome.region_tree import RegionTree
from sgim.policy import KernelMean, LocalModel, Reliable
from sgim.policy.local_search import LocalSearch
from sgim.policy.model import NearestModel
from sgim.policy.nelder_mead import NelderMeadSearch
from sgim.policy.simple import NoisyNearest

ROOT = Path(__file__).parent.parent.parent


def table(page: str, first_cell: str) -> dict[str, list[str]]:
    """The rows of the page's table whose head begins with this cell, by their first cell."""
    text = (ROOT / page).read_text("utf-8")
    lines = iter(text[text.index(f"\n| {first_cell} |") + 1 :].splitlines()[2:])
    rows = {}
    for line in lines:
        if not line.startswith("|"):
            break
        cells = [cell.strip() for cell in line.strip("|").split("|")]
        rows[cells[0].strip("`")] = [cell.strip("`") for cell in cells[1:]]
    return rows


@pytest.mark.parametrize("name", list(CONFIGURATIONS))
def test_the_page_of_configurations_has_every_constant_as_it_is(name: str) -> None:
    of_mixtures = [field.name for field in fields(MixtureSettings)]
    apart = {"name", *of_mixtures}
    others = [field.name for field in fields(Configuration) if field.name not in apart]
    column = list(CONFIGURATIONS).index(name)
    for first_cell, names in (("constant", others), ("constant of mixtures", of_mixtures)):
        rows = table("docs/configurations.md", first_cell)
        assert list(rows) == names
        shown = {constant: cells[column] for constant, cells in rows.items()}
        assert shown == {
            constant: str(getattr(CONFIGURATIONS[name], constant)) for constant in names
        }


PARTS = (
    NearestModel,
    Reliable,
    KernelMean,
    LocalModel,
    NelderMeadSearch,
    LocalSearch,
    NoisyNearest,
    RegionTree,
    ExpectedGain,
)


def test_the_page_of_configurations_has_the_constants_of_the_parts() -> None:
    parts = {part.__name__: part for part in PARTS}
    for name, (shown,) in table("docs/configurations.md", "parameter").items():
        part, constant = name.split(".")
        default = signature(parts[part]).parameters.get(constant)
        value = getattr(parts[part], constant) if default is None else default.default
        assert shown == str(value), name


@pytest.mark.parametrize("page", ["README.md", "docs/algorithms.md"])
def test_tables_of_algorithms_have_every_algorithm(page: str) -> None:
    assert list(table(page, "name")) == list(ALGORITHMS)
