"""A car in a valley, from Gymnasium, that learns where it can be and how fast."""

import sys

import numpy as np

import sgim
from sgim.environments import GymnasiumWorld
from sgim.runs import Benchmark
from sgim.spaces import Box
from sgim.testing import check_environment

STEPS = 80


class Pushes:
    """Eight pushes of ten steps each."""

    policy_space = Box(-1.0, 1.0, names=[f"push_{i + 1}" for i in range(8)])

    def begin(self, policy):
        actions = iter(np.repeat(np.asarray(policy), STEPS // 8)[:, None])
        return lambda observation: next(actions, None)


def where_and_how_fast(rollout):
    """The place on the track, and the speed in hundredths of the track a step, at the end."""
    place, speed = rollout.observations[-1]
    return {"car": np.array([place, 100 * speed], dtype=np.float64)}


def make_world():
    spaces = {"car": Box([-1.2, -7.0], [0.6, 7.0], names=["place", "speed"])}
    return GymnasiumWorld(
        "MountainCarContinuous-v0",
        Pushes(),
        spaces,
        where_and_how_fast,
        options={"low": -0.51, "high": -0.49},
    )


def main(movements: int) -> None:
    world = make_world()
    check_environment(world, trials=3)
    learner = sgim.algorithms.make("sagg-riac", world.task, seed=7)
    goals = [sgim.Goal("car", [place, speed]) for place in (-0.8, -0.2) for speed in (-2, 0, 2)]
    run = sgim.Run(learner, world, benchmark=Benchmark(goals, world), evaluate_every=movements // 4)
    for evaluation in run.go(movements):
        print(f"{evaluation.movements:4d} movements, mean error {evaluation.errors['car']:.4f}")
    answer = learner.solve("car", [-0.2, 0.0])
    print(f"to stop at -0.2, push {np.round(answer.policy, 2)}")


if __name__ == "__main__":
    main(int(sys.argv[1]) if len(sys.argv) > 1 else 400)
