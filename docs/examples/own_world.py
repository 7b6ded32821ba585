"""A world, a teacher and an interest map of one's own, checked and put to use."""

import sys
from collections.abc import Mapping, Sequence

import numpy as np

import sgim
import sgim.testing
from sgim.memory import Memory
from sgim.outcome import EpisodeReport
from sgim.policy import LocalSearch, Mimicry, NearestModel
from sgim.records import Outcome
from sgim.spaces import FloatArray
from sgim.strategy import JointChoice, Mode

TABLE = sgim.Box([-1, 0], [1, 1], names=["x", "y"], unit="m")
BRAKING = 3.0  # m/s²: how friction slows a puck down


class PuckTable:
    """A hand pushes a puck over a table of 2 m by 1 m; it may fall off."""

    def __init__(self, noise: float = 0.02) -> None:
        self.noise = noise  # the table is not quite even
        self.deterministic = noise == 0
        self.task = sgim.Task(
            sgim.Box([0, 0], [np.pi, 3], names=["direction", "speed"], unit=["rad", "m/s"]),
            {"puck": TABLE},
        )

    def execute(
        self, policy: FloatArray, context: None, rng: np.random.Generator | None
    ) -> Outcome:
        direction, speed = policy
        distance = speed**2 / (2 * BRAKING)
        if not self.deterministic:
            assert rng is not None  # a world that is not deterministic always gets one
            distance *= 1 + self.noise * rng.standard_normal()
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

    def __init__(self, costs: Mapping[str, float]) -> None:
        self.costs = costs  # of each mode: κ, what a movement of it costs
        self.tried = [TABLE.encode(np.zeros(2))]

    def update(self, report: EpisodeReport) -> None:
        self.tried.append(TABLE.encode(report.pursued.point))

    def choose(
        self, rng: np.random.Generator, modes: Sequence[str], context: None
    ) -> tuple[sgim.Goal, str]:
        goals = [TABLE.sample(rng) for _ in range(10)]
        cheap = np.array([1 / self.costs[mode] for mode in modes])
        mode = modes[int(rng.choice(len(modes), p=cheap / cheap.sum()))]
        return sgim.Goal("puck", max(goals, key=self.distance)), mode

    def distance(self, point: FloatArray) -> float:
        offsets = np.array(self.tried) - TABLE.encode(point)
        return float(np.hypot(*offsets.T).min())


def check() -> None:
    """Whether the three keep the promises that learners and runs build on."""
    task = PuckTable().task
    sgim.testing.check_environment(PuckTable())
    sgim.testing.check_teacher(LeftSider(), task)
    costs = {"autonomous": 1.0, "mimic Ada": 2.0}
    sgim.testing.check_interest_map(lambda: Novelty(costs), task.goal_spaces, list(costs))


def make_learner(task: sgim.Task, seed: int) -> sgim.Learner:
    """SGIM-ACTS, but for the goals that are newest."""
    return sgim.algorithms.sgim_acts(task, ["Ada"], seed=seed, interest=Novelty)


def compose_learner(task: sgim.Task, seed: int) -> sgim.Learner:
    """Much the same, composed by hand: search alone, mimic Ada, or emulate her."""
    model = NearestModel(Memory(task))
    search = LocalSearch(model)
    alone = Mode("autonomous", search, budget=10)
    copy = Mimicry(task.policy_space, 0.05)
    mimic = Mode("mimic Ada", copy, budget=3, cost=2, teacher="Ada")
    emulate = Mode("emulate Ada", search, 10, cost=2, teacher="Ada", pursues="demonstrated")
    modes = [alone, mimic, emulate]
    novelty = Novelty({mode.name: mode.cost for mode in modes})
    return sgim.Learner(task, JointChoice(modes, novelty, alone), model, seed=seed)


def main(movements: int, journal: str = "puck.sgim") -> None:
    """Check the parts, let the learner push so many times in all, and use what it has learned."""
    check()
    world, ada = PuckTable(), LeftSider()
    learner = make_learner(world.task, seed=7)
    goals = [sgim.Goal("puck", np.array([x, y])) for x in (-0.6, 0, 0.6) for y in (0.2, 0.5, 0.8)]
    benchmark = sgim.Benchmark(goals, PuckTable(noise=0))
    with sgim.Run(
        learner, world, {"Ada": ada}, journal=journal, benchmark=benchmark, evaluate_every=250
    ) as run:
        print(f"{run.movements:4} movements so far")
        evaluations = run.go(movements)
    for evaluation in evaluations:
        print(f"{evaluation.movements:4} movements, mean error {evaluation.errors['puck']:.4f}")
    puck = sgim.open(journal, learner=make_learner(world.task, seed=7))
    solution = puck.solve("puck", [0.4, 0.6])
    print("policy", solution.policy.round(3), "expected", solution.expected.round(3), "m")


if __name__ == "__main__":
    main(int(sys.argv[1]) if len(sys.argv) > 1 else 1000)
