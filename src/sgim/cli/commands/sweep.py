"""``sgim sweep``: many runs side by side."""

from __future__ import annotations

import sys
from pathlib import Path
from typing import Annotated

from tyro.conf import Positional, arg

from sgim.cli.text import demonstrations_every, shell
from sgim.errors import SgimError
from sgim.experiments import experiment as find_experiment
from sgim.experiments.experiment import evaluation_interval
from sgim.runs.progress import SweepProgress
from sgim.runs.run import Interrupted
from sgim.runs.sweep import SweptRun, sweep


def command(
    experiment: Annotated[Positional[str], arg(metavar="EXPERIMENT")],
    learners: Annotated[str, arg(metavar="A,B,…")],
    seeds: Annotated[str, arg(metavar="0-19")],
    configuration: Annotated[str, arg(metavar="NAME")] = "modern",
    every: Annotated[
        int | None,
        arg(metavar="INT", help_behavior_hint="(default: the configuration's)"),
    ] = None,
    movements: Annotated[
        int | None, arg(metavar="INT", help_behavior_hint="(default: the experiment's)")
    ] = None,
    batch: Annotated[
        int | None, arg(metavar="INT", help_behavior_hint="(default: the experiment's)")
    ] = None,
    evaluate_every: Annotated[
        int | None,
        arg(metavar="INT", help_behavior_hint="(default: at most the experiment's, and a quarter)"),
    ] = None,
    jobs: int = 2,
    out: Path = Path("runs"),
) -> int:
    """Run every learner with every seed, side by side, one journal each.

    Runs that are finished are not repeated, and runs that were stopped go on: after a stop, give
    the same command again. A run that fails does not stop the others.

    Examples:
      sgim sweep throwing --learners sgim-acts,sagg-riac,mimicry:T1 --seeds 0-19 --out runs/throwing
      sgim compare runs/throwing
      sgim plot runs/throwing --out figures

    Args:
        experiment: Name of the experiment; sgim list has them.
        learners: Names of learners, with commas between.
        seeds: Seeds, such as 0-19 or 0,3,5-7.
        configuration: The learners' constants: modern or thesis.
        every: Movements from one demonstration to the next, for sgim-d and imitation.
        movements: How many movements each run makes.
        batch: Movements of a run that are carried out side by side.
        evaluate_every: Movements between evaluations.
        jobs: How many runs are made at once, each in its own process.
        out: Directory of the journals.
    """
    world = find_experiment(experiment)
    configuration = demonstrations_every(configuration, every)
    names = [name.strip() for name in learners.split(",") if name.strip()]
    numbers = parse_seeds(seeds)
    for name in names:
        world.learner(name, configuration=configuration)
    target = world.movements if movements is None else movements
    shown = SweepProgress(world.name, len(names) * len(numbers))
    try:
        with shown:
            results = sweep(
                world,
                names,
                numbers,
                configuration=configuration,
                movements=target,
                batch=world.batch if batch is None else batch,
                evaluate_every=evaluate_every or evaluation_interval(target, world.evaluate_every),
                jobs=jobs,
                out=out,
                on_end=shown.ended,
            )
    except Interrupted as stop:
        print(f"sgim: {stop}; to go on, give the same command again", file=sys.stderr)
        return 130
    return _report(results, out)


def parse_seeds(text: str) -> list[int]:
    """The numbers that ``0,3,5-7`` stands for.

    Raises:
        SgimError: If it is not of that form.
    """
    seeds: dict[int, None] = {}
    for part in text.split(","):
        first, dash, last = part.strip().partition("-")
        if not first.isdecimal() or (dash and not last.isdecimal()):
            raise SgimError(f"--seeds {text!r}: expected numbers and ranges, such as 0-19 or 0,3-5")
        numbers = range(int(first), int(last or first) + 1)
        if not numbers:
            raise SgimError(f"--seeds {text!r}: the range {part} has no number; write it upwards")
        seeds.update(dict.fromkeys(numbers))
    return list(seeds)


def _report(results: list[SweptRun], out: Path) -> int:
    failed = [result for result in results if result.status == "failed"]
    known = sum(result.status == "known" for result in results)
    before = f", {known} of them before" if known else ""
    print(f"{len(results) - len(failed)} of {len(results)} runs are finished{before}: {out}")
    for result in failed:
        print(f"\nsgim: {result.path} failed:\n{result.error.rstrip()}", file=sys.stderr)
    if failed:
        print("\nMend it, then give the same command again.", file=sys.stderr)
        return 1
    print(f"compare  {shell('sgim', 'compare', out)}")
    print(f"figures  {shell('sgim', 'plot', out, '--out', 'figures')}")
    return 0
