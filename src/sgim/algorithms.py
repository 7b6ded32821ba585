"""Named learners: each a composition of policy level, outcome level and strategy level.

==========================  ====================  ==========================  ===================
name                        modes                 interest map                strategy
==========================  ====================  ==========================  ===================
random                      random                none                        one mode, no goal
random-goal-babbling        autonomous            uniform goals               joint choice
sagg-riac                   autonomous            region tree                 joint choice
mimicry                     mimic one teacher     region tree                 joint choice
emulation                   emulate one teacher   region tree                 joint choice
sgim-acts                   all of these          region tree                 joint choice
==========================  ====================  ==========================  ===================
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from typing import Any

from sgim.configurations import Configuration, configuration
from sgim.errors import SgimError, unknown
from sgim.learner import Learner
from sgim.memory import Memory
from sgim.outcome.interest import UniformGoals
from sgim.outcome.region_tree import RegionTree
from sgim.policy.explorer import Explorer
from sgim.policy.local_search import LocalSearch
from sgim.policy.model import NearestModel
from sgim.policy.nelder_mead import NelderMeadSearch
from sgim.policy.simple import Mimicry, NoisyNearest, RandomPolicies
from sgim.strategy.modes import Mode
from sgim.strategy.news import News
from sgim.strategy.strategy import Aimless, JointChoice
from sgim.streams import Streams
from sgim.task import Task


class _Parts:
    """The parts that every composition of one configuration is made of."""

    def __init__(self, task: Task, config: Configuration, seed: int) -> None:
        self.task = task
        self.config = config
        self.streams = Streams(seed)
        self.model = NearestModel(Memory(task))

    def search(self) -> Explorer:
        """The goal-directed explorer."""
        if self.config.search == "nelder-mead":
            return NelderMeadSearch(self.model)
        config = self.config
        return LocalSearch(
            self.model, budget=config.search_movements, tolerance=config.reached_share
        )

    def autonomous(self) -> Mode:
        return Mode("autonomous", self.search(), self.config.search_movements)

    def mimic(self, teacher: str) -> Mode:
        config = self.config
        explorer = Mimicry(
            self.task.policy_space, config.mimicry_radius, exact_first=config.mimicry_exact_first
        )
        return Mode(
            f"mimic {teacher}", explorer, config.mimicry_movements, config.social_cost, teacher
        )

    def emulate(self, teacher: str, search: Explorer) -> Mode:
        config = self.config
        return Mode(
            f"emulate {teacher}",
            search,
            config.search_movements,
            config.social_cost,
            teacher,
            "demonstrated",
        )

    def joint_choice(self, modes: Sequence[Mode], alone: Mode) -> JointChoice:
        """Joint choice over a region tree."""
        config = self.config
        tree = RegionTree(
            self.task.goal_spaces,
            {mode.name: mode.cost for mode in modes},
            config.measure(self.task),
            self.streams,
            context_space=self.task.context_space,
            capacity=config.region_capacity,
            candidates=config.split_candidates,
            probabilities=config.goal_rules,
            prior=config.prior,
            staleness=config.staleness,
            credit=config.credit,
        )
        news = News(self.task.outcome_spaces) if config.news and alone in modes else None
        return JointChoice(modes, tree, alone, news)


def random_policies(parts: _Parts, teachers: Sequence[str]) -> Any:
    """Random policies, whatever they produce."""
    return Aimless(Mode("random", RandomPolicies(parts.task.policy_space), 1, pursues="nothing"))


def random_goal_babbling(parts: _Parts, teachers: Sequence[str]) -> Any:
    """A uniform goal, the nearest remembered policy plus noise, one movement a goal."""
    mode = Mode("autonomous", NoisyNearest(parts.model), 1)
    return JointChoice([mode], UniformGoals(parts.task.goal_spaces), mode)


def sagg_riac(parts: _Parts, teachers: Sequence[str]) -> Any:
    """Goal babbling driven by interest, without teachers (thesis section 3.1.4)."""
    mode = parts.autonomous()
    return parts.joint_choice([mode], mode)


def mimicry(parts: _Parts, teachers: Sequence[str]) -> Any:
    """Always mimic one teacher (section 4.3.3.3)."""
    return parts.joint_choice([parts.mimic(_only(teachers))], parts.autonomous())


def emulation(parts: _Parts, teachers: Sequence[str]) -> Any:
    """Always emulate one teacher (section 4.3.3.3)."""
    alone = parts.autonomous()
    return parts.joint_choice([parts.emulate(_only(teachers), alone.explorer)], alone)


def sgim_acts(parts: _Parts, teachers: Sequence[str]) -> Any:
    """Choose goal, mode and teacher together (algorithm 4.3.1)."""
    alone = parts.autonomous()
    modes = [alone, *(parts.mimic(t) for t in teachers)]
    modes += [parts.emulate(t, alone.explorer) for t in teachers]
    return parts.joint_choice(modes, alone)


def _only(teachers: Sequence[str]) -> str:
    if len(teachers) != 1:
        raise SgimError(
            f"this learner has exactly one teacher, but {len(teachers)} are given: "
            f"{', '.join(teachers) or 'none'}; name one, as in mimicry:T1"
        )
    return teachers[0]


ALGORITHMS: dict[str, Callable[[_Parts, Sequence[str]], Any]] = {
    "random": random_policies,
    "random-goal-babbling": random_goal_babbling,
    "sagg-riac": sagg_riac,
    "mimicry": mimicry,
    "emulation": emulation,
    "sgim-acts": sgim_acts,
}


def make(
    name: str,
    task: Task,
    teachers: Sequence[str] = (),
    *,
    config: str | Configuration = "modern",
    seed: int = 0,
) -> Learner:
    """Make a named learner."""
    if name not in ALGORITHMS:
        raise unknown("learner", name, ALGORITHMS)
    chosen = configuration(config)
    parts = _Parts(task, chosen, seed)
    strategy = ALGORITHMS[name](parts, list(teachers))
    recipe = {
        "learner": name,
        "teachers": list(teachers),
        "configuration": chosen.describe(),
        "seed": seed,
    }
    return Learner(task, strategy, parts.model, seed=seed, recipe=recipe)


def from_recipe(task: Task, recipe: Mapping[str, Any]) -> Learner:
    """Make a learner again from its ``recipe``."""
    return make(
        recipe["learner"],
        task,
        recipe["teachers"],
        config=configuration(recipe["configuration"]),
        seed=recipe["seed"],
    )
