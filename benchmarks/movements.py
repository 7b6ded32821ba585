"""Time movements of the worlds of chapters 3 and 4.2, and the learner's share of them.

Run it as ``python benchmarks/movements.py``. The world's time is that of random policies and of
those that SGIM-D tries; the learner's is what a run takes beside: deciding, learning, the teacher
and the journal, without evaluations; the task's primitive, which maps recordings to policies, is
counted apart. A run of the fishing rod is as long as in the experiment, since what is learned about
noise is learned seldom. The least of several repetitions is printed, beside that of a fixed loop of
small NumPy operations, since other work on the machine only makes them longer.
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
    "fishing": ("sgim-d:D3", 5000, 2),
    "fishing-full": ("sgim-d:D3", 5000, 1),
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


class TimedFits:
    """A primitive that adds up the time of its fits."""

    def __init__(self, primitive: Any) -> None:
        self.primitive, self.seconds = primitive, 0.0

    def __getattr__(self, name: str) -> Any:
        return getattr(self.primitive, name)

    def fit(self, trajectory: Any) -> Any:
        """As the primitive does."""
        begun = time.process_time()
        try:
            return self.primitive.fit(trajectory)
        finally:
            self.seconds += time.process_time() - begun


def run(name: str, learner: str, movements: int) -> tuple[float, float, float]:
    """Milliseconds a movement in a run: of the world, of the primitive's fits, and of the rest."""
    declared = experiment(name)
    with tempfile.TemporaryDirectory() as folder:
        made = declared.start(learner, Path(folder) / "a.sgim", evaluate_every=10**9)
        made.benchmark, made.world.environment = None, Timed(made.environment)
        fits = TimedFits(made.learner.task.primitive)
        made.learner.task.primitive = fits if fits.primitive is not None else None
        with made:
            begun = time.process_time()
            made.go(movements)
            total = time.process_time() - begun
    world, mapping = made.world.environment.seconds, fits.seconds
    each = 1000 / movements
    return each * world, each * mapping, each * (total - world - mapping)


for name, (learner, movements, repetitions) in WORLDS.items():
    world = experiment(name).environment()
    rng = np.random.default_rng(0)
    drawn = [world.task.policy_space.sample(rng) for _ in range(1000)]
    references, random = [], []
    moving: list[float] = []
    mapping: list[float] = []
    learning: list[float] = []
    for _ in range(repetitions):
        references.append(reference_loop(5000) / 1000)
        random.append(milliseconds(drawn, world))
        spent = run(name, learner, movements)
        for times, each in zip((moving, mapping, learning), spent, strict=True):
            times.append(each)
    reference, most = min(references), min(moving)
    print(
        f"{name}: a random movement {min(random):.2f} ms ({min(random) / reference:.0f} × "
        f"reference), one of {learner} {most:.2f} ms ({most / reference:.0f} ×), "
        f"{min(learning):.2f} ms of learning, {min(learning) / most:.1%} of it, and "
        f"{min(mapping):.2f} ms of mapping recordings to policies"
    )
