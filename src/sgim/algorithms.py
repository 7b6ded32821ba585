"""Named learners: each a composition of policy level, outcome level and strategy level.

==============================  ====================  ==============  ====================
name                            modes                 interest map    strategy
==============================  ====================  ==============  ====================
random                          random                none            one mode, no goal
random-goal-babbling            autonomous            uniform goals   joint choice
sagg-riac                       autonomous            regions         joint choice
mimicry                         mimic one teacher     regions         joint choice
emulation                       emulate one teacher   regions         joint choice
sgim-acts                       all of these          regions         joint choice
uniform-choice                  all of these          uniform goals   joint choice
round-robin                     all of these          regions         every mode in turn
demonstrations-first            mimic, autonomous     uniform goals   demonstrations first
demonstrations-first-sagg-riac  mimic, autonomous     regions         demonstrations first
==============================  ====================  ==============  ====================

The last four are controls that choosing must beat. Regions are weighed by progress or by expected
gain, as the configuration says.

Every function takes the same arguments:

* ``task``: the spaces of the world;
* ``teachers``: names of the teachers that may be asked, one name or several;
* ``configuration``: ``"modern"``, ``"thesis"``, or a `Configuration`;
* ``seed``: of all the learner's random streams;
* ``interest``: where given, makes the interest map from ``{mode: cost}`` instead of the
  algorithm's own; a learner with one has no recipe, so that whoever opens its journal again must
  pass the learner.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from typing import Any, Protocol

from sgim.configurations import Configuration, configuration_of
from sgim.errors import SgimError, unknown
from sgim.learner import Learner
from sgim.memory import Memory
from sgim.outcome import ExpectedGain, InterestMap, RegionTree, UniformGoals
from sgim.policy import (
    Explorer,
    LocalSearch,
    Mimicry,
    NearestModel,
    NelderMeadSearch,
    NoisyNearest,
    RandomPolicies,
)
from sgim.strategy import (
    Aimless,
    DemonstrationsFirst,
    JointChoice,
    Mode,
    News,
    RoundRobin,
    Strategy,
)
from sgim.streams import Streams
from sgim.task import Task

Teachers = str | Sequence[str]
MakeMap = Callable[[Mapping[str, float]], InterestMap]
Given = str | Configuration


def random_policies(
    task: Task, teachers: Teachers = (), *, configuration: Given = "modern", seed: int = 0
) -> Learner:
    """Random policies, whatever they produce."""
    parts = _Parts("random", task, (), configuration, seed)
    mode = Mode("random", RandomPolicies(task.policy_space), 1, pursues="nothing")
    return parts.learner(Aimless(mode))


def random_goal_babbling(
    task: Task,
    teachers: Teachers = (),
    *,
    configuration: Given = "modern",
    seed: int = 0,
    interest: MakeMap | None = None,
) -> Learner:
    """A uniform goal, the nearest remembered policy plus noise, one movement a goal."""
    parts = _Parts("random-goal-babbling", task, (), configuration, seed, interest)
    mode = Mode("autonomous", NoisyNearest(parts.model), 1)
    uniform = UniformGoals(task.goal_spaces)
    made = uniform if interest is None else interest({mode.name: mode.cost})
    return parts.learner(JointChoice([mode], made, mode))


def sagg_riac(
    task: Task,
    teachers: Teachers = (),
    *,
    configuration: Given = "modern",
    seed: int = 0,
    interest: MakeMap | None = None,
) -> Learner:
    """Goal babbling driven by interest, without teachers (thesis section 3.1.4)."""
    parts = _Parts("sagg-riac", task, (), configuration, seed, interest)
    alone = parts.autonomous()
    return parts.joint_choice([alone], alone)


def mimicry(
    task: Task,
    teachers: Teachers,
    *,
    configuration: Given = "modern",
    seed: int = 0,
    interest: MakeMap | None = None,
) -> Learner:
    """Always mimic one teacher (section 4.3.3.3)."""
    parts = _Parts("mimicry", task, teachers, configuration, seed, interest)
    return parts.joint_choice([parts.mimic(parts.only_teacher())], parts.autonomous())


def emulation(
    task: Task,
    teachers: Teachers,
    *,
    configuration: Given = "modern",
    seed: int = 0,
    interest: MakeMap | None = None,
) -> Learner:
    """Always emulate one teacher (section 4.3.3.3)."""
    parts = _Parts("emulation", task, teachers, configuration, seed, interest)
    alone = parts.autonomous()
    return parts.joint_choice([parts.emulate(parts.only_teacher(), alone)], alone)


def sgim_acts(
    task: Task,
    teachers: Teachers,
    *,
    configuration: Given = "modern",
    seed: int = 0,
    interest: MakeMap | None = None,
) -> Learner:
    """Choose goal, mode and teacher together (algorithm 4.3.1)."""
    parts = _Parts("sgim-acts", task, teachers, configuration, seed, interest)
    return parts.joint_choice(*parts.all_modes())


def uniform_choice(
    task: Task, teachers: Teachers, *, configuration: Given = "modern", seed: int = 0
) -> Learner:
    """Goal, mode and teacher drawn uniformly: no interest at all."""
    parts = _Parts("uniform-choice", task, teachers, configuration, seed)
    modes, alone = parts.all_modes()
    return parts.learner(JointChoice(modes, UniformGoals(task.goal_spaces), alone))


def round_robin(
    task: Task,
    teachers: Teachers,
    *,
    configuration: Given = "modern",
    seed: int = 0,
    interest: MakeMap | None = None,
) -> Learner:
    """Every mode in turn, each for a goal that is interesting to pursue by it."""
    parts = _Parts("round-robin", task, teachers, configuration, seed, interest)
    modes, alone = parts.all_modes()
    return parts.learner(RoundRobin(modes, parts.interest_in(modes), alone))


def demonstrations_first(
    task: Task, teachers: Teachers, *, configuration: Given = "modern", seed: int = 0
) -> Learner:
    """All demonstrations first, each mimicked, then goal babbling with uniform goals."""
    parts = _Parts("demonstrations-first", task, teachers, configuration, seed)
    return parts.demonstrations_first(UniformGoals(task.goal_spaces))


def demonstrations_first_sagg_riac(
    task: Task,
    teachers: Teachers,
    *,
    configuration: Given = "modern",
    seed: int = 0,
    interest: MakeMap | None = None,
) -> Learner:
    """All demonstrations first, each mimicked, then goal babbling driven by interest."""
    parts = _Parts("demonstrations-first-sagg-riac", task, teachers, configuration, seed, interest)
    return parts.demonstrations_first(parts.interest_in([parts.autonomous()]))


class Algorithm(Protocol):
    """A function of this module that makes a learner."""

    def __call__(
        self, task: Task, teachers: Teachers, *, configuration: Given, seed: int
    ) -> Learner:
        """Make the learner."""
        ...


ALGORITHMS: dict[str, Algorithm] = {
    "random": random_policies,
    "random-goal-babbling": random_goal_babbling,
    "sagg-riac": sagg_riac,
    "mimicry": mimicry,
    "emulation": emulation,
    "sgim-acts": sgim_acts,
    "uniform-choice": uniform_choice,
    "round-robin": round_robin,
    "demonstrations-first": demonstrations_first,
    "demonstrations-first-sagg-riac": demonstrations_first_sagg_riac,
}


def make(
    name: str,
    task: Task,
    teachers: Teachers = (),
    *,
    configuration: Given = "modern",
    seed: int = 0,
) -> Learner:
    """Make a learner by its name.

    Raises:
        UnknownNameError: If there is no such learner or configuration.
        SgimError: If the learner needs other teachers.
    """
    if name not in ALGORITHMS:
        raise unknown("learner", name, ALGORITHMS)
    return ALGORITHMS[name](task, teachers, configuration=configuration, seed=seed)


def from_recipe(task: Task, recipe: Mapping[str, Any]) -> Learner:
    """Make a learner again from its ``recipe``.

    Raises:
        SgimError: If the recipe is not one that this module wrote.
    """
    missing = {"learner", "teachers", "configuration", "seed"} - set(recipe)
    if missing:
        raise SgimError(f"the recipe lacks {', '.join(sorted(missing))}: it is not the library's")
    return make(
        recipe["learner"],
        task,
        recipe["teachers"],
        configuration=configuration_of(recipe["configuration"]),
        seed=recipe["seed"],
    )


class _Parts:
    """The parts that every composition of one configuration is made of."""

    def __init__(
        self,
        name: str,
        task: Task,
        teachers: Teachers,
        configuration: Given,
        seed: int,
        interest: MakeMap | None = None,
    ) -> None:
        self.name = name
        self.task = task
        self.teachers = [teachers] if isinstance(teachers, str) else list(teachers)
        self.config = configuration_of(configuration)
        self.seed = seed
        self.interest = interest
        self.model = NearestModel(Memory(task))

    def learner(self, strategy: Strategy) -> Learner:
        recipe = {
            "learner": self.name,
            "teachers": self.teachers,
            "configuration": self.config.describe(),
            "seed": self.seed,
        }
        return Learner(
            self.task,
            strategy,
            self.model,
            seed=self.seed,
            recipe=recipe if self.interest is None else None,
        )

    def only_teacher(self) -> str:
        if len(self.teachers) != 1:
            raise SgimError(
                f"{self.name} has exactly one teacher, but {len(self.teachers)} are given: "
                f"{', '.join(self.teachers) or 'none'}; name one, as in {self.name}:NAME or "
                "teachers=NAME"
            )
        return self.teachers[0]

    def autonomous(self) -> Mode:
        return Mode("autonomous", self._search(), self.config.search_movements)

    def _search(self) -> Explorer:
        config = self.config
        if config.search == "nelder-mead":
            return NelderMeadSearch(self.model)
        return LocalSearch(
            self.model, budget=config.search_movements, reached_share=config.reached_share
        )

    def mimic(self, teacher: str) -> Mode:
        config = self.config
        explorer = Mimicry(
            self.task.policy_space, config.mimicry_radius, exact_first=config.mimicry_exact_first
        )
        return Mode(
            f"mimic {teacher}", explorer, config.mimicry_movements, config.social_cost, teacher
        )

    def emulate(self, teacher: str, alone: Mode) -> Mode:
        return Mode(
            f"emulate {teacher}",
            alone.explorer,
            alone.budget,
            self.config.social_cost,
            teacher,
            "demonstrated",
        )

    def all_modes(self) -> tuple[list[Mode], Mode]:
        """Autonomous exploration, mimicry and emulation of every teacher; and the first of them."""
        if not self.teachers:
            raise SgimError(
                f"{self.name} chooses among teachers: name one or more, or use sagg-riac"
            )
        alone = self.autonomous()
        modes = [alone, *(self.mimic(t) for t in self.teachers)]
        return [*modes, *(self.emulate(t, alone) for t in self.teachers)], alone

    def joint_choice(self, modes: Sequence[Mode], alone: Mode) -> Learner:
        """A learner that chooses among modes by interest."""
        news = News(self.task.outcome_spaces) if self.config.news and alone in modes else None
        return self.learner(JointChoice(modes, self.interest_in(modes), alone, news))

    def demonstrations_first(self, interest: InterestMap) -> Learner:
        """A learner that asks every teacher in turn, then explores alone."""
        if not self.teachers:
            raise SgimError(f"{self.name} begins by asking: name one or more teachers")
        return self.learner(
            DemonstrationsFirst(
                [self.mimic(t) for t in self.teachers],
                self.config.first_demonstrations,
                UniformGoals(self.task.goal_spaces),
                self.autonomous(),
                interest,
            )
        )

    def interest_in(self, modes: Sequence[Mode]) -> InterestMap:
        """The interest map over these modes."""
        config, costs = self.config, {mode.name: mode.cost for mode in modes}
        if self.interest is not None:
            return self.interest(costs)
        if config.interest == "gain":
            return ExpectedGain(
                self.task.goal_spaces,
                costs,
                self.model.lacks,
                Streams(self.seed),
                context_space=self.task.context_space,
                capacity=config.region_capacity,
                candidates=config.split_candidates,
                window=config.progress_window,
                prior=config.prior,
                sharpness=config.sharpness,
                uniform=config.goal_rules[0],
                goals=config.goals,
            )
        return RegionTree(
            self.task.goal_spaces,
            costs,
            config.measure(self.task),
            Streams(self.seed),
            context_space=self.task.context_space,
            capacity=config.region_capacity,
            candidates=config.split_candidates,
            probabilities=config.goal_rules,
            prior=config.prior,
            staleness=config.staleness,
            credit=config.credit,
        )
