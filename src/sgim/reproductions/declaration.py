"""What it takes to make a chapter again, as a declaration."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING, Protocol

from sgim.claims.claim import Chapter
from sgim.experiments.sweep_plan import Part
from sgim.runs.summary import RecordedRun

if TYPE_CHECKING:
    from matplotlib.figure import Figure


class Draw(Protocol):
    """Draws runs of one experiment, as the functions of `sgim.figures` do."""

    def __call__(self, runs: Sequence[RecordedRun], /) -> Figure:
        """The figure."""
        ...


class DrawStacked(Protocol):
    """Draws runs of one experiment, also for narrow screens."""

    def __call__(self, runs: Sequence[RecordedRun], /, *, columns: int = ...) -> Figure:
        """The figure; with ``columns=1``, its panels one below the other."""
        ...


@dataclass(frozen=True)
class Drawing:
    """A figure of a report.

    Attributes:
        name: Its file's name, without ending.
        title: What it is, in a few words.
        caption: How to read it.
        draw: Draws it.
        draw_stacked: Draws it for narrow screens, the same function as a rule; None if nothing
            does.
        learners: Whose runs are drawn; of all if empty.
    """

    name: str
    title: str
    caption: str
    draw: Draw
    draw_stacked: DrawStacked | None = None
    learners: tuple[str, ...] = ()


@dataclass(frozen=True)
class Quick:
    """A first look: fewer seeds, shorter runs.

    Attributes:
        seeds: The seeds.
        movements: Of each run.
    """

    seeds: tuple[int, ...] = tuple(range(10))
    movements: int = 1000


@dataclass(frozen=True)
class Reproduction:
    """A chapter of the thesis, to be made again.

    Attributes:
        name: Its name on the command line.
        title: What it is about.
        source: Where the thesis has it.
        summary: What the learners face, in a few sentences.
        parts: The runs, whose seeds are those that are asked for; each experiment with each
            configuration is a section of the report.
        chapters: The claims.
        drawings: The figures of each section.
        needed: Runs that claims compare with those of the parts, in variants and with settings
            that differ; their seeds are the same, and they have no section.
        worlds: Runs in other plausible worlds, for the counts.
        seeds: Of the parts, if nothing else is said.
        world_seeds: Of the worlds.
        quick: What a first look runs.
    """

    name: str
    title: str
    source: str
    summary: str
    parts: tuple[Part, ...]
    chapters: tuple[Chapter, ...]
    drawings: tuple[Drawing, ...]
    needed: tuple[Part, ...] = ()
    worlds: tuple[Part, ...] = ()
    seeds: tuple[int, ...] = tuple(range(20))
    world_seeds: tuple[int, ...] = tuple(range(6))
    quick: Quick = Quick()

    def to_run(
        self, seeds: Sequence[int] | None, *, quick: bool, worlds: bool
    ) -> tuple[list[Part], list[Part]]:
        """The parts with their seeds, and what is run besides, without a section.

        Args:
            seeds: Of the parts; None for those of the declaration.
            quick: Only the first configuration of each part, for a first look.
            worlds: Whether to run in other plausible worlds too.
        """
        if quick:
            chosen, movements = tuple(seeds or self.quick.seeds), self.quick.movements
            parts, needed = (
                [
                    replace(
                        p, seeds=chosen, movements=movements, configurations=p.configurations[:1]
                    )
                    for p in several
                ]
                for several in (self.parts, self.needed)
            )
            return parts, needed
        chosen = tuple(seeds or self.seeds)
        parts, needed = (
            [replace(part, seeds=chosen) for part in several]
            for several in (self.parts, self.needed)
        )
        others = [replace(part, seeds=self.world_seeds) for part in self.worlds]
        return parts, needed + (others if worlds else [])
