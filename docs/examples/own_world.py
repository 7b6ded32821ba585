"""A world, a teacher and an interest map of one's own, checked and put to use."""

from collections.abc import Sequence

import numpy as np

import sgim
import sgim.testing
from sgim.memory import Memory
from sgim.outcome.interest import EpisodeReport
from sgim.policy.local_search import LocalSearch
from sgim.policy.model import NearestModel
from sgim.policy.simple import Mimicry
from sgim.records import Outcome
from sgim.spaces import FloatArray
from sgim.strategy.modes import Mode
from sgim.strategy.strategy import JointChoice

TABLE = sgim.Box([-1, 0], [1, 1], names=["x", "y"], unit="m")
BRAKING = 3.0  # m/s²: how friction slows a puck down


class PuckTable:
    """A hand pushes a puck over a table of 2 m by 1 m; it may fall off."""

    deterministic = False  # the table is not quite even

    def __init__(self) -> None:
        self.task = sgim.Task(
            sgim.Box([0, 0], [np.pi, 3], names=["direction", "speed"], unit=["rad", "m/s"]),
            {"puck": TABLE},
        )

    def execute(
        self, policy: FloatArray, context: None, rng: np.random.Generator | None
    ) -> Outcome:
        assert rng is not None  # a world that is not deterministic always gets one
        direction, speed = policy
        distance = speed**2 / (2 * BRAKING) * (1 + 0.02 * rng.standard_normal())
        stop = distance * np.array([np.cos(direction), np.sin(direction)])
        return {"puck": stop} if TABLE.contains(stop) else {}


class LeftSider:
    """Pushes well, but only to the left half of the table."""

    def demonstrate(
        self, goal: sgim.Goal | None, rng: np.random.Generator
    ) -> sgim.Demonstration | None:
        if goal is None or goal.point[0] > 0:
            return None
        x, y = goal.point
        policy = [np.arctan2(y, x), np.sqrt(2 * BRAKING * np.hypot(x, y))]
        return sgim.Demonstration({"puck": goal.point}, policy)


class Novelty:
    """Aims, among ten goals, at the one farthest from all that was aimed at before."""

    def __init__(self) -> None:
        self.tried = [TABLE.encode(np.zeros(2))]

    def update(self, report: EpisodeReport) -> None:
        self.tried.append(TABLE.encode(report.pursued.point))

    def choose(
        self, rng: np.random.Generator, modes: Sequence[str], context: None
    ) -> tuple[sgim.Goal, str]:
        goals = [TABLE.sample(rng) for _ in range(10)]
        mode = modes[int(rng.integers(len(modes)))]
        return sgim.Goal("puck", max(goals, key=self.distance)), mode

    def distance(self, point: FloatArray) -> float:
        offsets = np.array(self.tried) - TABLE.encode(point)
        return float(np.hypot(*offsets.T).min())


def check() -> None:
    """Whether the three keep the promises that learners and runs build on."""
    task = PuckTable().task
    sgim.testing.check_environment(PuckTable())
    sgim.testing.check_teacher(LeftSider(), task)
    sgim.testing.check_interest_map(Novelty, task.goal_spaces, ["autonomous", "mimic Ada"])


def make_learner(task: sgim.Task, seed: int) -> sgim.Learner:
    """A learner that searches by itself or mimics Ada, for the goals that are newest."""
    model = NearestModel(Memory(task))
    alone = Mode("autonomous", LocalSearch(model), budget=10)
    mimic = Mode("mimic Ada", Mimicry(task.policy_space, 0.05), budget=3, teacher="Ada")
    strategy = JointChoice([alone, mimic], Novelty(), alone)
    return sgim.Learner(task, strategy, model, seed=seed)


def main() -> None:
    """Check the parts, let the learner push 1000 times, and use what it has learned."""
    check()
    world, ada = PuckTable(), LeftSider()
    learner = make_learner(world.task, seed=7)
    goals = [sgim.Goal("puck", np.array([x, y])) for x in (-0.6, 0, 0.6) for y in (0.2, 0.5, 0.8)]
    benchmark = sgim.Benchmark(goals, world)
    run = sgim.Run(learner, world, {"Ada": ada}, benchmark=benchmark, evaluate_every=250)
    for evaluation in run.go(1000):
        print(f"{evaluation.movements:4} movements, mean error {evaluation.errors['puck']:.4f}")
    solution = learner.solve("puck", [0.4, 0.6])
    print("policy", solution.policy.round(3), "expected", solution.expected.round(3), "m")


if __name__ == "__main__":
    main()
