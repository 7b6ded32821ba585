"""Makes the air hockey teacher's demonstrations.

Run it as ``python -m sgim.experiments.make_hockey_teacher``.
They are what random and SAGG-RIAC learners tried, chosen so that they end evenly over [0.5, 1].
"""

from __future__ import annotations

from pathlib import Path

import numpy as np

from sgim import algorithms, environments
from sgim.environments.hockey import AirHockey
from sgim.environments.hockey_teacher import HOCKEY_TABLE, select_hits
from sgim.environments.tables import write_table
from sgim.spaces import FloatArray
from sgim.streams import Streams

SEEDS = range(1000, 1020)
MOVEMENTS = 8000
LEARNERS = ("random", "sagg-riac")
# Impacts amplify what rounding changes: policies are rounded first, then executed and chosen.
DECIMALS = 4


def main(folder: Path) -> None:
    """Let learners explore, and write 500 of their hits."""
    table = AirHockey()
    tried = [explored(table, name, seed) for name in LEARNERS for seed in SEEDS]
    policies = np.concatenate(tried).round(DECIMALS)
    outcomes = table.execute_batch(policies)
    chosen = select_hits(policies, outcomes, Streams(SEEDS[0])("hockey teacher"))
    comment = (
        "Made by: python -m sgim.experiments.make_hockey_teacher\n"
        f"500 of the movements of {' and '.join(LEARNERS)} learners (sgim 0.1.0, modern, seeds\n"
        f"{SEEDS[0]} to {SEEDS[-1]}, {MOVEMENTS} trials each), chosen so that the puck meets the "
        "top border evenly over [0.5, 1]."
    )
    names = table.task.policy_space.describe()["names"]
    write_table(folder / HOCKEY_TABLE, comment, names, chosen, decimals=DECIMALS)
    edges = np.linspace(0.5, 1, 11)
    for what, movements in (("tried", outcomes), ("chosen", table.execute_batch(chosen))):
        ends = [float(outcome["hit"][0]) for outcome in movements if "hit" in outcome]
        counts, _ = np.histogram(ends, edges)
        print(f"{what}: {len(movements)}; in each twentieth from 0.5 to 1: {counts.tolist()}")


def explored(table: AirHockey, name: str, seed: int) -> FloatArray:
    """The policies that a learner tries, shape ``(MOVEMENTS, 14)``."""
    learner = algorithms.make(name, table.task, seed=seed)
    policies = []
    for _ in range(MOVEMENTS):
        plan = learner.ask()
        learner.tell(plan, table.execute(plan.policy))
        policies.append(plan.policy)
    return np.array(policies)


if __name__ == "__main__":
    main(Path(environments.__file__).parent / "data")
