"""What a learner knows: how well it can reach a goal, and the best policy for it."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import Any, NamedTuple

import numpy as np

from sgim.memory import Memory
from sgim.memory.memory import IntArray, KindMemory
from sgim.policy.answering import Answer, Answering, Nearest
from sgim.policy.competence import NoAnswerError
from sgim.policy.local_model import LocalModel
from sgim.policy.smoothness import Smoothness
from sgim.records import Goal, Solution, Trial
from sgim.spaces import BoolArray, Box, FloatArray

_LIKELY = 0.5  # Probability from which on a goal seems reachable.


class _Near(NamedTuple):
    """Distances and rows of what is near to several goals, a line for each; the least distances."""

    distances: FloatArray
    rows: IntArray
    nearest: list[float]


_Found = tuple[Goal, Any, _Near, int]
"""A goal, its context, and where in a `_Near` is what is near to it: the line."""


class NearestModel:
    """Measures competence by the remembered outcome nearest to the goal, and answers from memory.

    The cost of a goal is the distance, in the unit box and at most 1, to the nearest remembered
    outcome of its kind (thesis eq. 3.3); competence is minus that, in [−1, 0] (eq. 3.8).

    Args:
        memory: The memory, which this model fills.
        answering: Which policy to answer with; the nearest outcome's if not said.
    """

    neighbourhood = 80

    def __init__(self, memory: Memory, answering: Answering | None = None) -> None:
        self.memory = memory
        self.answering = Nearest() if answering is None else answering
        self._local = answering if isinstance(answering, LocalModel) else LocalModel()
        self._found: dict[int, _Found] = {}
        self._found_among = 0
        self._goal: tuple[Goal | None, Any, FloatArray] = (None, None, np.empty(0))
        self._last: tuple[Sequence[Trial], dict[tuple[int, str], FloatArray]] = ((), {})

    def update(self, trial: Trial) -> None:
        """Remember the trial."""
        self.memory.add(trial)
        kinds = self.memory.kinds
        keys = {
            (id(trial), kind): kinds[kind].keys.rows[-1]
            for kind in trial.outcome
            if kinds[kind].dimension is not None
        }
        self._last = (trial,), keys

    def learn_all(
        self, trials: Sequence[Trial], goals: Sequence[Goal | None], contexts: Sequence[Any]
    ) -> list[float | None]:
        """Remember the trials; for each, what `shown_by` says of it and its goal."""
        producing = self.memory.extend(trials)
        self._last = trials, {}
        shown: list[float | None] = [None if goal is None else -1.0 for goal in goals]
        for kind, members in producing.items():
            memory = self.memory.kinds[kind]
            if memory.dimension is None:
                continue
            keys = memory.keys.rows[-len(members) :]
            for i, key in zip(members, keys, strict=True):
                self._last[1][id(trials[i]), kind] = key
            pairs = [(row, goals[i]) for row, i in enumerate(members)]
            aimed = [(row, goal) for row, goal in pairs if goal is not None and goal.kind == kind]
            if aimed:
                rows = [row for row, _ in aimed]
                where = [contexts[members[row]] for row in rows]
                wanted = self.memory.keys(kind, [goal.point for _, goal in aimed], where)
                for row, offset in zip(rows, keys[rows] - wanted, strict=True):
                    shown[members[row]] = -min(1.0, math.sqrt(offset.dot(offset)))
        return shown

    def goal_key(self, goal: Goal, context: Any) -> FloatArray:
        """The key of a goal in a context (see `KindMemory`)."""
        if self._goal[0] is not goal or self._goal[1] is not context:
            self._goal = goal, context, self.memory.key(goal.kind, goal.point, context)
        return self._goal[2]

    def key_of(self, trial: Trial, kind: str) -> FloatArray | None:
        """The key of what a trial produced of this kind, if it did."""
        if kind not in trial.outcome:
            return None
        known = self._last[1].get((id(trial), kind))
        if known is not None:
            return known
        return self.memory.key(kind, trial.outcome[kind], trial.context)

    def nearest(self, goal: Goal, context: Any) -> tuple[FloatArray, IntArray]:
        """Distances and rows of the `neighbourhood` outcomes nearest to the goal."""
        ((_, _, near, line),) = self._near([goal], [context])
        return near.distances[line], near.rows[line]

    def nearest_all(
        self, goals: Sequence[Goal], contexts: Sequence[Any]
    ) -> list[tuple[FloatArray, IntArray]]:
        """As `nearest` for several goals, by one query for those of a kind."""
        found = self._near(goals, contexts)
        return [(near.distances[line], near.rows[line]) for _, _, near, line in found]

    def neighbours(
        self, goals: Sequence[Goal], contexts: Sequence[Any]
    ) -> tuple[FloatArray, IntArray]:
        """As `nearest` for several goals of one kind: arrays with a line for each."""
        found = self._near(goals, contexts)
        near, lines = found[0][2], [line for *_, line in found]
        if any(entry[2] is not near for entry in found):
            return (
                np.array([entry[2].distances[entry[3]] for entry in found]),
                np.array([entry[2].rows[entry[3]] for entry in found]),
            )
        if lines == list(range(len(near.rows))):
            return near.distances, near.rows
        return near.distances.take(lines, axis=0), near.rows.take(lines, axis=0)

    def _near(self, goals: Sequence[Goal], contexts: Sequence[Any]) -> list[_Found]:
        """What is near to each goal, by one query for those of a kind; those of last time again."""
        known = self._found if self._found_among == len(self.memory) else {}
        found: list[Any] = [known.get(id(goal)) for goal in goals]
        asked: dict[str, list[int]] = {}
        for i, entry in enumerate(found):
            if entry is None or entry[1] is not contexts[i]:
                asked.setdefault(goals[i].kind, []).append(i)
        if not asked:
            return found
        for kind, members in asked.items():
            near = self._asked(kind, [goals[i] for i in members], [contexts[i] for i in members])
            for line, i in enumerate(members):
                found[i] = goals[i], contexts[i], near, line
        self._found = {id(entry[0]): entry for entry in found}
        self._found_among = len(self.memory)
        return found

    def _asked(self, kind: str, goals: Sequence[Goal], contexts: Sequence[Any]) -> _Near:
        memory = self.memory.kinds[kind]
        if len(goals) == 1:
            one = memory.nearest(self.goal_key(goals[0], contexts[0]), self.neighbourhood)
            distances, rows = one[0][None], one[1][None]
        else:
            keys = self.memory.keys(kind, [goal.point for goal in goals], contexts)
            distances, rows = memory.nearest_batch(keys, self.neighbourhood)
        return _Near(distances, rows, distances[:, :1].ravel().tolist())

    def competence(self, goal: Goal, context: Any) -> float:
        """Minus the distance to the nearest outcome; −1 when the kind was never produced."""
        return self.competences([goal], [context])[0]

    def competences(self, goals: Sequence[Goal], contexts: Sequence[Any]) -> list[float]:
        """As `competence` for several goals."""
        found = self._near(goals, contexts)
        return [
            -min(1.0, near.nearest[line]) if near.nearest else -1.0 for _, _, near, line in found
        ]

    def lacks(self, kind: str, places: FloatArray, context: Any) -> FloatArray:
        """The cost of goals of a kind, in [0, 1]; 1 where it was never produced.

        Args:
            kind: The kind.
            places: The goals, scaled to the unit box, shape ``(m, d)``.
            context: The context of all of them.
        """
        keys = self._keys(kind, places, context)
        costs: FloatArray = np.minimum(self.memory.kinds[kind].gaps(keys), 1.0)
        return costs

    def surrounded(self, kind: str, places: FloatArray, context: Any) -> BoolArray:
        """Whether goals of a kind, as in `lacks`, lie among what was produced, and not beyond."""
        return self.memory.kinds[kind].surrounded(self._keys(kind, places, context))

    def _keys(self, kind: str, places: FloatArray, context: Any) -> FloatArray:
        """The keys of goals, scaled to the unit box of their kind, in a context."""
        task = self.memory.task
        goals, outcomes = task.goal_spaces[kind], task.outcome_spaces[kind]
        if goals is not outcomes:
            assert isinstance(goals, Box)  # others are not scaled
            places = np.array([outcomes.encode(point) for point in goals.decode(places)])
        if task.context_space is None:
            return places
        return np.column_stack(
            (places, np.tile(task.context_space.encode(context), (len(places), 1)))
        )

    def shown_by(self, trial: Trial, goal: Goal, context: Any) -> float:
        """Minus the distance from the trial's outcome to the goal; −1 if it has none."""
        key = self.key_of(trial, goal.kind)
        if key is None:
            return -1.0
        difference = key - self.goal_key(goal, context)
        return -min(1.0, math.sqrt(difference.dot(difference)))

    def smoothness(self, memory: KindMemory) -> Smoothness | None:
        """How smooth the map to a kind's outcomes is, and how noisy; None if little is known."""
        return self._local.smoothness(memory)

    def map_of_noisy(self, memory: KindMemory) -> Smoothness | None:
        """The map that answers where a kind's outcomes are noisy (`LocalModel.map_of_noisy`)."""
        return self._local.map_of_noisy(memory)

    def best_policy(self, goal: Goal, context: Any) -> Any:
        """The policy that the way of answering chooses."""
        return self._policy(goal.kind, self._answer(goal, context))

    def best_policies(self, goals: Sequence[Goal], contexts: Sequence[Any]) -> list[Any]:
        """The policies that the way of answering chooses, all goals at once."""
        if not goals:
            return []
        kind = goals[0].kind
        memory = self.memory.kinds[kind]
        if not len(memory):
            return [None] * len(goals)
        keys = self.memory.keys(kind, [goal.point for goal in goals], contexts)
        return [self._policy(kind, a) for a in self.answering.answers(memory, keys)]

    def _answer(self, goal: Goal, context: Any) -> Answer:
        memory = self.memory.kinds[goal.kind]
        if not len(memory):
            raise NoAnswerError(f"no trial has produced an outcome of kind {goal.kind!r} yet")
        return self.answering.answers(memory, self.goal_key(goal, context)[None])[0]

    def _policy(self, kind: str, answer: Answer) -> Any:
        if answer.policy is not None:
            space = self.memory.task.policy_space
            assert isinstance(space, Box)  # others have no policies between those remembered
            return space.decode(answer.policy)
        return self.memory.policies[int(self.memory.kinds[kind].trials.rows[answer.row])]

    def solve(self, goal: Goal, context: Any, radius: float | None = None) -> Solution:
        """The answer, what it may produce, and whether that lies within a radius of the goal.

        What it may produce is told by how like policies came out (`LocalModel.prospects`). If no
        radius is given, it is the task's tolerance, or twice the distance to which remembered
        outcomes lie apart there, if that is more.
        """
        answer = self._answer(goal, context)
        memory, tolerance = self.memory.kinds[goal.kind], self.memory.task.tolerances[goal.kind]
        space = self.memory.task.outcome_spaces[goal.kind]
        wanted = self.goal_key(goal, context)
        key, expected = memory.keys.rows[answer.row], memory.outcomes[answer.row]
        if answer.expected is not None:
            assert isinstance(space, Box)  # others have no outcomes between those remembered
            key = np.append(answer.expected, wanted[len(answer.expected) :])
            expected = space.decode(answer.expected)
        # Summed as the index does, so that the nearest outcome costs what competence says.
        cost = min(1.0, math.sqrt(sum(x * x for x in (key - wanted).tolist())))
        if radius is None:
            apart, _ = memory.nearest(memory.keys.rows[answer.row], 6)
            radius = max(tolerance, 2 * float(apart[-1]))
        may = self._local.prospects(memory, answer, wanted)
        spread = may.std(axis=0, ddof=min(1, len(may) - 1))
        within = ((may - wanted[: may.shape[1]]) ** 2).sum(axis=1) <= radius**2
        probability = float(within.mean())
        if len(may) > 1:  # Never quite sure of what was seen to vary.
            probability = (float(within.sum()) + 0.5) / (len(may) + 1)
        return Solution(
            self._policy(goal.kind, answer),
            expected,
            cost,
            spread * getattr(space, "range", 1.0),
            probability >= _LIKELY,
            radius,
            probability,
        )
