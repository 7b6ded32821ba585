"""The suite for explorers, the lower level."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

from sgim.memory import Memory
from sgim.policy.explorer import Episode, Explorer
from sgim.policy.model import NearestModel
from sgim.records import Demonstration, Goal, Trial
from sgim.streams import Streams
from sgim.task import Task
from sgim.testing.made_up import MadeUpWorld
from sgim.testing.promises import require, succeeds

_EPISODES = 7
_ROUNDS = 24
_TRIALS = 40


def check_explorer(
    make_explorer: Callable[[Any], Explorer],
    task: Task,
    *,
    make_model: Callable[[], Any] | None = None,
    seed: int = 0,
) -> None:
    """Check that an explorer keeps the promises of `sgim.policy.explorer.Explorer`.

    Several episodes run side by side in a deterministic world that is made up for the task,
    once with an empty memory and once with a filled one. Some of what is proposed is refused,
    or never heard of again; where the task has contexts, they change.

    Args:
        make_explorer: From a fresh model to an explorer that uses it; called several times.
        task: The task.
        make_model: Makes a fresh competence model; `NearestModel` by default.
        seed: Of the made-up world and of the episodes.

    Raises:
        AssertionError: If a promise is broken.
    """
    for trials in (0, _TRIALS):
        runs = []
        for together, model_first in ((True, False), (True, False), (False, False), (True, True)):
            model = NearestModel(Memory(task)) if make_model is None else make_model()
            with succeeds("make_explorer makes an explorer", "Pass a function of one model"):
                explorer = make_explorer(model)
            run = _Run(explorer, model, MadeUpWorld(task, Streams(seed)))
            proposals = run.proposals(trials, together=together, model_first=model_first)
            runs.append(proposals)
        first, again, alone, ahead = runs
        require(
            first == again,
            "the same episodes get the same proposals, to the last bit",
            _difference(task, first, again),
            "Draw random numbers from episode.rng only",
        )
        require(
            first == alone,
            "what is proposed for an episode does not depend, to the last bit, on the others "
            "proposed for in the same call",
            _difference(task, first, alone),
            "Keep what belongs to an episode in episode.state, and use operations whose rounding "
            "does not depend on the number of episodes",
        )
        require(
            first == ahead,
            "it makes no difference, to the last bit, whether the model already knows the other "
            "trials of a batch when learn is called",
            _difference(task, first, ahead),
            "Ask the model in begin, moved and propose only",
        )


_Proposals = list[tuple[int, int, bytes]]


class _Run:
    def __init__(self, explorer: Explorer, model: Any, world: MadeUpWorld) -> None:
        self.explorer = explorer
        self.model = model
        self.world = world
        self.task = world.task

    def proposals(self, trials: int, *, together: bool, model_first: bool) -> _Proposals:
        """Everything proposed, as (round, episode, packed policy), in order."""
        for number in range(trials):
            self.model.update(self.world.trial(number))
        episodes = [self._begin(number) for number in range(_EPISODES)]
        proposed: _Proposals = []
        for number in range(_ROUNDS):
            policies = self._propose(episodes, together=together)
            told: list[tuple[Episode, Trial | None]] = []
            for episode, policy in zip(episodes, policies, strict=True):
                packed = self._check(episode, policy)
                proposed.append((number, episode.id, packed))
                trial = self._tried(number, episode, self.task.policy_space.unpack(packed))
                told.append((episode, trial))
            if model_first:
                for _, trial in told:
                    if trial is not None:
                        self.model.update(trial)
            for episode, trial in told:
                self._resolve(number, episode, trial, update=not model_first)
            for episode in episodes:
                self._move(number, episode)
            episodes = [e for e in episodes if not self._is_finished(e)]
        return proposed

    def _begin(self, number: int) -> Episode:
        rng = self.world.streams("testing/episode", number)
        kinds = list(self.task.goal_spaces)
        kind = kinds[number % len(kinds)]
        goal = Goal(kind, self.task.goal_spaces[kind].sample(rng))
        context = self.world.context(rng)
        policy = self.task.policy_space.sample(rng)
        episode = Episode(number, goal, context, self.world.streams("testing/search", number))
        outcome = self.world.execute(policy, context)
        episode.demonstration = Demonstration(outcome, policy, teacher="made up")
        episode.before = episode.best = self.model.competence(goal, context)
        with succeeds("begin prepares an episode with a goal", "Also when nothing is known yet"):
            self.explorer.begin(episode)
        return episode

    def _propose(self, episodes: list[Episode], *, together: bool) -> list[Any]:
        if not episodes:
            return []
        with succeeds("propose gives a policy for each episode", "Also when nothing is known yet"):
            if together:
                policies = list(self.explorer.propose(episodes))
            else:  # In another order, so that what episodes share by mistake shows.
                alone = [self.explorer.propose([e])[0] for e in reversed(episodes)]
                policies = list(reversed(alone))
        require(
            len(policies) == len(episodes),
            "propose gives one policy for each episode",
            f"{len(policies)} came for {len(episodes)} episodes",
            "Return a list as long as the episodes",
        )
        return policies

    def _check(self, episode: Episode, policy: Any) -> bytes:
        with succeeds(
            "a proposed policy lies within the bounds of the policy space", "Clip what is proposed"
        ):
            return self.task.policy_space.pack(self.task.check_policy(policy))

    def _tried(self, number: int, episode: Episode, policy: Any) -> Trial | None:
        """What becomes of a plan: mostly a trial; sometimes it is refused, or fails."""
        turn = (number + episode.id) % 6
        if turn in (4, 5):
            return None
        outcome = {} if turn == 3 else self.world.execute(policy, episode.context)
        return Trial(policy, outcome, episode.context)

    def _resolve(self, number: int, episode: Episode, trial: Trial | None, *, update: bool) -> None:
        episode.attempts += 1
        turn = (number + episode.id) % 6
        if turn == 4:
            with succeeds("refuse takes note that a policy must not be executed", "Go on without"):
                self.explorer.refuse(episode)
        if trial is not None:  # Of what failed, an explorer does not hear.
            self._learn(episode, trial, update=update)

    def _move(self, number: int, episode: Episode) -> None:
        turn = (number + episode.id) % 6
        if self.task.context_space is not None and turn == 2:
            episode.context = self.world.context(
                self.world.streams(f"testing/{number}", episode.id)
            )
            with succeeds("begin starts anew when the context has changed", "Replace the state"):
                self.explorer.begin(episode)

    def _learn(self, episode: Episode, trial: Trial, *, update: bool) -> None:
        if update:
            self.model.update(trial)
        episode.movements += 1
        shown = self.model.shown_by(trial, episode.goal, episode.context)
        best = self.model.competence(episode.goal, episode.context) if shown is None else shown
        if episode.best is None or best > episode.best:
            episode.best = best
        with succeeds(
            "learn takes note of any trial of the episode", "Also of one that produced nothing"
        ):
            self.explorer.learn(episode, trial, shown)

    def _is_finished(self, episode: Episode) -> bool:
        if not episode.movements:
            return False
        with succeeds("finished says whether there is nothing left to gain", "Return a bool"):
            return bool(self.explorer.finished(episode))


def _difference(task: Task, one: _Proposals, other: _Proposals) -> str:
    for mine, its in zip(one, other, strict=False):
        if mine != its:
            policies = [task.policy_space.unpack(p[2]) for p in (mine, its)]
            return f"in round {mine[0]} episode {mine[1]} got {policies[0]!r} and {policies[1]!r}"
    return f"{len(one)} proposals came, and {len(other)}"
