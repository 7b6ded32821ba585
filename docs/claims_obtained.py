"""The directive ``claims-obtained``: tables of verdicts from ``docs/results``, by chapter.

A chapter's ``NAME.json`` is what ``sgim claims NAME --runs DIR --json`` printed; its ``NAME.toml``
says which commands made it, with what, and for each claim that did not hold why.
"""

import json
import tomllib
from collections.abc import Iterable, Sequence
from pathlib import Path
from typing import Any

import numpy as np
from docutils import nodes
from sphinx.util.docutils import SphinxDirective

from sgim.claims import CHAPTERS
from sgim.statistics import Estimate
from sgim.statistics.words import interval

RESULTS = Path(__file__).parent / "results"
COLUMNS = ("claim", "verdict", "effect [95 %]", "p after Holm", "n", "decided by")


def read_results(folder: Path = RESULTS) -> dict[str, tuple[dict[str, Any], dict[str, Any]]]:
    """Chapter → its verdicts, and what is said of them; in the order of the chapters."""
    return {
        name: (
            json.loads((folder / f"{name}.json").read_text("utf-8")),
            tomllib.loads((folder / f"{name}.toml").read_text("utf-8")),
        )
        for name in CHAPTERS
        if (folder / f"{name}.json").exists()
    }


def main_tables(chapter: str, found: dict[str, Any]) -> list[dict[str, Any]]:
    """The tables of the experiment itself, in configurations without settings that differ."""
    return [
        table
        for table in found["tables"]
        if table["experiment"] == CHAPTERS[chapter].experiment and "," not in table["configuration"]
    ]


def verdict_rows(chapter: str, table: dict[str, Any]) -> list[list[str]]:
    """The cells of a table of verdicts."""
    sentences = {claim.id: claim.sentence for claim in CHAPTERS[chapter].claims}
    rows = []
    for claim in table["claims"]:
        mark = " (almost by construction)" if claim["by_construction"] else ""
        begin = [f"{claim['id']}: {sentences[claim['id']]}", claim["verdict"] + mark]
        test = claim["deciding"]
        if test is None:
            rows.append([*begin, "–", "–", "–", f"needs {', '.join(claim['needs'])}"])
            continue
        p = "–" if claim["verdict"] == "contradicted" else f"{claim['p_holm']:.2g}"
        rows.append([*begin, effect(test), p, test["n"], test["component"]])
    return rows


def effect(test: dict[str, Any]) -> str:
    """The effect of a test in words."""
    numbers = [np.nan if x is None else x for x in test["effect"].values()]
    if test["unit"] == "error":
        return f"× {interval(Estimate(*map(np.asarray, numbers)))}"
    return f"{interval(Estimate(*(np.asarray(100 * x) for x in numbers)), '+')} points"


class ClaimsObtained(SphinxDirective):
    """All chapters that have results."""

    def run(self) -> list[nodes.Node]:
        self.env.note_dependency(__file__)
        sections: list[nodes.Node] = []
        for name, (found, said) in read_results().items():
            for ending in ("json", "toml"):
                self.env.note_dependency(str(RESULTS / f"{name}.{ending}"))
            section = nodes.section(ids=[f"obtained-{name}"])
            section += nodes.title(text=CHAPTERS[name].title)
            section += nodes.paragraph(text=said["made"])
            commands = "\n".join(said["commands"])
            section += nodes.literal_block(commands, commands, language="sh")
            for table in main_tables(name, found):
                section += self._table(name, table, said.get("reasons", {}))
            for plausible in found["plausible"]:
                section += self._worlds(plausible)
            sections.append(section)
        return sections

    def _table(self, chapter: str, table: dict[str, Any], reasons: dict[str, Any]) -> nodes.section:
        configuration = table["configuration"]
        section = nodes.section(ids=[f"obtained-{chapter}-{configuration}"])
        section += nodes.title(text=f"{table['experiment']}, {configuration}")
        seeds = sorted({*table["learners"].values()})
        section += nodes.paragraph(
            text=f"After {table['at']} movements; seeds {' and '.join(seeds)}."
        )
        section += table_of(COLUMNS, verdict_rows(chapter, table))
        said = reasons.get(configuration, {})
        if said:
            section += nodes.rubric(text="What did not hold, and why")
            section += nodes.bullet_list(
                "",
                *(
                    nodes.list_item(
                        "",
                        nodes.paragraph("", "", nodes.strong(text=claim), nodes.Text(f": {why}")),
                    )
                    for claim, why in said.items()
                ),
            )
        for note in table["notes"]:
            section += nodes.paragraph("", "", nodes.emphasis(text=f"Note: {note}."))
        return section

    def _worlds(self, plausible: dict[str, Any]) -> nodes.section:
        chapter, configuration = plausible["chapter"], plausible["configuration"]
        section = nodes.section(ids=[f"obtained-{chapter}-{configuration}-worlds"])
        section += nodes.title(text=f"{configuration}, over plausible worlds")
        worlds = ", ".join(plausible["worlds"])
        section += nodes.paragraph(
            text=f"A claim holds if all its tests point its way, p < .05 before correction. The "
            f"worlds: {worlds}."
        )
        rows = []
        for claim in plausible["claims"]:
            elsewhere = (f"{word}: {', '.join(n)}" for word, n in claim["elsewhere"].items())
            holds = f"{claim['holds']} of {claim['worlds']}"
            rows.append([claim["id"], holds, "; ".join(elsewhere)])
        section += table_of(("claim", "holds in", "elsewhere"), rows)
        return section


def table_of(columns: Sequence[str], rows: Iterable[Sequence[str]]) -> nodes.table:
    """A table of text."""
    group = nodes.tgroup(cols=len(columns))
    group += [nodes.colspec(colwidth=1) for _ in columns]
    group += nodes.thead("", _row(columns))
    group += nodes.tbody("", *map(_row, rows))
    return nodes.table("", group)


def _row(cells: Iterable[str]) -> nodes.row:
    return nodes.row("", *(nodes.entry("", nodes.paragraph(text=cell)) for cell in cells))


def setup(app: Any) -> dict[str, bool]:
    app.add_directive("claims-obtained", ClaimsObtained)
    return {"parallel_read_safe": True, "parallel_write_safe": True}
