"""The report of a reproduction: one HTML file that needs no other."""

from __future__ import annotations

from collections.abc import Iterable
from importlib.resources import files

from sgim.reproductions.html import paragraph, table, tag, text
from sgim.reproductions.result import Result
from sgim.reproductions.sections import plausible_table, section, tally
from sgim.runs.sweep_run import seed_words

_HOW = (
    "A claim is reproduced if all its tests point its way and its p-value, the largest of theirs, "
    "is under .05 after Holm's correction for the claims of the table; not shown if that p is "
    "not; contradicted if a test points the other way. Shown is the test that decides. Effects "
    "are ratios (×) of errors, or differences of shares in percentage points, of interquartile "
    "means, with 95 % bootstrap intervals; n is how many runs, or pairs of runs with the same "
    "seed, were compared."
)
_QUICK = (
    "This is a first look with few seeds and short runs: verdicts may be others after runs of "
    "full length."
)


def page(result: Result, made: str) -> str:
    """The report.

    Args:
        result: What was found.
        made: When, as it is to be shown.
    """
    it = result.reproduction
    parts = [_header(result, made)]
    parts += [section(found, i) for i, found in enumerate(result.sections, 1)]
    if result.plausible:
        about = (
            "The thesis leaves constants open. Each claim again where they are set otherwise. It "
            "holds in a world if all its tests point its way with p < .05, there not corrected for "
            "the other claims, since a world by itself has few seeds."
        )
        heading = tag("h2", "Plausible worlds", id="worlds")
        tables = [plausible_table(plausible) for plausible in result.plausible]
        parts.append(tag("section", heading, paragraph(about), *tables))
    parts += [_runs(result), _failures(result), _again(result)]
    style = files("sgim.reproductions").joinpath("report.css").read_text("utf-8")
    head = tag(
        "head",
        '<meta charset="utf-8">',
        '<meta name="viewport" content="width=device-width, initial-scale=1">',
        '<meta name="color-scheme" content="light dark">',
        tag("title", text(f"{it.title}: what became of the claims")),
        f"<style>{style}</style>",
    )
    body = tag("body", _contents(result), tag("main", *(part for part in parts if part)))
    return f'<!doctype html>\n<html lang="en">{head}{body}</html>\n'


def _header(result: Result, made: str) -> str:
    it = result.reproduction
    movements = sorted({part.movements for part in result.parts if part.movements})
    asked = f" {', '.join(map(str, movements))} movements each." if movements else ""
    done = len(result.runs) - len(result.failed)
    parts = [
        tag("p", text(f"A reproduction of: {it.source}"), class_="source"),
        tag("h1", text(it.title)),
        paragraph(it.summary),
    ]
    if result.quick:
        parts.append(tag("p", text(_QUICK), class_="warning"))
    for found in result.sections:
        if found.verdicts:
            parts.append(tag("p", tag("b", text(found.title)), class_="of"))
            parts.append(tally(found.verdicts))
    failed = f", {len(result.failed)} failed" if result.failed else ""
    said = f"{done} of {len(result.runs)} runs finished{failed}.{asked} Made {made}."
    parts += [paragraph(said), tag("p", text(_HOW), class_="note")]
    return tag("header", *parts, id="top")


def _contents(result: Result) -> str:
    items = [_link("top", "What was found")]
    for i, found in enumerate(result.sections, 1):
        below = []
        if found.verdicts:
            below.append(_link(f"s{i}-verdicts", "Verdicts"))
        if found.comparison is not None:
            below.append(_link(f"s{i}-learners", "Learners"))
        below += [_link(f"s{i}-{p.drawing.name}", p.drawing.title) for p in found.pictures]
        items.append(_link(f"s{i}", found.title, below))
    if result.plausible:
        items.append(_link("worlds", "Plausible worlds"))
    items.append(_link("runs", "What was run"))
    if result.failed:
        items.append(_link("failed", "Runs that failed"))
    items.append(_link("again", "Run it again"))
    return tag("nav", tag("details", tag("summary", "Contents"), tag("ol", *items), open=True))


def _link(anchor: str, words: str, below: Iterable[str] = ()) -> str:
    inner = "".join(below)
    return tag("li", tag("a", text(words), href=f"#{anchor}"), tag("ol", inner) if inner else "")


def _runs(result: Result) -> str:
    columns = ["experiments", "learners", "configurations", "seeds", "movements"]
    rows = [
        [
            text(", ".join(part.experiments)),
            text(", ".join(part.learners)),
            text("; ".join(part.configurations)),
            text(seed_words(part.seeds)),
            text(part.movements or "the experiment's"),
        ]
        for part in result.parts
    ]
    parts = [tag("h2", "What was run", id="runs"), tag("pre", text(result.command))]
    parts += [table(columns, rows, class_="runs")]
    made = [
        tag("li", text(f"{facts} ({count} processes' work)"))
        for facts, count in result.versions.items()
    ]
    if made:
        parts += [paragraph("Made with:"), tag("ul", *made)]
    return tag("section", *parts)


def _failures(result: Result) -> str:
    if not result.failed:
        return ""
    parts = [
        tag("h2", "Runs that failed", id="failed"),
        paragraph("They are left out of all tables and figures."),
    ]
    for run in result.failed:
        times = f", tried {run.attempts} times" if run.attempts > 1 else ""
        summary = tag("summary", text(f"{run.learner}, seed {run.seed} ({run.path.name}){times}"))
        parts.append(tag("details", summary, tag("pre", text(run.error.strip()))))
    return tag("section", *parts)


def _again(result: Result) -> str:
    name = result.reproduction.name
    lines = [result.command, f"sgim claims {name} --runs runs --details", "sgim compare runs"]
    said = (
        "The first of these commands makes this folder again; what is in it already is not run "
        "again, but taken as it is. The others, given in this folder, print the verdicts and "
        "compare learners. Runs are the same to the last bit with the same versions on the same "
        "kind of processor."
    )
    heading = tag("h2", "Run it again", id="again")
    return tag("section", heading, tag("pre", text("\n".join(lines))), paragraph(said))
