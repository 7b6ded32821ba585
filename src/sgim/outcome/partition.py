"""A partition of goals, and of the contexts they are aimed at in, into boxes that can be split."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from typing import Any, Protocol

import numpy as np

from sgim.records import Goal
from sgim.spaces import BoolArray, Box, FloatArray, Space
from sgim.streams import Streams


class Placed(Protocol):
    """What a region records of an attempt; at least where it was."""

    @property
    def place(self) -> tuple[float, ...]:
        """Goal coordinates in the unit box, then context coordinates in theirs."""
        ...


class Region:
    """A box of goals of one kind: a leaf of the tree, or an inner node after it was split.

    Attributes:
        kind: Goal kind.
        low: Lower corner in the unit box, goal coordinates first, then context coordinates.
        high: Upper corner.
        leaf: Its row in the map's tables, while it is a leaf.
        records: What was attempted here, as the map that owns the partition keeps it.
        children: The two halves below and above ``cut`` along ``axis``, once split.
    """

    __slots__ = ("axis", "children", "cut", "high", "kind", "leaf", "low", "records")

    def __init__(
        self, kind: str, low: FloatArray, high: FloatArray, leaf: int, records: list[Any]
    ) -> None:
        self.kind = kind
        self.low = low
        self.high = high
        self.leaf = leaf
        self.records = records
        self.axis = 0
        self.cut = 0.0
        self.children: tuple[Region, Region] | None = None


class Partition:
    """Goal spaces, each one region at first, that are split where attempts differ.

    Args:
        goal_spaces: Kind → goal space; each must be a `Box`.
        streams: Random streams, for the candidate splits.
        context_space: The task's context space if there is one; it must be a `Box`.
        candidates: Random splits to choose among (m of section 4.3.2.4).

    Attributes:
        spaces: Kind → goal space.
        leaves: The regions that are not split, each at its row.
        roots: Kind → the region of everything.

    Raises:
        TypeError: If a goal or context space is not a `Box`.
    """

    def __init__(
        self,
        goal_spaces: Mapping[str, Space],
        streams: Streams,
        *,
        context_space: Space | None,
        candidates: int,
    ) -> None:
        for what, space in [*goal_spaces.items(), ("context", context_space or Box(0, 1))]:
            if not isinstance(space, Box):
                raise TypeError(f"interest over regions needs boxes, but {what!r} is {space!r}")
        self.spaces: dict[str, Box] = {k: s for k, s in goal_spaces.items() if isinstance(s, Box)}
        self.context_space = context_space
        self.streams = streams
        self.candidates = candidates
        self.contexts = (context_space.dimension or 0) if context_space else 0
        self.leaves: list[Region] = []
        self.roots: dict[str, Region] = {}

    def plant(self, kind: str, records: list[Any]) -> Region:
        """Make the region of everything of a kind."""
        d = self.spaces[kind].dimension + self.contexts
        root = Region(kind, np.zeros(d), np.ones(d), len(self.leaves), records)
        self.leaves.append(root)
        self.roots[kind] = root
        return root

    def region_of(self, kind: str, place: Sequence[float] | FloatArray) -> Region:
        """The leaf that contains a place of the unit box."""
        region = self.roots[kind]
        while (children := region.children) is not None:
            region = children[1] if place[region.axis] > region.cut else children[0]
        return region

    def place_of(self, goal: Goal, context: Any) -> tuple[float, ...] | None:
        """Where a goal in a context lies; None if outside its box, or of another kind."""
        space = self.spaces.get(goal.kind)
        if space is None:
            return None
        place = space.encoded(goal.point)
        if min(place) < 0.0 or max(place) > 1.0:
            return None
        if self.context_space is not None:  # measured ones may lie a little outside
            place += np.clip(self.context_space.encode(context), 0.0, 1.0).tolist()
        return tuple(place)

    def present(self, context: Any) -> Sequence[int]:
        """Rows of the leaves that contain the context; all of them where there are none."""
        if self.context_space is None:
            return range(len(self.leaves))
        place = np.clip(self.context_space.encode(context), 0.0, 1.0)
        c = len(place)
        return [
            region.leaf
            for region in self.leaves
            if (region.low[-c:] <= place).all() and (place <= region.high[-c:]).all()
        ]

    def best_cut(
        self,
        region: Region,
        records: Sequence[Placed],
        gaps: Callable[[BoolArray], FloatArray],
    ) -> tuple[int, float] | None:
        """Where the sizes of both parts times the gap of their interests is largest.

        Candidates are random, as in section 3.1.4.

        Args:
            region: The region to cut.
            records: What was attempted there, n of it.
            gaps: From c ways to part the records, shape ``(n, c)``, true below the cut, to how
                far apart the interests of the two parts are, shape ``(c,)``.

        Returns:
            The axis and the cut; None if no candidate parts the records.
        """
        rng = self.streams("interest/split", len(self.leaves))
        axes = rng.integers(len(region.low), size=self.candidates)
        shares = rng.random(self.candidates)
        cuts = region.low[axes] + shares * (region.high[axes] - region.low[axes])
        below = np.array([record.place for record in records])[:, axes] <= cuts
        counts = below.sum(axis=0)
        parted: dict[tuple[int, int], int] = {}
        for i, (axis, count) in enumerate(zip(axes.tolist(), counts.tolist(), strict=True)):
            if 0 < count < len(records):  # another cut that parts them alike is no better
                parted.setdefault((axis, count), i)
        if not parted:
            return None
        chosen = list(parted.values())
        sizes = counts[chosen] * (len(records) - counts[chosen])
        best = chosen[int((sizes * gaps(below[:, chosen])).argmax())]
        return int(axes[best]), float(cuts[best])

    def divide(self, region: Region, axis: int, cut: float) -> tuple[Region, Region]:
        """Split a leaf: the lower half keeps its row, the upper half gets the next one.

        Neither half has records yet.
        """
        middle_high, middle_low = region.high.copy(), region.low.copy()
        middle_high[axis] = middle_low[axis] = cut
        lower = Region(region.kind, region.low, middle_high, region.leaf, [])
        upper = Region(region.kind, middle_low, region.high, len(self.leaves), [])
        self.leaves[region.leaf] = lower
        self.leaves.append(upper)
        region.axis, region.cut, region.children = axis, cut, (lower, upper)
        return lower, upper
