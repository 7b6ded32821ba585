"""``sgim teach``: a person teaches a learner, through a page."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path
from typing import Annotated, Literal

from tyro.conf import Positional, arg

from sgim.cli.going import go
from sgim.cli.serving import keep_serving
from sgim.errors import SgimError
from sgim.experiments import experiment as find_experiment
from sgim.experiments.experiment import evaluation_interval
from sgim.teachers import RemoteTeacher

TEACHER = "person"
"""The name by which learners know the person."""


def command(
    experiment: Annotated[
        Positional[Literal["fishing", "hockey", "throwing"]], arg(metavar="EXPERIMENT")
    ],
    learner: Literal["sgim-acts", "sgim-im", "sgim-d"] = "sgim-acts",
    configuration: Annotated[str, arg(metavar="NAME")] = "modern",
    seed: int = 0,
    movements: int = 1000,
    pace: float = 2.0,
    time_limit: float = 180.0,
    per_hour: int = 60,
    journal: Annotated[
        Path | None,
        arg(
            metavar="PATH", help_behavior_hint="(default: runs/taught-EXPERIMENT-LEARNER-SEED.sgim)"
        ),
    ] = None,
    port: Annotated[int | None, arg(metavar="INT", help_behavior_hint="(default: 7446)")] = None,
    expose: Annotated[
        str | None, arg(metavar="ADDRESS", help_behavior_hint="(default: this machine only)")
    ] = None,
) -> int:
    """Teach a learner: it asks you on a page, you show it, and it explores meanwhile.

    Open the address that is printed. The same command goes on with a lesson that was stopped;
    nothing that you gave is lost, and nothing is asked twice.

    Examples:
      sgim teach fishing
      sgim teach hockey --learner sgim-im --journal lesson.sgim

    Args:
        experiment: fishing, hockey or throwing.
        learner: Which learner: sgim-acts, sgim-im or sgim-d.
        configuration: The learner's constants: modern or thesis.
        seed: Of all random numbers.
        movements: How many movements to make, before the lesson ends.
        pace: Movements a second, at most.
        time_limit: How long a request waits for you, in seconds; the page can change it.
        per_hour: Requests an hour, at most; the page can change it.
        journal: Where to write the journal.
        port: Where to listen.
        expose: An address of this machine that others can reach; read docs/security.md first.
    """
    from sgim.web import serve

    for what, value in (("movements", movements), ("pace", pace)):
        if not value > 0:
            raise SgimError(f"{what} is {value}, expected more than 0")
    person = RemoteTeacher(time_limit, per_hour)
    world = replace(
        find_experiment(experiment),
        teachers={TEACHER: "you"},
        make_teachers=lambda: {TEACHER: person},
    )
    path = journal or world.journal_path(learner, seed, configuration)
    if journal is None:
        path = path.with_name(f"taught-{path.name}")
    run = world.start(
        learner,
        path,
        configuration=configuration,
        seed=seed,
        evaluate_every=evaluation_interval(movements),
    )
    with serve(run, port=port, expose=expose) as page:
        print(f"open  {page.url}", flush=True)
        code = go(run, path, movements, pace=pace)
        if code == 0:
            print("\nThe lesson is over; the page still shows it.")
            keep_serving(page)
    return code
