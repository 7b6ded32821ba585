"""Named learners for tasks whose goals are labels (chapter 2 of the thesis).

=============  ========================  ===============  ============
name           modes                     interest map     strategy
=============  ========================  ===============  ============
random         own actions, ask          uniform          joint choice
sgim-acts      own actions, ask          table            joint choice
oracle         own actions, ask          favours a label  joint choice
=============  ========================  ===============  ============

What is learned is a recogniser. Policies are an action and a label, such as ``push car``; each
action is a mode, but for ``watch``, which is what a teacher lets the learner do. Every teacher is
asked in a mode of its own; the first of them begins by presenting every label once.

Every function takes the arguments of those in `sgim.algorithms`.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping

from sgim.configurations import Configuration, configuration_of
from sgim.errors import SgimError
from sgim.learner import Learner
from sgim.outcome import CompetenceChange, Favourite, InterestMap, InterestTable, UniformGoals
from sgim.parts import Given, Teachers
from sgim.policy import Mimicry, PolicyOfLabel
from sgim.records import Goal
from sgim.spaces import Choices
from sgim.strategy import JointChoice, Mode, Presentation, Strategy
from sgim.task import Task

WATCHING = "watch"
"""The action of policies that only watch what a teacher shows."""

_MakeMap = Callable[[str, Choices, Mapping[str, float], Configuration], InterestMap]


def random_choice(
    task: Task, teachers: Teachers = (), *, configuration: Given = "modern", seed: int = 0
) -> Learner:
    """Any label and any mode, all alike (section 2.3.2)."""
    return _learner(
        "random",
        task,
        teachers,
        configuration,
        seed,
        lambda k, labels, *_: UniformGoals({k: labels}),
    )


def sgim_acts(
    task: Task, teachers: Teachers = (), *, configuration: Given = "modern", seed: int = 0
) -> Learner:
    """Choose label and mode together by interest (algorithms 2.2.1 to 2.2.3)."""

    def table(
        kind: str, labels: Choices, costs: Mapping[str, float], config: Configuration
    ) -> InterestMap:
        return InterestTable(
            kind,
            labels,
            costs,
            CompetenceChange(window=config.label_window, whole=True),
            uniform=config.label_uniform,
            each_first=True,
            pick=config.label_pick,
        )

    return _learner("sgim-acts", task, teachers, configuration, seed, table)


def oracle(
    task: Task, teachers: Teachers = (), *, configuration: Given = "modern", seed: int = 0
) -> Learner:
    """The first label in half of the episodes: a control that knows which is the hardest."""
    return _learner(
        "oracle", task, teachers, configuration, seed, lambda k, labels, *_: Favourite(k, labels)
    )


LABEL_ALGORITHMS = {"random": random_choice, "sgim-acts": sgim_acts, "oracle": oracle}
"""The learners by name."""


def has_labels(task: Task) -> bool:
    """Whether all goals of a task are labels, to be recognised in outcomes that are no goals."""
    labels = all(isinstance(space, Choices) for space in task.goal_spaces.values())
    return labels and not {*task.outcome_spaces} <= {*task.goal_spaces}


def _learner(
    name: str, task: Task, teachers: Teachers, configuration: Given, seed: int, make: _MakeMap
) -> Learner:
    from sgim.recognition.model import RecognitionModel

    config = configuration_of(configuration)
    names = [teachers] if isinstance(teachers, str) else list(teachers)
    kind, labels = _only_labels(task)
    own, asking = _own_modes(task, labels), [_asking(task, teacher) for teacher in names]
    modes = [*own, *asking]
    interest = make(kind, labels, {mode.name: mode.cost for mode in modes}, config)
    strategy: Strategy = JointChoice(modes, interest, own[0])
    if asking:
        goals = [Goal(kind, label) for label in labels.labels]
        strategy = Presentation(goals, asking[0], strategy)
    view = next(k for k in task.outcome_spaces if k != kind)
    recipe = {
        "learner": name,
        "teachers": names,
        "configuration": config.describe(),
        "seed": seed,
    }
    model = RecognitionModel(view, kind, tested=config.label_tested)
    return Learner(task, strategy, model, seed=seed, recipe=recipe)


def _only_labels(task: Task) -> tuple[str, Choices]:
    """The goal kind and its labels."""
    (kind, space), *others = task.goal_spaces.items()
    if others or not isinstance(space, Choices) or not has_labels(task):
        raise SgimError(
            "learners of labels are for tasks with one kind of goal, which are labels, and views "
            f"as outcomes; this one has goals {', '.join(task.goal_spaces)} and outcomes "
            f"{', '.join(task.outcome_spaces)}"
        )
    return kind, space


def _own_modes(task: Task, labels: Choices) -> list[Mode]:
    """A mode for each action but watching, for which there is a policy for every label."""
    policies = task.policy_space
    named = policies.labels if isinstance(policies, Choices) else ()
    actions = dict.fromkeys(policy.partition(" ")[0] for policy in named)
    modes = []
    for action in actions:
        chosen = {label: f"{action} {label}" for label in labels.labels}
        if action != WATCHING and set(chosen.values()) <= {*named}:
            modes.append(Mode(action, PolicyOfLabel(chosen), 1))
    if not modes:
        raise SgimError(
            "learners of labels need policies of an action and a label, such as 'push car', for "
            f"every label; the policy space is {policies!r:.100}"
        )
    return modes


def _asking(task: Task, teacher: str) -> Mode:
    """Ask a teacher to manipulate what the label says, and watch."""
    watch = Mimicry(task.policy_space, 0.0)
    return Mode(f"ask {teacher}", watch, 1, teacher=teacher, uses="both")
