"""Going on with a run until its target, and saying how it went."""

from __future__ import annotations

import math
import sys
from pathlib import Path

from sgim.cli.text import choices, evaluations, example_goal, shell, troubles
from sgim.experiments import EXPERIMENTS
from sgim.policy import InverseModel
from sgim.runs.progress import duration, progress
from sgim.runs.run import Interrupted, Run, RunError
from sgim.runs.summary import RecordedRun, read_run


def go(run: Run, path: Path, target: int, *, pace: float = math.inf) -> int:
    """Go on with a run, then print its errors and choices and what to do next.

    Returns:
        The exit code.
    """
    title = path.stem
    try:
        with run:
            run.go(target, progress(title), pace=pace)
    except (Interrupted, KeyboardInterrupt):
        made = read_run(path).movements
        again = "the same command" if run.asks_persons else shell("sgim", "resume", path)
        print(
            f"sgim: stopped at {made} of {target} movements; they are in {path}. To go on:\n"
            f"  {again}",
            file=sys.stderr,
        )
        return 130
    except RunError as error:
        print(f"sgim: {error} To go on:\n  {shell('sgim', 'resume', path)}", file=sys.stderr)
        return 1
    recorded = read_run(path)
    report(recorded)
    print(f"\njournal  {path} ({recorded.movements} movements, {duration(run.seconds)})")
    print(f"figures  {shell('sgim', 'plot', path, '--out', 'figures')}")
    if isinstance(run.learner.model, InverseModel):
        goal = example_goal(recorded.task.goal_spaces)
        print(f"answers  {shell('sgim', 'answer', path, '--goal', goal)}")
    return 0


def report(run: RecordedRun) -> None:
    """Print the tables of errors and of choices, and what went wrong."""
    experiment = EXPERIMENTS.get(run.experiment or "")
    errors = evaluations(run, experiment.unit if experiment else "")
    print("\n\n".join(part for part in (errors, choices(run), troubles(run)) if part))


def say_finished(run: RecordedRun) -> None:
    """Say that a run is finished, and how to extend it."""
    more = shell("sgim", "resume", run.path, "--movements", str(2 * run.movements))
    print(
        f"{run.path} is finished: {run.movements} movements. To extend it:\n  {more}\n"
        f"To see what it did:\n  {shell('sgim', 'show', run.path)}"
    )
