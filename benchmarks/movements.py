"""Time movements of the worlds of chapters 3 and 4.2, and the learner's share of them.

Run it as ``python benchmarks/movements.py``. The world's time is that of random policies and of
those that SGIM-D tries; the learner's is what a run takes beside: deciding, learning, the teacher
and the journal, without evaluations. The least of several repetitions is printed, beside that of
a fixed loop of small NumPy operations, since other work on the machine only makes them longer.
"""

from __future__ import annotations

import os

for _name in ("OPENBLAS_NUM_THREADS", "OMP_NUM_THREADS", "MKL_NUM_THREADS"):
    os.environ[_name] = "1"

import tempfile
import time
from contextlib import suppress
from pathlib import Path
from typing import Any

import numpy as np
from learner import reference_loop

from sgim.environments import MinimalEnvironment
from sgim.errors import SgimError
from sgim.experiments import experiment
from sgim.records import Outcome

WORLDS = {
    "hockey": ("sgim-d", 2000, 3),
    "fishing": ("sgim-d:D3", 1000, 3),
    "fishing-full": ("sgim-d:D3", 1000, 2),
}
"""Experiment → learner, movements and repetitions."""


def milliseconds(policies: list[np.ndarray], world: MinimalEnvironment) -> float:
    rng = np.random.default_rng(0)
    begun = time.process_time()
    for policy in policies:
        with suppress(SgimError):
            world.execute(policy, None, rng)
    return 1000 * (time.process_time() - begun) / len(policies)


class Timed:
    """A world that adds up the time of its movements, and keeps their policies."""

    def __init__(self, world: MinimalEnvironment) -> None:
        self.world, self.seconds = world, 0.0
        self.task = world.task
        self.deterministic = world.deterministic

    def execute(self, policy: Any, context: Any = None, rng: Any = None) -> Outcome:
        """As the world does."""
        begun = time.process_time()
        try:
            return self.world.execute(policy, context, rng)
        finally:
            self.seconds += time.process_time() - begun


def run(name: str, learner: str, movements: int) -> tuple[float, float]:
    """Milliseconds a movement in a run: of the world, and of all the rest."""
    declared = experiment(name)
    with tempfile.TemporaryDirectory() as folder:
        made = declared.start(learner, Path(folder) / "a.sgim", evaluate_every=10**9)
        made.benchmark, made.world.environment = None, Timed(made.environment)
        with made:
            begun = time.process_time()
            made.go(movements)
            total = time.process_time() - begun
    world = made.world.environment.seconds
    return 1000 * world / movements, 1000 * (total - world) / movements


for name, (learner, movements, repetitions) in WORLDS.items():
    world = experiment(name).environment()
    rng = np.random.default_rng(0)
    drawn = [world.task.policy_space.sample(rng) for _ in range(movements)]
    references, random, moving, learning = [], [], [], []
    for _ in range(repetitions):
        references.append(reference_loop(5000) / 1000)
        random.append(milliseconds(drawn, world))
        spent = run(name, learner, movements)
        moving.append(spent[0])
        learning.append(spent[1])
    print(
        f"{name}: a random movement {min(random):.2f} ms ({min(random) / min(references):.0f} × "
        f"reference), one of {learner} {min(moving):.2f} ms, and {min(learning):.2f} ms of "
        f"learning, {min(learning) / min(moving):.1%} of it"
    )
