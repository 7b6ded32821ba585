"""The parts of a report that say what was found: verdicts, learners, figures, worlds."""

from __future__ import annotations

from collections import Counter
from collections.abc import Sequence

import numpy as np

from sgim.claims.claim import Verdict, Verdicts, Word
from sgim.claims.components import Finding
from sgim.claims.plausible import Plausible
from sgim.claims.words import effect_words, holm_words, p_words
from sgim.experiments import EXPERIMENTS
from sgim.reproductions.html import paragraph, table, tag, text
from sgim.reproductions.result import Picture, Section
from sgim.reproductions.svg import inline
from sgim.runs.comparison import Comparison
from sgim.statistics.words import interval, number

SIGNS: dict[Word, str] = {"reproduced": "✓", "not shown": "?", "contradicted": "✗", "no runs": "–"}
"""Verdict → its sign, for who does not see its colour."""


def chip(word: Word) -> str:
    """A verdict in its colour, with its sign."""
    sign = tag("span", SIGNS[word], aria_hidden="true")
    return tag("span", sign, f" {text(word)}", class_=f"chip {word.replace(' ', '-')}")


def tally(verdicts: Sequence[Verdicts]) -> str:
    """How many claims have which verdict."""
    counts = Counter(verdict.word for table in verdicts for verdict in table.verdicts)
    chips = [f"{chip(word)} {counts[word]}" for word in SIGNS if counts[word]]
    return tag("p", " &ensp; ".join(chips), class_="tally")


def verdict_table(verdicts: Verdicts) -> str:
    """The claims of a chapter in one world, each with the test that decides it."""
    world = verdicts.world
    columns = ["claim", "verdict", "effect [95 %]", "p", "p after Holm", "n", "decided by"]
    rows = [_verdict_row(verdict) for verdict in verdicts.verdicts]
    title = f"{verdicts.chapter.title}: {world.experiment}, {world.configuration}, after "
    title += f"{world.movements} movements"
    found = table(columns, rows, title, "claims")
    tests = [_tests(verdict) for verdict in verdicts.verdicts if verdict.findings]
    if tests:
        summary = tag("summary", "Every test of every claim")
        found += tag("details", summary, *tests)
    return found


def _verdict_row(verdict: Verdict) -> list[str]:
    claim = verdict.claim
    name = tag("b", text(claim.id)) + " " + tag("span", text(claim.sentence))
    if claim.by_construction:
        name += tag("small", "It holds almost by construction.")
    word = chip(verdict.word)
    if verdict.p_holm is None:
        return [name, word, "–", "–", "–", "–", text(f"needs {', '.join(verdict.needs)}")]
    f = verdict.deciding
    cells = (effect_words(f), p_words(f.p), holm_words(verdict), f.runs, f.component)
    return [name, word, *map(text, cells)]


def _tests(verdict: Verdict) -> str:
    columns = ["test", "one", "other", "effect [95 %]", "p", "n", "direction"]
    rows = [_test_row(finding) for finding in verdict.findings]
    reading = (
        [tag("p", text(verdict.claim.reading), class_="note")] if verdict.claim.reading else []
    )
    head = tag("h4", text(f"{verdict.claim.id}: {verdict.claim.sentence}"))
    return head + "".join(reading) + table(columns, rows, class_="tests")


def _test_row(f: Finding) -> list[str]:
    one, other = (number(float(np.median(x))) if len(x) else "–" for x in (f.one, f.other))
    cells = (f.component, one, other, effect_words(f), p_words(f.p), f.runs, f"{f.direction:+.2f}")
    return [text(cell) for cell in cells]


def plausible_table(plausible: Plausible) -> str:
    """In how many plausible worlds each claim holds, and what it is in each."""
    columns = ["claim", "holds in", *plausible.worlds]
    rows = []
    for count in plausible.counts:
        holds = f"{count.holds} of {len(count.words)}" if count.words else "no runs"
        words: list[Word] = [count.words.get(name, "no runs") for name in plausible.worlds]
        cells = [
            tag("span", SIGNS[w], class_=f"mark {w.replace(' ', '-')}", title=w) for w in words
        ]
        rows.append([tag("b", text(count.claim.id)), text(holds), *cells])
    title = f"{plausible.chapter.title}, {plausible.configuration}: {SIGNS['reproduced']} holds"
    others = ", ".join(f"{SIGNS[word]} {word}" for word in SIGNS if word != "reproduced")
    return tag("p", text(f"{title}, {others}"), class_="note") + table(
        columns, rows, class_="worlds"
    )


def learner_table(found: Comparison) -> str:
    """Each learner by itself, and against the reference."""
    contrasts = {contrast.name: contrast for contrast in found.contrasts}
    experiment = EXPERIMENTS.get(found.experiment or "")
    unit = f" ({experiment.unit})" if experiment else ""
    columns = ["learner", "runs", "error, IQM [95 %]", "mean over movements, IQM [95 %]"]
    columns += ["ratio [95 %]", "p after Holm", "verdict"]
    rows = []
    for group in found.groups:
        cells = [str(len(group.runs)), interval(group.middle), interval(group.area)]
        contrast = contrasts.get(group.name)
        if contrast is None:
            cells += ["–", "–", "the reference" if contrasts else "–"]
        else:
            cells += [interval(contrast.ratio), p_words(contrast.p_holm), contrast.verdict]
        rows.append([text(group.name), *map(text, cells)])
    title = f"{found.kind} error{unit} after {found.movements[-1]:.0f} movements"
    if found.reference is not None:
        title += f"; ratios are to {found.reference}, equivalent within {found.margin:.0%}"
    return table(columns, rows, title, "learners")


def figure(picture: Picture, prefix: str) -> str:
    """A figure with its title and caption: one drawing for wide screens, one for narrow ones."""
    drawing = picture.drawing
    head = tag("b", text(drawing.title)) + ". " + text(drawing.caption)
    if picture.trouble:
        return tag("figure", paragraph(f"Not drawn: {picture.trouble}"), tag("figcaption", head))
    title = text(drawing.title)
    if picture.narrow is None:
        drawn = tag("div", inline(picture.wide, title, prefix, "drawn"), class_="scrolls")
    else:
        drawn = inline(picture.wide, title, f"{prefix}-w", "drawn only-wide")
        drawn += inline(picture.narrow, title, f"{prefix}-n", "drawn only-narrow")
    return tag("figure", drawn, tag("figcaption", head), id=prefix)


def section(found: Section, place: int) -> str:
    """All there is to say of one experiment in one configuration."""
    anchor = f"s{place}"
    parts = [tag("h2", text(found.title), id=anchor)]
    if found.verdicts:
        parts += [tag("h3", "Verdicts", id=f"{anchor}-verdicts"), tally(found.verdicts)]
        parts += [verdict_table(verdicts) for verdicts in found.verdicts]
    if found.comparison is not None:
        parts += [tag("h3", "Learners", id=f"{anchor}-learners"), learner_table(found.comparison)]
    if found.pictures:
        parts.append(tag("h3", "Figures", id=f"{anchor}-figures"))
        parts += [figure(p, f"{anchor}-{p.drawing.name}") for p in found.pictures]
    notes = [*found.notes, *(note for verdicts in found.verdicts for note in verdicts.notes)]
    parts += [tag("p", tag("b", "Note: "), text(n), class_="note") for n in dict.fromkeys(notes)]
    return tag("section", *parts)
