"""Drive a learner from outside, as a real arm would: ``python real_arm.py JOURNAL TRIALS``.

Stop it in any way, or pull the plug, and run it again: it goes on with the same journal.
"""

import sys
import time

import numpy as np

import sgim
from sgim.errors import SgimError
from sgim.primitives import PiecewiseAcceleration
from sgim.records import Outcome
from sgim.teachers import DemonstrationSet

SAMPLES = 50  # a second
LIMIT = 2.5  # rad: farther the shoulder must not turn
PRIMITIVE = PiecewiseAcceleration(segments=4, max_acceleration=8.0, max_duration=0.5)
TASK = sgim.Task(
    PRIMITIVE.policy_space,
    {"drum": sgim.Box([-2, -4], [2, 4], names=["angle", "speed"], unit=["rad", "rad/s"])},
    primitive=PRIMITIVE,
)


class Arm:
    """Stands in for an arm that hits a drum; put the driver of your own in its place."""

    def __init__(self, seconds: float) -> None:
        self.seconds = seconds

    def play(self, wanted: sgim.Trajectory, trial: int) -> sgim.Trajectory:
        """Move, and return what the encoders recorded."""
        rng = np.random.default_rng(trial)
        time.sleep(self.seconds)
        if rng.random() < 0.05:
            raise OSError("the encoder sent nothing")
        positions = wanted.positions + 0.002 * rng.standard_normal(wanted.positions.shape)
        return sgim.Trajectory(wanted.times, positions, wanted.joints)

    def is_paused(self, trial: int) -> bool:
        """Whether somebody holds the pause button."""
        return trial % 40 == 39


def hit(recorded: sgim.Trajectory) -> Outcome:
    """Where the stick was at the end of a movement, and how fast."""
    angle, times = recorded.positions[:, 0], recorded.times
    speed = (angle[-1] - angle[-4]) / (times[-1] - times[-4])
    return {"drum": [angle[-1], speed]}


def recording(angle: float, seconds: float) -> sgim.Demonstration:
    """A person led the arm by the hand, smoothly, up to a hit; read yours from files."""
    times = np.arange(0, seconds, 1 / SAMPLES)
    shown = sgim.Trajectory(times, angle * (times[:, None] / seconds) ** 2, PRIMITIVE.joints)
    return sgim.Demonstration(outcome=hit(shown), trajectory=shown)


def person() -> DemonstrationSet:
    """Shows the recorded movement whose hit comes nearest to the one asked for."""
    pairs = [(angle, seconds) for angle in (-1.8, -1.2, -0.6, 0.6, 1.2, 1.8) for seconds in (1, 2)]
    return DemonstrationSet([recording(*pair) for pair in pairs], TASK)


def planned(plan: sgim.Plan) -> sgim.Trajectory:
    """The movement of a plan; raises if it must not be made."""
    wanted = PRIMITIVE.trajectory(plan.policy, SAMPLES)
    if (farthest := np.abs(wanted.positions).max()) > LIMIT:
        raise SgimError(f"the shoulder would turn to {farthest:.2f} rad, beyond {LIMIT}")
    return wanted


def drive(learner: sgim.Learner, arm: Arm, trials: int) -> None:
    """Carry out plans one by one until there have been so many trials."""
    teacher = person()
    for plan in learner.pending:  # requests that were open when the last process ended
        learner.expire(plan, "nobody was there any more")
    while learner.movements < trials:
        plan = learner.ask()
        if plan.request is not None:
            rng = learner.streams("teacher/person", plan.request.index)
            shown = teacher.demonstrate(plan.request.goal, rng)
            plan = learner.answer(plan, shown, seconds=20.0)
        try:
            wanted = planned(plan)
        except SgimError as error:
            learner.refuse(plan, str(error))
            continue
        if arm.is_paused(plan.id):
            learner.expire(plan, "paused by hand")
            continue
        try:
            recorded = arm.play(wanted, plan.id)
        except OSError as error:
            learner.fail(plan, str(error))
            continue
        learner.tell(plan, hit(recorded), seconds=float(recorded.times[-1]))


def main(path: str, trials: int, seconds: float = 0.0) -> None:
    """Begin a run, or go on with the one that the journal has."""
    learner = sgim.algorithms.make("sgim-acts", TASK, ["person"], seed=7)
    with sgim.keep_journal(learner, path, real=True) as learner:
        print(f"{learner.movements} trials so far", flush=True)
        drive(learner, Arm(seconds), trials)
    solution = learner.solve("drum", [1.0, 2.0])
    print(f"hit with {solution.policy}, expected {solution.expected} ± {solution.spread}")


if __name__ == "__main__":
    main(sys.argv[1], int(sys.argv[2]), *map(float, sys.argv[3:]))
