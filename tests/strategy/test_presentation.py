"""A teacher presents every goal once; then another strategy chooses."""

import numpy as np

from sgim.outcome import EpisodeReport, UniformGoals
from sgim.policy import PolicyOfLabel
from sgim.records import Goal
from sgim.spaces import Choices
from sgim.strategy import JointChoice, Mode, Presentation, Situation
from sgim.streams import Streams

TOYS = Choices(["dog", "car"])
GOALS = [Goal("toy", toy) for toy in TOYS.labels]
PUSH = Mode("push", PolicyOfLabel({toy: f"push {toy}" for toy in TOYS.labels}), 1)
ASK = Mode("ask", PUSH.explorer, 1, teacher="caregiver")


class Reported(UniformGoals):
    def __init__(self) -> None:
        super().__init__({"toy": TOYS})
        self.episodes: list[int] = []

    def update(self, report: EpisodeReport) -> None:
        self.episodes.append(report.episode)


def made(interest: UniformGoals) -> Presentation:
    return Presentation(GOALS, ASK, JointChoice([PUSH, ASK], interest, PUSH))


def test_goals_are_presented_in_turn_and_then_chosen() -> None:
    strategy = made(UniformGoals({"toy": TOYS}))
    chosen = [strategy.choose(Situation(i), Streams(0)("learner", i)) for i in range(60)]
    assert [(c.mode.name, c.goal and c.goal.point) for c in chosen[:2]] == [
        ("ask", "dog"), ("ask", "car")
    ]  # fmt: skip
    later = {(c.mode.name, c.goal and c.goal.point) for c in chosen[2:]}
    assert later == {(mode, toy) for mode in ("push", "ask") for toy in TOYS.labels}


def test_nothing_is_presented_by_a_teacher_who_is_absent() -> None:
    strategy = made(UniformGoals({"toy": TOYS}))
    rng = np.random.default_rng(0)
    assert strategy.choose(Situation(0, {"caregiver"}), rng).mode is PUSH


def test_what_was_presented_is_not_reported() -> None:
    interest = Reported()
    strategy = made(interest)
    for episode in range(4):
        goal = GOALS[episode % 2]
        strategy.update(EpisodeReport(episode, "ask", goal, goal, None, 0.0, 1.0, 1))
    assert interest.episodes == [2, 3]


def test_there_is_one_policy_for_each_label() -> None:
    from sgim.policy import Episode

    episodes = [Episode(i, goal, None, Streams(0)("learner", i)) for i, goal in enumerate(GOALS)]
    assert PUSH.explorer.propose(episodes) == ["push dog", "push car"]
