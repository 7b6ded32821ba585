"""The transitions of a learner's state: what it learns from each event.

Nothing here checks what comes from outside or records it; the learner's public face does. Folding
a record goes through the same transitions, so that what was learned comes out the same.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import NamedTuple

from sgim import ledger
from sgim.events import Available, Closed, Demonstrated, Ending, Observed, Suggested
from sgim.ledger import Running
from sgim.openings import Openings
from sgim.outcome.interest import EpisodeReport
from sgim.policy.competence import learn_all
from sgim.records import Demonstration, Plan, Report, Trial


class Remembered(NamedTuple):
    """That a model has taken in a trial, and the competence that it alone shows."""

    shown: float | None


class Transitions(Openings):
    """How a learner's state changes by what it learns."""

    def learn_answers(
        self,
        plans: Sequence[Plan],
        some: Sequence[Running],
        demonstrations: Sequence[Demonstration | None],
    ) -> None:
        """Take up demonstrations, or where there is none, the goal chosen."""
        for plan, running, demonstration in zip(plans, some, demonstrations, strict=True):
            if demonstration is None:
                running.mode = self.strategy.alone
            status = ledger.EXPIRED if demonstration is None else ledger.ANSWERED
            self.ledger.resolve(plan, status)
            running.episode.demonstration = demonstration
        self._take_up(some)

    def remember(
        self, some: Sequence[Running], trials: Sequence[Trial]
    ) -> Sequence[Remembered | None]:
        """Let the model take in the trials of a batch at once, before `learn_trial` for each.

        Returns:
            What it said of each; None for each if it is to take them in one by one.
        """
        shown = None
        if len(trials) > 1:
            aimed = [running.live and running.episode.best is not None for running in some]
            goals = [r.episode.goal if a else None for r, a in zip(some, aimed, strict=True)]
            shown = learn_all(self.model, trials, goals, [r.episode.context for r in some])
        return [None] * len(trials) if shown is None else [Remembered(one) for one in shown]

    def learn_trial(
        self, plan: Plan, running: Running, trial: Trial, remembered: Remembered | None = None
    ) -> Report:
        """Learn from a trial of an open episode.

        Args:
            plan: The plan that was tried.
            running: Its episode.
            trial: What came of it.
            remembered: What the model has said of it, if it has taken it in already.
        """
        self.ledger.resolve(plan, ledger.TOLD)
        if remembered is None:
            self.model.update(trial)
        self.movements += 1
        episode, goal = running.episode, running.episode.goal
        episode.movements += 1
        shown: float | None = None
        if goal is not None and episode.best is not None and running.live:
            if remembered is None:
                shown = self.model.shown_by(trial, goal, episode.context)
            else:
                shown = remembered.shown
            if shown is None:
                episode.best = float(self.model.competence(goal, episode.context))
            elif shown > episode.best:
                episode.best = float(shown)
        try:
            if running.live:
                running.mode.explorer.learn(episode, trial, shown)
        finally:
            closed = self._resolved(running)
        progress = None
        if closed and episode.best is not None and episode.before is not None:
            progress = episode.best - episode.before + episode.gained
        return Report(None if shown is None else -shown, episode.best, closed, progress)

    def learn_end(self, plan: Plan, running: Running, how: Ending) -> None:
        """Resolve a plan that has no outcome."""
        if plan.request is not None:
            self.learn_answers([plan], [running], [None])
            self.ledger.make_idle(running)
            return
        self.ledger.resolve(plan, _STATUS[how])
        if how == "failed":
            self.movements += 1
        elif how == "refused" and running.live:
            running.mode.explorer.refuse(running.episode)
        self._resolved(running)

    def _resolved(self, running: Running) -> bool:
        """After a plan: close its episode if that has ended, else make it idle."""
        episode = running.episode
        episode.attempts += 1
        if not running.live:
            ended = not self.folding
        else:
            ended = episode.attempts >= running.budget or (
                episode.movements > 0 and running.mode.explorer.finished(episode)
            )
        if ended:
            self.close(running)
            return True
        self.ledger.make_idle(running)
        return False

    def close(self, running: Running) -> None:
        """Close an episode, and let the strategy learn from what it came to."""
        e = running.episode
        before = None if e.before is None else e.before - e.gained
        event = Closed(e.id, running.mode.name, e.goal, before, e.best, e.movements)
        self._emit(event)
        self.credit(running, event)

    def credit(self, running: Running, closed: Closed) -> None:
        """Forget a closed episode, and report it to the strategy if it attempted a goal."""
        del self.ledger.running[closed.episode]
        goal, before, after = closed.pursued, closed.before, closed.after
        if goal is None or before is None or after is None or not closed.movements:
            return
        report = EpisodeReport(
            closed.episode,
            closed.mode,
            running.chosen or goal,
            goal,
            running.context,
            before,
            after,
            closed.movements,
            running.episode.demonstration,
        )
        self.strategy.update(report)

    def take_unasked(self, event: Observed | Demonstrated | Suggested | Available) -> None:
        """Fold one message that was not about a plan."""
        self._was_told = True
        match event:
            case Observed(trial):
                self.model.update(trial)
            case Demonstrated(demonstration):
                self._given.append(demonstration)
            case Suggested(goal):
                self._suggestions.append(goal)
            case Available(teacher, yes):
                (self._absent.discard if yes else self._absent.add)(teacher)

    def report_unwritten(self) -> None:
        """Raise if an event could not be written; it has happened, and the journal keeps it."""
        if self._unwritten is not None:
            error, self._unwritten = self._unwritten, None
            raise error


_STATUS = {
    "failed": ledger.FAILED,
    "refused": ledger.REFUSED,
    "expired": ledger.EXPIRED,
    "lost": ledger.LOST,
}
