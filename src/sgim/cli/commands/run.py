"""``sgim run``: run a learner in an experiment."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

from tyro.conf import Positional, arg

from sgim.cli.going import go, say_finished
from sgim.cli.text import demonstrations_every, shell
from sgim.errors import JournalError, SgimError
from sgim.experiments import experiment as find_experiment
from sgim.experiments.experiment import evaluation_interval
from sgim.runs.summary import read_run


def command(
    experiment: Annotated[Positional[str], arg(metavar="EXPERIMENT")],
    learner: Annotated[
        str | None,
        arg(metavar="NAME", help_behavior_hint="(default: the experiment's)"),
    ] = None,
    teacher: Annotated[
        str | None,
        arg(
            metavar="NAME",
            aliases=("--caregiver",),
            help_behavior_hint="(default: the experiment's)",
        ),
    ] = None,
    configuration: Annotated[str, arg(metavar="NAME")] = "modern",
    every: Annotated[
        int | None,
        arg(metavar="INT", help_behavior_hint="(default: the configuration's)"),
    ] = None,
    seed: int = 0,
    movements: Annotated[
        int | None, arg(metavar="INT", help_behavior_hint="(default: the experiment's)")
    ] = None,
    journal: Annotated[
        Path | None,
        arg(metavar="PATH", help_behavior_hint="(default: runs/EXPERIMENT-LEARNER-SEED.sgim)"),
    ] = None,
    batch: Annotated[
        int | None, arg(metavar="INT", help_behavior_hint="(default: the experiment's)")
    ] = None,
    evaluate_every: Annotated[
        int | None,
        arg(metavar="INT", help_behavior_hint="(default: at most the experiment's, and a quarter)"),
    ] = None,
    warm_start: Annotated[
        Path | None, arg(metavar="PATH", help_behavior_hint="(default: nothing)")
    ] = None,
) -> int:
    """Run a learner in an experiment, with a journal of all that happens.

    The journal is also the checkpoint: a run that was stopped goes on where it was, to the last
    bit. It is never overwritten.

    Examples:
      sgim run throwing
      sgim run throwing --learner mimicry --teacher T1 --seed 3 --movements 2000
      sgim run arm --learner random-goal-babbling --journal mine.sgim

    Args:
        experiment: Name of the experiment; sgim list has them.
        learner: Name of the learner; sgim list has them.
        teacher: The only teacher to ask, or none; mimicry:T1 as learner says the same.
        configuration: The learner's constants: modern or thesis.
        every: Movements from one demonstration to the next, for sgim-d and imitation.
        seed: Of all random numbers; the same seed gives the same run.
        movements: How many movements to make.
        journal: Where to write the journal.
        batch: Movements decided on at once and carried out side by side.
        evaluate_every: Movements between evaluations.
        warm_start: Journal of another run, whose trials are observed first.
    """
    world = find_experiment(experiment)
    configuration = demonstrations_every(configuration, every)
    name = world.learner_name(learner, teacher)
    batch = world.batch if batch is None else batch
    for what, value, least in (("seed", seed, 0), ("movements", movements, 1), ("batch", batch, 1)):
        if value is not None and value < least:
            raise SgimError(f"{what} is {value}, expected {least} or more")
    made = world.learner(name, configuration=configuration, seed=seed)
    label = world.label(made) or name
    path = journal or world.journal_path(label, seed, configuration)
    target = movements or world.movements
    if path.exists():
        world.require_same(path, made, batch, warm_start)
        recorded = read_run(path)
        if recorded.target is None and warm_start is not None:
            raise JournalError(
                f"{path} was interrupted while it observed {warm_start}; delete it and start again"
            )
        if recorded.finished and recorded.movements >= target:
            say_finished(recorded)
            return 0
        if recorded.finished:
            raise JournalError(
                f"{path} is finished with {recorded.movements} movements; to extend it: "
                f"{shell('sgim', 'resume', path, '--movements', str(target))}"
            )
        if movements is None and recorded.target is not None:
            target = recorded.target
        print(f"{path} has this run already, with {recorded.movements} movements: going on")
    run = world.start(
        name,
        path,
        configuration=configuration,
        seed=seed,
        batch=batch,
        evaluate_every=evaluate_every or evaluation_interval(target, world.evaluate_every),
        warm_start=warm_start,
    )
    return go(run, path, target)
