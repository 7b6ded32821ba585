"""Comparing learners over seeds: each by itself, and each against one of them."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from sgim.errors import SgimError, unknown
from sgim.runs.comparable import Selected, select
from sgim.runs.contrasts import Contrast, Group, contrast_all
from sgim.runs.measured import MeasuredRun
from sgim.spaces import FloatArray
from sgim.statistics import area_under_curve, interquartile_estimate
from sgim.streams import Streams


@dataclass(frozen=True)
class Comparison:
    """Learners side by side.

    Attributes:
        experiment: The experiment; None for runs that are of none.
        kind: Kind of goal whose errors are compared, or ``total``.
        movements: Of the evaluations that all have, up to the one compared, shape ``(n,)``.
        groups: The learners, the lowest error first.
        reference: Name of the one that the others are compared with; None if it is alone.
        contrasts: The others against it, in the order of the groups.
        margin: Of equivalence, a share of the larger error.
        seed: Of the resampling.
        notes: What a reader should know before believing it.
    """

    experiment: str | None
    kind: str
    movements: FloatArray
    groups: tuple[Group, ...]
    reference: str | None
    contrasts: tuple[Contrast, ...]
    margin: float
    seed: int
    notes: tuple[str, ...]

    def as_json(self) -> dict[str, Any]:
        """Everything, JSON-compatible, with curves, profiles and the errors of each run."""
        thresholds = np.unique(np.concatenate([group.last for group in self.groups]))
        return {
            "experiment": self.experiment,
            "kind": self.kind,
            "at": int(self.movements[-1]),
            "movements": self.movements.astype(int).tolist(),
            "thresholds": thresholds.tolist(),
            "groups": [group.as_json(thresholds) for group in self.groups],
            "reference": self.reference,
            "margin": self.margin,
            "seed": self.seed,
            "comparisons": [contrast.as_json() for contrast in self.contrasts],
            "notes": list(self.notes),
        }


def compare(
    runs: Sequence[MeasuredRun],
    *,
    kind: str = "total",
    at: int | None = None,
    against: str | None = None,
    margin: float = 0.2,
    seed: int = 0,
) -> Comparison:
    """Compare learners by their errors, over their seeds.

    Args:
        runs: Of one experiment, measured by the same goals, each learner and seed once.
        kind: Kind of goal, or ``total``, the mean of the kinds.
        at: The evaluation to compare at, in movements; the last that all have if None.
        against: The learner to compare the others with; if None, ``sgim-acts``, or else the one
            with the lowest error.
        margin: By which share of the larger error equivalent learners may differ.
        seed: Of the resampling; the intervals are a function of it and of the runs.

    Raises:
        SgimError: If the runs cannot be compared; the message says which, and what to do.
    """
    if not 0 < margin < 1:
        raise SgimError(f"--margin is {margin}, expected a share between 0 and 1, such as 0.2")
    if seed < 0:
        raise SgimError(f"seed is {seed}, expected 0 or more")
    streams = Streams(seed)
    chosen = select(runs, kind, at)
    groups = [_group(name, members, chosen, streams) for name, members in chosen.groups.items()]
    groups.sort(key=lambda group: float(group.middle.value))
    notes = list(chosen.notes)
    reference = _reference(groups, against, notes)
    others = [group for group in groups if group is not reference]
    contrasts = contrast_all(others, reference, margin, streams, notes)
    return Comparison(
        experiment=runs[0].experiment,
        kind=kind,
        movements=np.array(chosen.movements, dtype=np.float64),
        groups=tuple(groups),
        reference=reference.name if others else None,
        contrasts=tuple(contrasts),
        margin=margin,
        seed=seed,
        notes=tuple(notes),
    )


def _group(name: str, runs: Sequence[MeasuredRun], chosen: Selected, streams: Streams) -> Group:
    errors = chosen.errors(runs)
    areas = area_under_curve(chosen.movements, errors)
    return Group(
        name,
        tuple(runs),
        errors,
        float(np.median(errors[:, -1])),
        interquartile_estimate(errors[:, -1], streams(f"bootstrap/last/{name}")),
        interquartile_estimate(areas, streams(f"bootstrap/area/{name}")),
        interquartile_estimate(errors, streams(f"bootstrap/curve/{name}")),
    )


def _reference(groups: Sequence[Group], against: str | None, notes: list[str]) -> Group:
    """The group to compare the others with; ``groups`` has the lowest error first."""
    wanted = "sgim-acts" if against is None else against
    found = [g for g in groups if g.name == wanted] or [
        g for g in groups if g.runs[0].learner == wanted
    ]
    if against is None and not found:
        if len(groups) > 1:
            notes.append(
                f"{groups[0].name} is the reference because its error is the lowest here, which "
                "flatters it; name a reference beforehand with --against"
            )
        return groups[0]
    if not found:
        raise unknown("learner", against, [group.name for group in groups])
    if against is not None and len(found) > 1:
        names = ", ".join(repr(group.name) for group in found)
        raise SgimError(f"--against {against!r} may be {names}; write one of these")
    return found[0]
