"""What a claim is, and how it is decided in one world."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any, Literal

from sgim.claims.components import Component, Finding
from sgim.claims.measures import Error, learners_of
from sgim.claims.world import ReadRun, World, apart
from sgim.runs.contrasts import LEVEL
from sgim.runs.summary import read_run
from sgim.runs.sweep_run import seed_words
from sgim.statistics import holm, least_pairs
from sgim.streams import Streams

Word = Literal["reproduced", "not shown", "contradicted", "no runs"]


@dataclass(frozen=True)
class Claim:
    """A sentence, and the tests that must all hold for it to hold.

    Attributes:
        id: Its short name, such as ``T1``.
        sentence: What is claimed.
        components: The tests.
        reading: How words that leave room were read; empty if none do.
        by_construction: Whether it holds almost by construction, so that to find it holding says
            little.
    """

    id: str
    sentence: str
    components: tuple[Component, ...]
    reading: str = ""
    by_construction: bool = False

    @property
    def learners(self) -> list[str]:
        """Whose runs it needs, each once."""
        return list(dict.fromkeys(x for part in self.components for x in part.learners))


@dataclass(frozen=True)
class Chapter:
    """The claims about one experiment, whose p-values are corrected together.

    Attributes:
        name: Its name on the command line.
        title: What it is about, and where the thesis has it.
        experiment: Name of the experiment; its variants count as plausible worlds.
        claims: The claims.
        read_chooser: How a run is read whose choices the claims are about.
    """

    name: str
    title: str
    experiment: str
    claims: tuple[Claim, ...]
    read_chooser: ReadRun = read_run

    @property
    def learners(self) -> list[str]:
        """Whose runs its claims need, each once."""
        return list(dict.fromkeys(x for claim in self.claims for x in claim.learners))

    @property
    def sweeps(self) -> dict[tuple[str, str], list[str]]:
        """Experiment, and settings that differ from the configuration → whose runs are needed."""
        found: dict[tuple[str, str], list[str]] = {}
        for learner in self.learners:
            name, experiment, settings = apart(learner)
            found.setdefault((experiment or self.experiment, settings), []).append(name)
        return found

    @property
    def moments(self) -> set[int]:
        """Evaluations that its claims name, in movements."""
        components = (part for claim in self.claims for part in claim.components)
        measures = (m for part in components for m in (part.one, part.other))
        return {m.at for m in measures if isinstance(m, Error) and m.at is not None}

    @property
    def choosers(self) -> set[str]:
        """Whose choices, or whatever else is not in evaluations, its claims are about."""
        components = (part for claim in self.claims for part in claim.components)
        measures = (m for part in components for m in (part.one, part.other))
        chosen = [m for m in measures if not isinstance(m, float) and m.of_choices]
        return {apart(name)[0] for measure in chosen for name in learners_of(measure)}


@dataclass(frozen=True)
class Verdict:
    """What became of a claim in a world.

    Attributes:
        claim: The claim.
        findings: What its components came to; empty if runs are missing.
        needs: Learners that have no run.
        p_holm: Its p-value, corrected for the number of claims decided with it; None without
            runs.
    """

    claim: Claim
    findings: tuple[Finding, ...]
    needs: tuple[str, ...]
    p_holm: float | None

    @property
    def p(self) -> float | None:
        """The largest of its components', each with 1 if its direction is not right."""
        return max((f.p_of_claim for f in self.findings), default=None)

    @property
    def word(self) -> Word:
        """The verdict in a word or two."""
        if self.p_holm is None:
            return "no runs"
        if any(f.direction < 0 for f in self.findings):
            return "contradicted"
        return "reproduced" if self.p_holm < LEVEL else "not shown"

    @property
    def word_alone(self) -> Word:
        """The verdict if this were the only claim: by its p-value before correction."""
        if self.p is None or self.word == "contradicted":
            return self.word
        return "reproduced" if self.p < LEVEL else "not shown"

    @property
    def deciding(self) -> Finding:
        """The component that decides: the one most clearly against it, else the least clear."""
        against = [f for f in self.findings if f.direction < 0]
        if against:
            return min(against, key=lambda f: f.direction)
        return max(self.findings, key=lambda f: (f.p_of_claim, -f.direction, f.effect.value))

    def as_json(self, *, details: bool) -> dict[str, Any]:
        """The verdict and the test that decides it, JSON-compatible.

        Args:
            details: Whether to add sentence and reading, and all tests with the numbers of each
                run.
        """
        found: dict[str, Any] = {
            "id": self.claim.id,
            "by_construction": self.claim.by_construction,
            "verdict": self.word,
            "p_holm": self.p_holm,
            "needs": list(self.needs),
            "deciding": self.deciding.as_json(numbers=False) if self.findings else None,
        }
        if details:
            found |= {
                "sentence": self.claim.sentence,
                "reading": self.claim.reading,
                "p": self.p,
                "components": [finding.as_json(numbers=True) for finding in self.findings],
            }
        return found


@dataclass(frozen=True)
class Verdicts:
    """The claims of a chapter in one world.

    Attributes:
        chapter: The chapter.
        world: The world.
        verdicts: One for each claim, in the order of the chapter.
        notes: What a reader should know before believing them.
    """

    chapter: Chapter
    world: World
    verdicts: tuple[Verdict, ...]
    notes: tuple[str, ...]

    @property
    def by_id(self) -> Mapping[str, Verdict]:
        """The verdicts by the claim's id."""
        return {verdict.claim.id: verdict for verdict in self.verdicts}

    def as_json(self, *, details: bool) -> dict[str, Any]:
        """Verdict by verdict, JSON-compatible; with details, also all tests and their numbers."""
        return {
            "chapter": self.chapter.name,
            "experiment": self.world.experiment,
            "configuration": self.world.configuration,
            "at": self.world.movements,
            "learners": {
                name: seed_words([run.seed for run in runs if run.seed is not None])
                for name, runs in self.world.groups.items()
            },
            "claims": [verdict.as_json(details=details) for verdict in self.verdicts],
            "notes": list(self.notes),
        }


def decide(chapter: Chapter, world: World, seed: int = 0) -> Verdicts:
    """Decide the claims of a chapter in a world.

    Holm's correction (1979) is for the claims that have the runs they need.

    Args:
        chapter: The claims.
        world: The runs.
        seed: Of the bootstrap; the intervals are a function of it and of the runs.
    """
    streams, notes = Streams(seed), list(world.notes)
    needs = [tuple(x for x in claim.learners if not world.has(x)) for claim in chapter.claims]
    tested = [
        tuple(part.test(world, streams, notes) for part in claim.components) if not lacking else ()
        for claim, lacking in zip(chapter.claims, needs, strict=True)
    ]
    decided = [i for i, findings in enumerate(tested) if findings]
    raw = [max(f.p_of_claim for f in tested[i]) for i in decided]
    corrected = dict(zip(decided, holm(raw), strict=True))
    _note_few([finding for i in decided for finding in tested[i]], len(decided), notes)
    verdicts = tuple(
        Verdict(claim, tested[i], needs[i], corrected.get(i))
        for i, claim in enumerate(chapter.claims)
    )
    return Verdicts(chapter, world, verdicts, tuple(dict.fromkeys(notes)))


def _note_few(findings: Sequence[Finding], claims: int, notes: list[str]) -> None:
    needed = least_pairs(claims)
    pairs = [len(f.one) for f in findings if f.seeds is not None]
    if pairs and min(pairs) < needed:
        notes.append(
            f"{needed} seeds or more are needed for the first of {claims} claims to be shown after "
            f"correction; some have {min(pairs)}; run more seeds"
        )
