"""Named learners: each a composition of policy level, outcome level and strategy level.

==============================  ====================  ==============  =====================
name                            modes                 interest map    strategy
==============================  ====================  ==============  =====================
random                          random                none            one mode, no goal
random-goal-babbling            autonomous            uniform goals   joint choice
sagg-riac                       autonomous            regions         joint choice
observation                     observe one teacher   uniform goals   always ask
imitation                       imitate one teacher   regions         always ask
sgim-d                          imitate, autonomous   regions         fixed frequency
sgim-im                         imitate, autonomous   regions         ratio of progress
mimicry                         mimic one teacher     regions         joint choice
emulation                       emulate one teacher   regions         joint choice
sgim-acts                       the last two, auton.  regions         joint choice
uniform-choice                  as sgim-acts          uniform goals   joint choice
round-robin                     as sgim-acts          regions         every mode in turn
demonstrations-first            mimic, autonomous     uniform goals   demonstrations first
demonstrations-first-sagg-riac  mimic, autonomous     regions         demonstrations first
sagg-riac-gmm                   autonomous            mixture         at rest, joint choice
sgim-acts-gmm                   emulate, autonomous   mixture         at rest, joint choice
goal-babbling-gmm               autonomous            mixture         at rest, joint choice
==============================  ====================  ==============  =====================

The four before the last two are controls that choosing must beat. Regions are weighed by progress
or by expected gain, as the configuration says, which may also take a mixture instead of them.

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

from collections.abc import Mapping
from typing import Any, Protocol

from sgim.configurations import configuration_of
from sgim.errors import SgimError, unknown
from sgim.labels import LABEL_ALGORITHMS, has_labels
from sgim.learner import Learner
from sgim.mixture_algorithms import goal_babbling_gmm, sagg_riac_gmm, sgim_acts_gmm
from sgim.outcome import UniformGoals
from sgim.parts import Given, MakeMap, Parts, Teachers
from sgim.policy import NoisyNearest, RandomPolicies
from sgim.strategy import (
    Aimless,
    FixedFrequency,
    JointChoice,
    Mode,
    ProgressRatio,
    RoundRobin,
)
from sgim.task import Task


def random_policies(
    task: Task, teachers: Teachers = (), *, configuration: Given = "modern", seed: int = 0
) -> Learner:
    """Random policies, whatever they produce."""
    parts = Parts("random", task, (), configuration, seed)
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
    parts = Parts("random-goal-babbling", task, (), configuration, seed, interest)
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
    parts = Parts("sagg-riac", task, (), configuration, seed, interest)
    alone = parts.autonomous()
    return parts.joint_choice([alone], alone)


def observation(
    task: Task, teachers: Teachers, *, configuration: Given = "modern", seed: int = 0
) -> Learner:
    """Only watch one teacher's demonstrations, without a movement (section 3.3.1)."""
    parts = Parts("observation", task, teachers, configuration, seed)
    alone = Mode("autonomous", RandomPolicies(task.policy_space), 1)
    watching = parts.imitate("observe", 1, uses="both")
    return parts.learner(FixedFrequency(watching, alone, UniformGoals(task.goal_spaces), 1))


def imitation(
    task: Task,
    teachers: Teachers,
    *,
    configuration: Given = "modern",
    seed: int = 0,
    interest: MakeMap | None = None,
) -> Learner:
    """Repeat what one teacher showed, with variations, until he shows the next (section 3.3.1)."""
    parts = Parts("imitation", task, teachers, configuration, seed, interest)
    every, alone = parts.config.demonstration_every, parts.autonomous()
    imitating = parts.imitate("imitate", every)
    return parts.learner(FixedFrequency(imitating, alone, parts.interest_in([alone]), every))


def sgim_d(
    task: Task,
    teachers: Teachers,
    *,
    configuration: Given = "modern",
    seed: int = 0,
    interest: MakeMap | None = None,
) -> Learner:
    """Goal babbling, and a demonstration of one teacher every so often (algorithm 3.1.1)."""
    parts = Parts("sgim-d", task, teachers, configuration, seed, interest)
    alone = parts.autonomous()
    imitating = parts.imitate("imitate", parts.config.mimicry_movements)
    every = parts.config.demonstration_every
    return parts.learner(FixedFrequency(imitating, alone, parts.interest_in([alone]), every))


def sgim_im(
    task: Task,
    teachers: Teachers,
    *,
    configuration: Given = "modern",
    seed: int = 0,
    interest: MakeMap | None = None,
) -> Learner:
    """Goal babbling, or imitation of one teacher while that pays (algorithm 4.2.1)."""
    parts = Parts("sgim-im", task, teachers, configuration, seed, interest)
    alone, config = parts.autonomous(), parts.config
    strategy = ProgressRatio(
        parts.imitate("imitate", config.mimicry_movements),
        alone,
        parts.interest_in([alone]),
        cost=config.request_cost,
        window=config.request_window,
        initiation=config.request_initiation,
        least=config.request_least,
    )
    return parts.learner(strategy)


def mimicry(
    task: Task,
    teachers: Teachers,
    *,
    configuration: Given = "modern",
    seed: int = 0,
    interest: MakeMap | None = None,
) -> Learner:
    """Always mimic one teacher (section 4.3.3.3)."""
    parts = Parts("mimicry", task, teachers, configuration, seed, interest)
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
    parts = Parts("emulation", task, teachers, configuration, seed, interest)
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
    parts = Parts("sgim-acts", task, teachers, configuration, seed, interest)
    return parts.joint_choice(*parts.all_modes())


def uniform_choice(
    task: Task, teachers: Teachers, *, configuration: Given = "modern", seed: int = 0
) -> Learner:
    """Goal, mode and teacher drawn uniformly: no interest at all."""
    parts = Parts("uniform-choice", task, teachers, configuration, seed)
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
    parts = Parts("round-robin", task, teachers, configuration, seed, interest)
    modes, alone = parts.all_modes()
    return parts.learner(RoundRobin(modes, parts.interest_in(modes), alone))


def demonstrations_first(
    task: Task, teachers: Teachers, *, configuration: Given = "modern", seed: int = 0
) -> Learner:
    """All demonstrations first, each mimicked, then goal babbling with uniform goals."""
    parts = Parts("demonstrations-first", task, teachers, configuration, seed)
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
    parts = Parts("demonstrations-first-sagg-riac", task, teachers, configuration, seed, interest)
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
    "observation": observation,
    "imitation": imitation,
    "sgim-d": sgim_d,
    "sgim-im": sgim_im,
    "mimicry": mimicry,
    "emulation": emulation,
    "sgim-acts": sgim_acts,
    "uniform-choice": uniform_choice,
    "round-robin": round_robin,
    "demonstrations-first": demonstrations_first,
    "demonstrations-first-sagg-riac": demonstrations_first_sagg_riac,
    "sagg-riac-gmm": sagg_riac_gmm,
    "sgim-acts-gmm": sgim_acts_gmm,
    "goal-babbling-gmm": goal_babbling_gmm,
}


def algorithms_for(task: Task) -> Mapping[str, Algorithm]:
    """The learners for a task, by name: where all goals are labels, those of `sgim.labels`."""
    return LABEL_ALGORITHMS if has_labels(task) else ALGORITHMS


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
    known = algorithms_for(task)
    if name not in known:
        raise unknown("learner", name, known)
    return known[name](task, teachers, configuration=configuration, seed=seed)


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
