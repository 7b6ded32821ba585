"""A world with contexts: what differs from trial to trial without the learner's doing."""

from typing import Any

import numpy as np

import sgim
import sgim.testing


class TiltedTable:
    """A puck is pushed along a table that is tilted anew before each trial."""

    deterministic = True

    def __init__(self) -> None:
        self.task = sgim.Task(
            sgim.Box(0, 4, names=["speed"], unit="m/s"),
            {"puck": sgim.Box(0, 2, names=["distance"], unit="m")},
            context_space=sgim.Box(-0.2, 0.2, names=["tilt"], unit="rad"),
        )

    def sample_context(self, rng: np.random.Generator) -> Any:
        return np.clip(rng.normal(0, 0.1, 1), -0.2, 0.2)  # mostly almost level

    def execute(self, policy: Any, context: Any, rng: Any) -> sgim.Outcome:
        return {"puck": policy**2 / (2 * (3 + 9.81 * np.sin(context)))}  # uphill brakes more


def main() -> None:
    """Learn with a run, then with a loop of one's own, and ask for two tilts."""
    world = TiltedTable()
    sgim.testing.check_environment(world)
    learner = sgim.algorithms.make("sagg-riac", world.task, seed=7)
    sgim.Run(learner, world).go(500)  # a run draws the contexts
    plan = learner.ask(context=[0.05])  # a loop of your own measures them
    learner.tell(plan, world.execute(plan.policy, plan.context, None))
    for tilt in (-0.15, 0.15):
        solution = learner.solve("puck", [1.0], context=[tilt])
        speed, distance = solution.policy[0], solution.expected[0]
        print(f"tilt {tilt:+.2f} rad: push at {speed:.2f} m/s to reach {distance:.2f} m")


if __name__ == "__main__":
    main()
