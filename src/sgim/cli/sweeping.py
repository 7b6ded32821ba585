"""Sweeping from the command line: where the runs are made, the bar, and what became of them."""

from __future__ import annotations

import sys
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, fields, replace
from pathlib import Path
from typing import Annotated, Any, NamedTuple

from tyro.conf import arg

from sgim.errors import SgimError
from sgim.runs.backends import BackendName
from sgim.runs.run import Interrupted
from sgim.runs.sweep import SweptRun, sweep
from sgim.runs.sweep_progress import SweepProgress
from sgim.runs.sweep_run import PlannedRun


@dataclass(frozen=True)
class Where:
    """Where runs are made.

    Attributes:
        backend: Processes of this machine (loky), or a cluster of Dask or Ray.
        scheduler: Address of a Dask scheduler, with --backend dask.
        address: Address of a Ray cluster, with --backend ray.
        jobs: How many runs are made at once.
        retries: How often a run that fails, or whose process dies, is tried again.
        scratch: Directory where a run's journal is written before it is brought to its place.
    """

    backend: Annotated[
        BackendName | None, arg(metavar="loky|dask|ray", help_behavior_hint="(default: loky)")
    ] = None
    scheduler: Annotated[
        str | None, arg(metavar="ADDRESS", help_behavior_hint="(default: a cluster made here)")
    ] = None
    address: Annotated[
        str | None, arg(metavar="ADDRESS", help_behavior_hint="(default: a cluster made here)")
    ] = None
    jobs: Annotated[
        int | None, arg(metavar="INT", help_behavior_hint="(default: 2, or all of a cluster)")
    ] = None
    retries: Annotated[int | None, arg(metavar="INT", help_behavior_hint="(default: 2)")] = None
    scratch: Annotated[
        Path | None,
        arg(metavar="DIR", help_behavior_hint="(default: none, but on a network file system)"),
    ] = None

    def over(self, settings: Mapping[str, Any]) -> Where:
        """This, with what it does not say taken from settings of the same names."""
        mine = {field.name for field in fields(self) if getattr(self, field.name) is None}
        return replace(self, **{key: value for key, value in settings.items() if key in mine})

    def arguments(self) -> dict[str, Any]:
        """For `sgim.runs.sweep.sweep`.

        Raises:
            SgimError: If an address is given that the back end does not have.
        """
        backend = self.backend or "loky"
        for name, of in (("scheduler", "dask"), ("address", "ray")):
            if getattr(self, name) is not None and backend != of:
                raise SgimError(f"--{name} goes with --backend {of}, but the back end is {backend}")
        return {
            "backend": backend,
            "address": self.scheduler or self.address,
            "jobs": self.jobs,
            "retries": 2 if self.retries is None else self.retries,
            "scratch": self.scratch,
        }


class Swept(NamedTuple):
    """What became of a sweep.

    Attributes:
        code: The exit code.
        runs: How each run ended; empty if it was interrupted.
    """

    code: int
    runs: Sequence[SweptRun]


def sweep_and_say(title: str, planned: Sequence[PlannedRun], out: Path, where: Where) -> Swept:
    """Make runs with one progress bar, then say how many are finished, and what failed and why."""
    shown = SweepProgress(title, len(planned))
    arguments = where.arguments()
    try:
        with shown:
            results = sweep(planned, out=out, on_end=shown.ended, **arguments)
    except Interrupted as stop:
        print(f"sgim: {stop}; to go on, give the same command again", file=sys.stderr)
        return Swept(130, ())
    return Swept(_say(results, out), results)


def _say(results: Sequence[SweptRun], out: Path) -> int:
    failed = [result for result in results if result.status == "failed"]
    known = sum(result.status == "known" for result in results)
    before = f", {known} of them before" if known else ""
    print(f"{len(results) - len(failed)} of {len(results)} runs are finished{before}: {out}")
    for result in failed:
        tried = f" in {result.attempts} attempts" if result.attempts > 1 else ""
        print(f"\nsgim: {result.path} failed{tried}:\n{result.error.rstrip()}", file=sys.stderr)
    if failed:
        print("\nMend it, then give the same command again.", file=sys.stderr)
        return 1
    return 0
