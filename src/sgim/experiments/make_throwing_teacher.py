"""Makes the throwing teacher's demonstrations.

Run it as ``python -m sgim.experiments.make_throwing_teacher``.
The teacher has learned by itself: its demonstrations are throws that a SAGG-RIAC learner tried,
one in each of 30 cells of the throwing outcomes.
"""

from __future__ import annotations

from pathlib import Path

from sgim import algorithms, environments
from sgim.environments.tables import write_table
from sgim.environments.throwing import ThrowingArm
from sgim.environments.throwing_teachers import THROWING_TABLE, select_throws
from sgim.streams import Streams

SEED = 2000
MOVEMENTS = 8000


def main(folder: Path) -> None:
    """Let a learner explore, and write 30 of its throws."""
    arm = ThrowingArm()
    learner = algorithms.make("sagg-riac", arm.task, seed=SEED)
    policies, outcomes = [], []
    for _ in range(MOVEMENTS):
        plan = learner.ask()
        outcome = arm.execute(plan.policy, None, None)
        learner.tell(plan, outcome)
        policies.append(plan.policy)
        outcomes.append(outcome)
    chosen = select_throws(policies, outcomes, Streams(SEED)("throwing teacher"))
    comment = (
        "Made by: python -m sgim.experiments.make_throwing_teacher\n"
        f"30 throws of a SAGG-RIAC learner (sgim 0.1.0, modern, seed {SEED}, {MOVEMENTS} trials),\n"
        "one in each of 30 cells of a 16 x 12 grid over the throwing outcomes."
    )
    write_table(folder / THROWING_TABLE, comment, arm.task.policy_space.describe()["names"], chosen)


if __name__ == "__main__":
    main(Path(environments.__file__).parent / "data")
