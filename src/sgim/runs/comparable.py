"""Which runs can be compared, and at which evaluations."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np

from sgim.errors import SgimError, unknown
from sgim.runs.journal_reading import first_difference
from sgim.runs.measured import MeasuredRun, by_learner
from sgim.spaces import FloatArray

_MOST_NAMED = 3
"""Journals named in a note; of more, the number is said."""


@dataclass(frozen=True)
class Selected:
    """Runs that can be compared.

    Attributes:
        groups: Name of a learner → its runs, in the order of their seeds.
        kind: Kind of goal, or ``total``.
        movements: The evaluations that all have, up to the one compared, in order.
        notes: What was left out, and what else a reader should know.
    """

    groups: Mapping[str, Sequence[MeasuredRun]]
    kind: str
    movements: Sequence[int]
    notes: Sequence[str]

    def errors(self, runs: Sequence[MeasuredRun]) -> FloatArray:
        """The errors of these runs at these evaluations, shape ``(runs, evaluations)``."""
        found = [{e.movements: e.errors[self.kind] for e in run.evaluations} for run in runs]
        return np.array([[errors[m] for m in self.movements] for errors in found])


def select(runs: Sequence[MeasuredRun], kind: str, at: int | None) -> Selected:
    """Check that runs can be compared, and find the evaluations that they have in common.

    Args:
        runs: The runs.
        kind: Kind of goal whose errors are compared, or ``total``.
        at: The evaluation to compare at, in movements; the last that all have if None.

    Raises:
        SgimError: If they are of different experiments, tasks or benchmarks, were asked for
            different numbers of movements without ``at``, have no such kind of error or no
            evaluation in common, or if a learner has a seed twice.
    """
    notes: list[str] = []
    if not runs:
        raise SgimError("there is no run to compare; give journals, or directories of journals")
    _require_one_world(runs)
    kept = _evaluated(runs, at, notes)
    _require_one_benchmark(kept, kind, notes)
    if at is None:
        _require_one_length(kept)
    common = set.intersection(*({e.movements for e in run.evaluations} for run in kept))
    last = max(common) if at is None and common else at
    movements = sorted(m for m in common if last is not None and m <= last)
    if last is None or not movements or not last:
        raise SgimError(
            "the runs have no evaluation in common after their first movement; sweep them with "
            "one --evaluate-every, or give --at one that each has"
        )
    _note_unfinished(kept, at, last, notes)
    groups = {name: _ordered(name, members) for name, members in by_learner(kept).items()}
    alone = [name for name, members in groups.items() if len(members) == 1]
    if alone:
        notes.append(
            f"{', '.join(alone)} {'has' if len(alone) == 1 else 'have'} one run, which says "
            "nothing of how runs scatter: no interval"
        )
    return Selected(groups, kind, movements, notes)


def _require_one_world(runs: Sequence[MeasuredRun]) -> None:
    experiments = sorted({str(run.experiment or "no experiment") for run in runs})
    if len(experiments) > 1:
        raise SgimError(
            f"here are runs of {', '.join(experiments)}, whose errors do not compare; give the "
            "journals of one experiment"
        )
    for run in runs[1:]:
        if difference := first_difference(runs[0].header.get("task"), run.header.get("task")):
            raise SgimError(
                f"{runs[0].path} and {run.path} are of different tasks: {difference}; give the "
                "journals of one task"
            )


def _evaluated(
    runs: Sequence[MeasuredRun], at: int | None, notes: list[str]
) -> Sequence[MeasuredRun]:
    """The runs with an evaluation at ``at``, or at all; those left out are noted."""

    def has(run: MeasuredRun) -> bool:
        return any(e.movements == at if at is not None else e.movements for e in run.evaluations)

    kept = [run for run in runs if has(run)]
    where = f"at {at} movements" if at is not None else "after a movement"
    if not kept:
        known = sorted({e.movements for run in runs for e in run.evaluations} - {0})
        have = f"; there are some at {_listed(known)}" if known else "; let them go on first"
        raise SgimError(f"no run was evaluated {where}{have}")
    if left := [run for run in runs if not has(run)]:
        notes.append(f"left out, not evaluated {where}: {_named(left)}")
    return kept


def _require_one_benchmark(runs: Sequence[MeasuredRun], kind: str, notes: list[str]) -> None:
    kinds = {kind: None for run in runs for kind in run.evaluations[-1].errors}
    if kind not in kinds:
        raise unknown("kind of error", kind, kinds)
    known = [run for run in runs if run.benchmark is not None]
    for run in known[1:]:
        if difference := first_difference(known[0].benchmark, run.benchmark):
            raise SgimError(
                f"{known[0].path} and {run.path} were measured by different goals ({difference}), "
                "so their errors do not compare; run one of them again"
            )
    for run in runs:
        if any(kind not in evaluation.errors for evaluation in run.evaluations):
            raise SgimError(f"{run.path} was not measured on {kind!r}; choose another --kind")
    if silent := len(runs) - len(known):
        notes.append(
            f"{silent} of {len(runs)} journals do not say by which goals their run was measured; "
            "taken to be the same"
        )


def _require_one_length(runs: Sequence[MeasuredRun]) -> None:
    by_target: dict[int, MeasuredRun] = {}
    for run in runs:
        by_target.setdefault(run.target or run.evaluations[-1].movements, run)
    if len(by_target) > 1:
        shown = ", ".join(f"{target} ({by_target[target].path})" for target in sorted(by_target))
        raise SgimError(
            f"here are runs of different numbers of movements: {shown}; to compare them at an "
            f"evaluation that each has, give --at, such as --at {min(by_target)}"
        )


def _note_unfinished(
    runs: Sequence[MeasuredRun], at: int | None, last: int, notes: list[str]
) -> None:
    left = [run for run in runs if run.evaluations[-1].movements < (run.target or 0)]
    if left and at is None:
        notes.append(
            f"not finished: {_named(left)}; so all are compared at {last} movements, the last "
            "evaluation that each has. Finish them with sgim resume, or leave them out with --at"
        )


def _ordered(name: str, runs: Sequence[MeasuredRun]) -> list[MeasuredRun]:
    """The runs of one learner in the order of their seeds; refused if it is not one."""
    by_seed: dict[int, MeasuredRun] = {}
    for run in runs:
        first = {**runs[0].recipe, "seed": None}
        if difference := first_difference(first, {**run.recipe, "seed": None}):
            raise SgimError(
                f"{runs[0].path} and {run.path} are both called {name}, but {difference}; give "
                "their configurations different names, or compare them apart"
            )
        if run.seed is None:
            continue
        if run.seed in by_seed:
            raise SgimError(
                f"{by_seed[run.seed].path} and {run.path} are both {name} with seed {run.seed}; "
                "give one of them"
            )
        by_seed[run.seed] = run
    return sorted(runs, key=lambda run: (run.seed is None, run.seed or 0))


def _named(runs: Sequence[MeasuredRun]) -> str:
    shown = ", ".join(str(run.path) for run in runs[:_MOST_NAMED])
    return shown + (f" and {len(runs) - _MOST_NAMED} more" if len(runs) > _MOST_NAMED else "")


def _listed(numbers: Sequence[int]) -> str:
    most = 8
    shown = ", ".join(map(str, numbers[-most:]))
    return f"… {shown}" if len(numbers) > most else shown
