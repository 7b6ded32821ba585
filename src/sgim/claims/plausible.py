"""In how many plausible worlds a claim holds: variants of an experiment and of its constants."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any

from sgim.claims.claim import Chapter, Claim, Verdicts, Word


@dataclass(frozen=True)
class Count:
    """A claim over worlds.

    Attributes:
        claim: The claim.
        words: Name of each world that has the runs it needs → the verdict there, by p-values that
            are not corrected for the other claims: a world by itself has few seeds.
    """

    claim: Claim
    words: Mapping[str, Word]

    @property
    def holds(self) -> int:
        """In how many it holds."""
        return sum(word == "reproduced" for word in self.words.values())

    @property
    def elsewhere(self) -> dict[Word, list[str]]:
        """What it does where it does not hold → the worlds."""
        found: dict[Word, list[str]] = {}
        for name, word in self.words.items():
            if word != "reproduced":
                found.setdefault(word, []).append(name)
        return found

    def as_json(self) -> dict[str, Any]:
        """Everything, JSON-compatible."""
        return {
            "id": self.claim.id,
            "holds": self.holds,
            "worlds": len(self.words),
            "elsewhere": self.elsewhere,
        }


@dataclass(frozen=True)
class Plausible:
    """The claims of a chapter over the worlds of one base configuration.

    Attributes:
        chapter: The chapter.
        configuration: The base configuration.
        worlds: Names of the worlds.
        counts: One for each claim, in the order of the chapter.
    """

    chapter: Chapter
    configuration: str
    worlds: tuple[str, ...]
    counts: tuple[Count, ...]

    def as_json(self) -> dict[str, Any]:
        """Everything, JSON-compatible."""
        return {
            "chapter": self.chapter.name,
            "configuration": self.configuration,
            "worlds": list(self.worlds),
            "claims": [count.as_json() for count in self.counts],
        }


def count_worlds(several: Sequence[Verdicts]) -> list[Plausible]:
    """Count, for each chapter and base configuration with claims decided in several worlds."""
    groups: dict[tuple[str, str], list[Verdicts]] = {}
    for verdicts in several:
        if all(verdict.word == "no runs" for verdict in verdicts.verdicts):
            continue
        groups.setdefault((verdicts.chapter.name, verdicts.world.base), []).append(verdicts)
    return [_count(members) for members in groups.values() if len(members) > 1]


def _count(members: Sequence[Verdicts]) -> Plausible:
    names = [verdicts.world.name for verdicts in members]
    counts = []
    for i, claim in enumerate(members[0].chapter.claims):
        words = {
            name: verdicts.verdicts[i].word_alone
            for name, verdicts in zip(names, members, strict=True)
        }
        counts.append(Count(claim, {name: w for name, w in words.items() if w != "no runs"}))
    return Plausible(members[0].chapter, members[0].world.base, tuple(names), tuple(counts))
