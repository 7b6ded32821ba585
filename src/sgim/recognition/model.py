"""The recogniser as what a learner knows: its competence for a label (section 2.2.1)."""

from __future__ import annotations

from typing import Any, Literal

from sgim.recognition.features import Features
from sgim.recognition.recogniser import Recogniser, Recognition
from sgim.records import Goal, Trial

LOWEST = -1.0
"""c₁ of section 2.2.1: the competence of one who is wrong twice, or has seen nothing."""


class RecognitionModel:
    """Learns labelled views from trials, and says how well labels are recognised.

    The competence for a label is that of section 2.2.1 for the latest picture of it. It is above
    −1 by the likelihood with which the picture is recognised, times the number of known views of
    its object, so that it has no upper bound.

    Args:
        view: The outcome kind that holds features.
        label: The outcome kind that says what they are of, and goal kind.
        recogniser: What learns; a new one if None.
        tested: Whether a picture shows competence ``after`` it was learned (algorithm 2.2.1) or
            ``before`` (section 2.1.1).
    """

    def __init__(
        self,
        view: str,
        label: str,
        recogniser: Recogniser | None = None,
        *,
        tested: Literal["after", "before"] = "after",
    ) -> None:
        self.view = view
        self.label = label
        self.tested = tested
        self.recogniser = recogniser or Recogniser()
        self._latest: dict[str, float] = {}

    def update(self, trial: Trial) -> None:
        """Learn the view of a trial, if it has one with a label."""
        if self.view not in trial.outcome or self.label not in trial.outcome:
            return
        label: str = trial.outcome[self.label]
        features = Features.of(trial.outcome[self.view])
        known = label in self.recogniser.labels
        if self.tested == "before" and known:
            self._latest[label] = self.shown(self.recogniser.recognise(features), label)
        self.recogniser.learn(features, label)
        if self.tested == "after" or not known:
            self._latest[label] = self.shown(self.recogniser.recognise(features), label)

    def shown(self, recognition: Recognition, label: str) -> float:
        """The competence γ(b, a) that recognising a picture of an object shows."""
        first, second = recognition.likelihood, recognition.second_likelihood
        views = self.recogniser.known_views(label)
        match (recognition.label == label, recognition.second == label):
            case True, True:
                return views * first + LOWEST
            case True, False:
                return views * first / (1 + second) + LOWEST
            case False, True:
                return views * second / (1 + first) + LOWEST
        return LOWEST

    def competence(self, goal: Goal, context: Any) -> float:
        """Competence for a label: that shown by the latest picture of it; −1 without any."""
        return self._latest.get(goal.point, LOWEST)

    def shown_by(self, trial: Trial, goal: Goal, context: Any) -> None:
        """A trial alone shows nothing: competence is asked for once it has been learned."""
        return
