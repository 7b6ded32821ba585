"""``sgim sweep``: many runs side by side."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated, Any

from tyro.conf import Positional, arg

from sgim.cli.sweeping import Where, sweep_and_say
from sgim.cli.text import demonstrations_every, shell
from sgim.errors import SgimError
from sgim.experiments.sweep_plan import Part, parse_seeds, plan, read_sweep_file


def command(
    experiments: Annotated[Positional[str], arg(metavar="EXPERIMENT,…|FILE.toml")],
    learners: Annotated[str | None, arg(metavar="A,B,…", help_behavior_hint="")] = None,
    seeds: Annotated[str | None, arg(metavar="0-19", help_behavior_hint="")] = None,
    configuration: Annotated[
        tuple[str, ...], arg(metavar="NAME…", help_behavior_hint="(default: modern)")
    ] = (),
    teachers: Annotated[
        str | None, arg(metavar="T1,…", help_behavior_hint="(default: named with the learner)")
    ] = None,
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
    out: Annotated[Path | None, arg(metavar="DIR", help_behavior_hint="(default: runs)")] = None,
    where: Annotated[Where, arg(name="")] = Where(),  # noqa: B008 - frozen
) -> int:
    """Run every learner with every seed, side by side, one journal each.

    Runs that are finished are not repeated, and runs that were stopped go on: after a stop, give
    the same command again. A run that fails, or whose process dies, is tried again; if that does
    not help it is reported, and the others go on.

    With --backend dask or ray the runs are made by a cluster: the one whose scheduler or address
    is given, or one on this machine. The directory of the journals must then be on storage that
    all its machines share, at the same path.

    A file in TOML has the same words as keys, and may have several parts:

      out = "runs/mine"
      seeds = "0-19"
      [[sweep]]
      experiments = ["throwing", "throwing-5"]
      learners = ["sgim-acts", "mimicry:T1"]
      configurations = ["modern", "modern,prior=0.1"]

    Examples:
      sgim sweep throwing --learners sgim-acts,sagg-riac,mimicry:T1 --seeds 0-19 --out runs/throwing
      sgim sweep throwing,throwing-5 --learners mimicry,emulation --teachers T1,T2 --seeds 0-9
      sgim sweep mine.toml --backend dask --scheduler tcp://head:8786
      sgim compare runs/throwing

    Args:
        experiments: Names of experiments, with commas between (sgim list has them), or a file.
        learners: Names of learners, with commas between.
        seeds: Seeds, such as 0-19 or 0,3,5-7.
        configuration: The learners' constants: modern or thesis, with settings that differ.
        teachers: For learners that ask one teacher: a run for each of these.
        every: Movements from one demonstration to the next, for sgim-d and imitation.
        movements: How many movements each run makes.
        batch: Movements of a run that are carried out side by side.
        evaluate_every: Movements between evaluations.
        out: Directory of the journals.
        where: Where the runs are made.
    """
    said: dict[str, Any] = {
        "learners": learners,
        "seeds": seeds,
        "configuration": configuration or None,
        "teachers": teachers,
        "every": every,
        "movements": movements,
        "batch": batch,
        "evaluate_every": evaluate_every,
    }
    if experiments.endswith(".toml"):
        if given := [name for name, value in said.items() if value is not None]:
            options = ", ".join(f"--{name.replace('_', '-')}" for name in given)
            raise SgimError(f"{options}: what to run is said by {experiments}; write it there")
        file = read_sweep_file(Path(experiments))
        parts, settings, title = file.parts, file.settings, Path(experiments).stem
    else:
        if learners is None or seeds is None:
            raise SgimError("say which --learners and --seeds, or name a file FILE.toml")
        part = Part(
            _names(experiments),
            _names(learners),
            tuple(parse_seeds(seeds)),
            tuple(demonstrations_every(name, every) for name in configuration or ("modern",)),
            _names(teachers or ""),
            movements,
            batch,
            evaluate_every,
        )
        parts, settings, title = (part,), {}, experiments
    folder = out or Path(settings.get("out", "runs"))
    found = sweep_and_say(title, plan(parts), folder, where.over(settings))
    if found.code == 0:
        print(f"compare  {shell('sgim', 'compare', folder)}")
        print(f"figures  {shell('sgim', 'plot', folder, '--out', 'figures')}")
    return found.code


def _names(text: str) -> tuple[str, ...]:
    return tuple(name.strip() for name in text.split(",") if name.strip())
