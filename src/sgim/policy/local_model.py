"""Answering by a local model of what policies do, where outcomes are noisy."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np

from sgim.memory.memory import KindMemory
from sgim.policy.answering import Answer, KernelMean, Nearest
from sgim.policy.around import Around, taken
from sgim.policy.learned_smoothness import learned
from sgim.policy.repeats import repeats
from sgim.policy.smoothness import ENOUGH, Smoothness
from sgim.spaces import Box, FloatArray

_DECIDEDLY = 0.5  # Of an error that is known for certain, what another policy may miss by.
_UNSEEN = 2  # How many repeated trials must tell of jumps to be believed half.
_FIRST = 16  # Trials, from which the map is learned first.
_SELDOM = 2  # Doublings after which it is learned again for those who ask at every trial.


class LocalModel:
    """Smooths over like policies, and goes a step further where that is expected to help.

    Of the remembered trials whose outcomes are nearest to the goal, the one is taken whose policy
    is expected to come nearest, in the mean square. What to expect of a policy follows from the
    trials with the nearest *policies*, by a Gaussian process (see `Smoothness`): the outcomes of
    those trials were not selected for being near the goal, so that luck averages out. From there
    Gauss-Newton steps are taken towards the goal, no farther than those policies are, while they
    are expected to come nearer in the mean square. How far the model can be trusted is measured by
    leaving out each of those trials in turn.

    Where a policy always has the outcome that it had, the nearest remembered outcome comes again,
    and another policy is given only where it promises more. The error to be expected is what the
    model misses of like policies, and 1 by the chance that the kind is not produced at all. If the
    world says that it is so (`Memory.declare_deterministic`) that error must be at most half of the
    nearest one's, which is certain then; if there is decidedly no noise in what was tried, less.

    What the map takes for noise may be jumps instead, after which the same outcome comes again,
    unless there is little of it (`Smoothness.may_jump`). Policies that a search tried again tell
    which share is noise. A trial is then expected to produce the mean of the map's and its own
    outcome, weighted by that share and the rest of it, and a step, of which only the map is known,
    has to promise more in spite of where it may jump.

    Where policies or outcomes are not vectors it answers as `Nearest` does. Where there is
    decidedly noise and no map shows, or the map misses most policies by little and a few by much,
    it answers as `KernelMean` does: after some policies outcomes vary much more than after others
    then, or jump, and what like policies did tells that, where a map with one noise for all does
    not. In the second case a trial's own outcome counts too, as it may well come again.

    Args:
        near_outcomes: How many of the nearest outcomes to choose among.
        near_policies: How many of the nearest policies to smooth over.
        like_policies: How many of them foretell how far off an answer may be.
        among: Like policies are sought among so many of the nearest outcomes.
        steps: How many steps to take at most.
    """

    def __init__(
        self,
        near_outcomes: int = 8,
        near_policies: int = 80,
        *,
        like_policies: int = 10,
        among: int = 1000,
        steps: int = 3,
    ) -> None:
        self.near_outcomes = near_outcomes
        self.near_policies = near_policies
        self.like_policies = like_policies
        self.among = among
        self.steps = steps
        self._learned: dict[KindMemory, dict[int, Smoothness | None]] = {}
        self._repeats: dict[KindMemory, tuple[int, int, float]] = {}

    def answers(self, memory: KindMemory, keys: FloatArray) -> list[Answer]:
        """The policy expected to come nearest to each goal."""
        smoothness = self.smoothness(memory)
        if smoothness is None:
            return Nearest().answers(memory, keys)
        if memory.deterministic or smoothness.noiseless:
            if smoothness.mapped:
                return self._surer(memory, keys, smoothness)
            return Nearest().answers(memory, keys)
        if smoothness.trusted:
            heeded = smoothness.enough and memory.ever_failed  # with few trials all may be chance
            return [
                self._answer(memory, key, smoothness, self.near_outcomes, heeded) for key in keys
            ]
        if smoothness.noisy:
            return KernelMean(own=1.0 if smoothness.uneven else 0.0).answers(memory, keys)
        return Nearest().answers(memory, keys)

    def _surer(self, memory: KindMemory, keys: FloatArray, smoothness: Smoothness) -> list[Answer]:
        """The nearest outcome's policy, or another where that promises more."""
        answers = Nearest().answers(memory, keys)
        rows = np.array([answer.row for answer in answers])
        known = np.sqrt(((memory.keys.rows[rows] - keys) ** 2).sum(axis=1))
        worth = (_DECIDEDLY if memory.deterministic else 1.0) * known
        risks = memory.chance_of_failing(memory.encoded_policies(rows), self.near_policies)
        better: dict[int, tuple[Answer, float]] = {}
        for i in np.flatnonzero(risks < worth).tolist():
            found = self._answer(memory, keys[i], smoothness, 1)
            if found.policy is not None:
                may = self.prospects(memory, found, keys[i])
                squares = ((may - keys[i, : may.shape[1]]) ** 2).sum(axis=1)
                better[i] = found, math.sqrt(float(squares.mean()))
        if better:
            tried = np.array([found.policy for found, _ in better.values()])
            risks = memory.chance_of_failing(tried, self.near_policies)
            for (i, (found, miss)), risk in zip(better.items(), risks.tolist(), strict=True):
                if miss + risk < worth[i]:  # a goal whose kind is not produced costs 1
                    answers[i] = found
        return answers

    def smoothness(self, memory: KindMemory, doublings: int = 1) -> Smoothness | None:
        """What is known of the map from policies to outcomes; None if that is not enough.

        It is learned from the first trials, so many that the number depends on how many there are
        and not on when this was asked.

        Args:
            memory: What is remembered of a kind.
            doublings: After how many doublings of the number of trials it is learned again.
        """
        boxes = isinstance(memory.policy_space, Box) and isinstance(memory.space, Box)
        if len(memory) < _FIRST or not boxes:
            return None
        times = (len(memory) // _FIRST).bit_length() - 1
        return self._from(memory, _FIRST << times - times % doublings)

    def _from(self, memory: KindMemory, count: int) -> Smoothness | None:
        """What so many trials teach of the map."""
        known = self._learned.setdefault(memory, {})
        if count not in known:
            outcomes, inputs = taken(memory, slice(0, count))
            found = learned(inputs, outcomes)
            if found is not None:
                tried = int(memory.trials.rows[count - 1]) + 1
                found = replace(found, produced=count / tried)
            known[count] = found
        return known[count]

    def map_of_noisy(self, memory: KindMemory) -> Smoothness | None:
        """The map that answers where outcomes may be noisy; None if there is decidedly no noise.

        It is for those who ask at every trial, and is learned seldom. Where policies have many
        coordinates noise is long undecided, and the map answers all the same.
        """
        if memory.deterministic or len(memory) < ENOUGH:
            return None
        known = self.smoothness(memory, _SELDOM)
        return known if known is not None and not known.noiseless and known.trusted else None

    def prospects(self, memory: KindMemory, answer: Answer, key: FloatArray) -> FloatArray:
        """Outcomes that an answer may produce, each as likely as another.

        What was remembered comes again where there is decidedly no noise. Elsewhere it is what the
        model expects, give or take what it misses of the most alike policies, but as often as
        that was seen to be jumps, what was remembered.

        Args:
            memory: What is remembered of the goal's kind.
            answer: An answer for a goal, in whatever way.
            key: The goal with its context.

        Returns:
            Outcomes in the unit box, shape ``(s, d)``.
        """
        dimension = memory.dimension or 0
        remembered = memory.keys.rows[[answer.row], :dimension]
        smoothness = self.smoothness(memory)
        if smoothness is None:
            return remembered
        if answer.policy is None and (memory.deterministic or smoothness.noiseless):
            return remembered
        policy = answer.policy
        if policy is None:
            policy = memory.encoded_policies(np.array([answer.row]))[0]
        centre = np.concatenate((policy, key[dimension:]))
        _, rows = memory.nearest(key, self.among)
        outcomes, inputs = taken(memory, rows)
        around = Around(inputs, outcomes, centre[None], smoothness, self.near_policies)
        outcomes = around.may_produce(self.like_policies)
        if answer.policy is None:
            comes_again = 1 - self._luck(memory, smoothness)
            outcomes[: round(comes_again * len(outcomes))] = remembered
        return outcomes

    def _answer(
        self,
        memory: KindMemory,
        key: FloatArray,
        smoothness: Smoothness,
        candidates: int,
        failures: bool = False,
    ) -> Answer:
        """The policy expected to come nearest.

        If failures are heeded the chance that it produces nothing of the kind, a cost of 1, is
        added to the distance: where noise decides that, what is remembered is what went well.
        """
        _, rows = memory.nearest(key, self.among)
        outcomes, inputs = taken(memory, rows)
        goal, context = key[: outcomes.shape[1]], key[outcomes.shape[1] :]
        dimension = inputs.shape[1] - len(context)
        centres = inputs[:candidates].copy()
        centres[:, dimension:] = context
        around = Around(inputs, outcomes, centres, smoothness, self.near_policies)

        def risks(policies: FloatArray) -> FloatArray:
            if not failures:
                return np.zeros(len(policies))
            return memory.chance_of_failing(policies, self.like_policies)

        # A trial's outcome is the map's, a jump, which comes again, and noise, which does not.
        luck = self._luck(memory, smoothness)
        jumps = (1 - luck) * smoothness.deviation**2
        mapped, uncertain = around.expected()
        uncertain *= around.variances
        expected = luck * mapped + (1 - luck) * outcomes[:candidates]
        squares = ((expected - goal) ** 2).sum(axis=1) + luck**2 * uncertain + luck * jumps
        costs = np.sqrt(squares) + risks(centres[:, :dimension])
        best = int(np.argmin(costs))
        remembered = Answer(int(rows[best]), None, expected[best])
        # From there, steps by the map alone.
        start, outcome = centres[best, :dimension], mapped[best]
        square = float(((outcome - goal) ** 2).sum() + uncertain[best])
        policy = start
        for _ in range(self.steps):
            stepped = around.step(best, policy - start, goal, outcome)
            if stepped is None or stepped[2] >= square:
                break
            further, outcome, square = stepped
            policy = start + further
        if policy is start:
            return remembered
        if math.sqrt(square + jumps) + float(risks(policy[None])[0]) > costs[best]:
            return remembered
        return Answer(int(rows[best]), policy, outcome)

    def _luck(self, memory: KindMemory, smoothness: Smoothness) -> float:
        """Which share of what the map takes for noise is noise, and not jumps that come again.

        All of it, but for what trials of policies that were tried before tell: those of a search
        that had reason to try them. In other contexts nothing comes again.
        """
        settled = memory.deterministic or smoothness.noiseless or memory.context_space is not None
        if settled or not smoothness.noise or not self._tried_again(memory):
            return 1.0
        known = self._repeats.get(memory)
        if known is None or known[0] != len(memory):
            outcomes, inputs = taken(memory, slice(None))
            known = self._repeats[memory] = (len(memory), *repeats(inputs, outcomes))
        _, again, variance = known
        seen = again * min(variance / smoothness.deviation**2, 1.0)
        return (seen + _UNSEEN) / (again + _UNSEEN)

    def _tried_again(self, memory: KindMemory) -> bool:
        """Whether a search had reason to try policies again (see `map_of_noisy`)."""
        count = ENOUGH
        while count <= len(memory):
            known = self._from(memory, count)
            if known is not None and known.trusted and known.may_jump:
                return True
            count <<= _SELDOM
        return False
