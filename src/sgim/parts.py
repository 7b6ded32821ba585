"""The parts that named learners are composed of, with the constants of one configuration."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from typing import Literal

from sgim.configurations import Configuration, configuration_of
from sgim.errors import SgimError
from sgim.learner import Learner
from sgim.memory import Memory
from sgim.outcome import (
    AbsoluteProgress,
    ExpectedGain,
    InterestMap,
    MixtureInterest,
    RegionTree,
    UniformGoals,
    WithinReach,
)
from sgim.policy import (
    CompetenceModel,
    CovarianceAdaptation,
    Explorer,
    GuidedSearch,
    LocalSearch,
    MakeDistribution,
    Mimicry,
    MixtureModel,
    NearestModel,
    NelderMeadSearch,
    PathIntegral,
    PopulationSearch,
    answering_of,
    guided_trials,
)
from sgim.strategy import DemonstrationsFirst, JointChoice, Mode, News, Strategy
from sgim.streams import Streams
from sgim.task import Task

Teachers = str | Sequence[str]
MakeMap = Callable[[Mapping[str, float]], InterestMap]
Given = str | Configuration

_DISTRIBUTIONS: dict[str, MakeDistribution] = {"cma-es": CovarianceAdaptation, "pi2": PathIntegral}


class Parts:
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
        self.model = NearestModel(Memory(task), answering_of(self.config.answering))

    def learner(self, strategy: Strategy, model: CompetenceModel | None = None) -> Learner:
        """A learner with this strategy, its recipe, and the nearest neighbours or another model."""
        recipe = {
            "learner": self.name,
            "teachers": self.teachers,
            "configuration": self.config.describe(),
            "seed": self.seed,
        }
        return Learner(
            self.task,
            strategy,
            self.model if model is None else model,
            seed=self.seed,
            recipe=recipe if self.interest is None else None,
        )

    def only_teacher(self) -> str:
        """The teacher's name; `SgimError` if there is not exactly one."""
        if len(self.teachers) != 1:
            raise SgimError(
                f"{self.name} has exactly one teacher, but {len(self.teachers)} are given: "
                f"{', '.join(self.teachers) or 'none'}; name one, as in {self.name}:NAME or "
                "teachers=NAME"
            )
        return self.teachers[0]

    def autonomous(self) -> Mode:
        """Search for the goal chosen."""
        return Mode("autonomous", self._search(), self.config.search_movements)

    def _search(self) -> Explorer:
        config = self.config
        if config.search == "nelder-mead":
            return NelderMeadSearch(self.model)
        if config.search in _DISTRIBUTIONS:
            return PopulationSearch(
                self.model,
                _DISTRIBUTIONS[config.search],
                reached_share=config.reached_share,
            )
        local = LocalSearch(
            self.model,
            budget=config.search_movements,
            reached_share=config.reached_share,
            feeds_map=config.feeds_map,
        )
        trials, if_noisy = guided_trials(config.seconds_per_trial), config.guided_if_noisy
        return GuidedSearch(local, trials, if_noisy=if_noisy) if trials or if_noisy else local

    def _repetition(self) -> Explorer:
        config = self.config
        return Mimicry(
            self.task.policy_space, config.mimicry_radius, exact_first=config.mimicry_exact_first
        )

    def mimic(self, teacher: str) -> Mode:
        """Repeat what the teacher shows for the goal chosen, and pursue that goal."""
        config = self.config
        name, budget = f"mimic {teacher}", config.mimicry_movements
        return Mode(name, self._repetition(), budget, config.social_cost, teacher)

    def imitate(self, verb: str, budget: int, uses: Literal["policy", "both"] = "policy") -> Mode:
        """Repeat what the only teacher shows, and pursue its outcome: mimicry and emulation."""
        teacher = self.only_teacher()
        explorer = self._repetition() if uses == "policy" else Mimicry(self.task.policy_space, 0.0)
        return Mode(
            f"{verb} {teacher}",
            explorer,
            budget,
            teacher=teacher,
            pursues="demonstrated",
            uses=uses,
        )

    def emulate(self, teacher: str, alone: Mode) -> Mode:
        """Search for the outcome that the teacher shows."""
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

    def _within_reach(self) -> WithinReach | None:
        """How goals are drawn where outcomes may be noisy; None if that is not heeded."""

        def deviation(kind: str) -> float | None:
            known = self.model.map_of_noisy(self.model.memory.kinds[kind])
            return None if known is None else known.deviation

        least = self.config.beyond_noise
        return WithinReach(deviation, self.model.surrounded, least=least) if least else None

    def interest_in(self, modes: Sequence[Mode]) -> InterestMap:
        """The interest map over these modes."""
        config, costs = self.config, {mode.name: mode.cost for mode in modes}
        if self.interest is not None:
            return self.interest(costs)
        if config.interest == "uniform":
            return UniformGoals(self.task.goal_spaces)
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
                noisy=self._within_reach(),
            )
        if config.interest == "mixture":
            return self.mixture_interest(costs)
        if config.interest == "alp-gmm":
            return AbsoluteProgress(
                self.task.goal_spaces,
                costs,
                Streams(self.seed),
                context_space=self.task.context_space,
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

    def mixture_interest(
        self, costs: Mapping[str, float], model: MixtureModel | None = None
    ) -> MixtureInterest:
        """The map G_IM of chapter 5; the model's outcomes are its first goals, if there is one."""
        config = self.config
        return MixtureInterest(
            self.task.goal_spaces,
            costs,
            Streams(self.seed),
            context_space=self.task.context_space,
            produced=None if model is None else model.produced,
            recent=None if model is None else model.recent,
            components=config.interest_components,
            window=config.interest_window,
            every=config.interest_every,
            weighting=config.interest_weights,
            uniform_share=config.interest_uniform,
            recent_share=config.interest_recent,
            random_modes=config.interest_random_modes,
        )
