"""``sgim list``: what there is."""

from __future__ import annotations

from sgim.algorithms import ALGORITHMS
from sgim.cli.text import table
from sgim.configurations import CONFIGURATIONS, Configuration
from sgim.experiments import EXPERIMENTS
from sgim.labels import LABEL_ALGORITHMS


def command() -> None:
    """List the experiments with their teachers, the learners, and the configurations.

    Example: sgim list
    """
    rows = []
    for experiment in EXPERIMENTS.values():
        rows.append([experiment.name, experiment.summary])
        if experiment.variant_of is None:
            rows += [["", f"teacher {name}: {line}"] for name, line in experiment.teachers.items()]
    print("experiments\n" + table(rows))
    learners = {**ALGORITHMS, **{n: m for n, m in LABEL_ALGORITHMS.items() if n not in ALGORITHMS}}
    rows = [[name, _first_line(make.__doc__)] for name, make in learners.items()]
    print("\nlearners\n" + table(rows))
    rows = [[name, _described(c)] for name, c in CONFIGURATIONS.items()]
    print("\nconfigurations\n" + table(rows))
    print("Settings that differ are added, as in --configuration modern,social_cost=20")
    print("\nTry: sgim run throwing --learner mimicry --teacher T1 --configuration thesis")


def _first_line(text: str | None) -> str:
    return (text or "").strip().partition("\n")[0]


def _described(configuration: Configuration) -> str:
    default = "the default: " if configuration.name == "modern" else ""
    return (
        f"{default}{configuration.search} search, {configuration.search_movements} movements a "
        f"goal, {configuration.mimicry_movements} a mimicry"
    )
