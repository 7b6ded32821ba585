"""What is to be learned: the spaces of a world, and nothing about how it works."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any, Protocol

from sgim.errors import SpaceError, unknown
from sgim.records import Goal, Outcome, Trajectory
from sgim.spaces import Box, Space, space_from_description


class Primitive(Protocol):
    """A movement encoding: how a policy becomes a trajectory, and back (the correspondence).

    Attributes:
        joints: Names of the joints that it moves.
        unit: Unit of their positions.
    """

    joints: tuple[str, ...]
    unit: str

    def fit(self, trajectory: Trajectory) -> tuple[Any, float]:
        """The policy that best reproduces a recorded trajectory, and the residual.

        Returns:
            The policy, and the root-mean-square difference in the trajectory's unit.
        """
        ...


class Task:
    """The spaces of a world, as its learner sees them.

    Args:
        policy_space: What can be tried.
        outcome_spaces: Kind → what a trial can produce of that kind.
        goal_spaces: Kind → what can be aimed at. Defaults to the outcome spaces; differs where a
            goal is not an outcome, such as a label to recognise while outcomes are pictures.
        context_space: What can vary from trial to trial without the learner's doing, if anything.
        primitive: Maps demonstrated trajectories to policies, if demonstrations are recorded so.
        tolerances: Kind → distance in the unit box below which a goal counts as reached;
            0.01 for kinds not named.
        sizes: Kind → the size |A_i| of the thesis's eq. 4.2, by which the configuration
            ``thesis`` makes progress comparable between kinds; 1 for kinds not named.
        rest: A policy around which a learner may begin, such as a posture at rest. None if the
            world has none.

    Raises:
        SpaceError: If there is no outcome kind, a tolerance or size is not positive, or the
            policy at rest is not a policy.
        UnknownNameError: If a tolerance or size names no goal kind.
    """

    def __init__(
        self,
        policy_space: Space,
        outcome_spaces: Mapping[str, Space],
        *,
        goal_spaces: Mapping[str, Space] | None = None,
        context_space: Space | None = None,
        primitive: Primitive | None = None,
        tolerances: Mapping[str, float] | None = None,
        sizes: Mapping[str, float] | None = None,
        rest: Any = None,
    ) -> None:
        if not outcome_spaces:
            raise SpaceError("a task needs one or more outcome spaces: {kind: space}")
        self.policy_space = policy_space
        self.outcome_spaces = dict(outcome_spaces)
        self.goal_spaces = dict(outcome_spaces if goal_spaces is None else goal_spaces)
        for kind, space in self.outcome_spaces.items():
            if kind in self.goal_spaces and self.goal_spaces[kind].describe() == space.describe():
                self.goal_spaces[kind] = space  # outcomes of this kind can be goals
        self.context_space = context_space
        self.primitive = primitive
        self.tolerances = self._per_kind("tolerance", tolerances, 0.01)
        self.sizes = self._per_kind("size", sizes, 1.0)
        self.rest: Any = None if rest is None else self.check_policy(rest)

    def _per_kind(
        self, what: str, given: Mapping[str, float] | None, default: float
    ) -> dict[str, float]:
        values = dict.fromkeys(self.goal_spaces, default)
        for kind, value in (given or {}).items():
            if kind not in values:
                raise unknown(f"goal kind (for a {what})", kind, values)
            if not value > 0:
                raise SpaceError(f"{what} of {kind!r} is {value!r}, expected a positive number")
            values[kind] = float(value)
        return values

    def check_policy(self, policy: Any) -> Any:
        """Return ``policy`` as a point within the policy space's bounds, or raise `SpaceError`."""
        point = self.policy_space.check(policy, "policy")
        if not self.policy_space.contains(point):
            raise SpaceError(f"policy {point!r:.200} is outside the bounds of its space")
        return point

    def check_outcome(self, outcome: Outcome) -> dict[str, Any]:
        """Return ``outcome`` with every point checked by its space.

        Raises:
            SpaceError: If it is not a mapping, or a point is malformed.
            UnknownNameError: If a kind is not one of the task's.
        """
        # The exact type first: asking whether it is a mapping takes as long as checking a point.
        if type(outcome) is not dict and not isinstance(outcome, Mapping):
            raise SpaceError(
                f"outcome is a {type(outcome).__name__}, expected a mapping kind → point "
                f"with kinds among {', '.join(self.outcome_spaces)}; {{}} if nothing was produced"
            )
        checked = {}
        for kind, value in outcome.items():
            space = self.outcome_spaces.get(kind)
            if space is None:
                raise unknown("outcome kind", kind, self.outcome_spaces)
            checked[kind] = space.check(value, f"outcome {kind!r}")
        return checked

    def check_outcomes(self, outcomes: Sequence[Outcome]) -> list[dict[str, Any]]:
        """As `check_outcome` for several outcomes."""
        places: dict[str, list[int]] = {}
        for i, outcome in enumerate(outcomes):
            if len(outcomes) == 1 or type(outcome) is not dict:
                return [self.check_outcome(outcome) for outcome in outcomes]
            for kind in outcome:
                places.setdefault(kind, []).append(i)
        checked: list[dict[str, Any]] = [dict.fromkeys(outcome) for outcome in outcomes]
        for kind, members in places.items():
            space = self.outcome_spaces.get(kind)
            if not isinstance(space, Box):
                return [self.check_outcome(outcome) for outcome in outcomes]
            points = space.check_all([outcomes[i][kind] for i in members], f"outcome {kind!r}")
            for i, point in zip(members, points, strict=True):
                checked[i][kind] = point
        return checked

    def check_goal(self, kind: str, point: Any) -> Goal:
        """Return the goal with its point checked by its space."""
        space = self.goal_spaces.get(kind)
        if space is None:
            raise unknown("goal kind", kind, self.goal_spaces)
        return Goal(kind, space.check(point, f"goal {kind!r}"))

    def check_goals(self, kind: str, points: Sequence[Any]) -> list[Goal]:
        """As `check_goal` for several points of one kind."""
        space = self.goal_spaces.get(kind)
        if not isinstance(space, Box):
            return [self.check_goal(kind, point) for point in points]
        return [Goal(kind, point) for point in space.check_all(points, f"goal {kind!r}")]

    def check_context(self, context: Any) -> Any:
        """Return ``context`` checked by its space; None where the task has no context."""
        if self.context_space is None:
            if context is not None:
                raise SpaceError(f"this task has no context space, but context {context!r} came")
            return None
        if context is None:
            raise SpaceError("this task has contexts: pass context=… with what was measured")
        return self.context_space.check(context, "context")

    def describe(self) -> dict[str, Any]:
        """A JSON-compatible description; two tasks are the same if theirs are equal."""
        described = {k: s.describe() for k, s in self.outcome_spaces.items()}
        goals = {k: s.describe() for k, s in self.goal_spaces.items()}
        return {
            "policy": self.policy_space.describe(),
            "outcomes": described,
            "goals": None if goals == described else goals,
            "context": None if self.context_space is None else self.context_space.describe(),
            "tolerances": self.tolerances,
            "sizes": self.sizes,
            **({} if self.rest is None else {"rest": self.policy_space.pack(self.rest).hex()}),
        }


def task_from_description(description: Mapping[str, Any]) -> Task:
    """Make a task again from its description (without its primitive).

    Raises:
        SpaceError: If one of its spaces is not part of the library.
    """
    goals, context = description["goals"], description["context"]
    policy_space, rest = space_from_description(description["policy"]), description.get("rest")
    return Task(
        policy_space,
        {k: space_from_description(s) for k, s in description["outcomes"].items()},
        goal_spaces=goals and {k: space_from_description(s) for k, s in goals.items()},
        context_space=context and space_from_description(context),
        tolerances=description["tolerances"],
        sizes=description["sizes"],
        rest=rest and policy_space.unpack(bytes.fromhex(rest)),
    )
