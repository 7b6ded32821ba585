"""The constants of the learners with Gaussian mixtures, a part of every configuration."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Literal

from sgim.errors import SettingError

_COUNTS = (
    "mixture_components",
    "mixture_every",
    "mixture_lifetime",
    "interest_components",
    "interest_window",
    "interest_every",
)
_SHARES = ("mixture_starving", "interest_uniform", "interest_recent", "interest_random_modes")


@dataclass(frozen=True, slots=True, kw_only=True)
class MixtureSettings:
    """Constants of ``sagg-riac-gmm`` and ``sgim-acts-gmm`` (chapter 5).

    Attributes:
        mixture_components: Gaussians in the joint model of policies and outcomes, G_SM.
        mixture_every: Trials between two updates of it.
        mixture_first_rate: Weight α of an update's trials against all before, at first.
        mixture_last_rate: The same at the end; it falls logarithmically.
        mixture_lifetime: Trials after which it falls no more.
        mixture_starving: Weight below which a component is given half of the heaviest one.
        mixture_bounds: What becomes of policies drawn outside their bounds.
        mixture_answers: Whether goals are answered from ``memory``, as other learners do, or
            with the ``mixture``.
        mixture_scaled: Whether competence is measured with outcomes scaled to [−1, 1]; else in
            their own units.
        rest_trials: Trials around the policy at rest, with which learning begins.
        rest_spread: Their standard deviation, as a share of each policy coordinate's range.
        interest_components: Gaussians in the interest model, G_IM.
        interest_window: Latest episodes that it is fitted to.
        interest_every: Episodes between two fits.
        interest_weights: What its components' weights are multiplied by: the positive part of the
            ``covariance`` of time and competence, or of their ``correlation``, or ``none``: goals
            that ignore progress.
        interest_uniform: Probability that a goal is drawn from the whole goal space instead.
        interest_recent: Probability that a goal is a recent outcome, with noise.
        interest_random_modes: Probability that the mode is drawn from all alike.
    """

    mixture_components: int = 28
    mixture_every: int = 400
    mixture_first_rate: float = 0.1
    mixture_last_rate: float = 0.01
    mixture_lifetime: int = 240_000
    mixture_starving: float = 0.0
    mixture_bounds: Literal["clip", "reflect"] = "clip"
    mixture_answers: Literal["mixture", "memory"] = "mixture"
    mixture_scaled: bool = False
    rest_trials: int = 400
    rest_spread: float = 0.042
    interest_components: int = 6
    interest_window: int = 2000
    interest_every: int = 400
    interest_weights: Literal["covariance", "correlation", "none"] = "covariance"
    interest_uniform: float = 0.0
    interest_recent: float = 0.0
    interest_random_modes: float = 0.0

    def check_mixtures(self) -> None:
        """Raise `SettingError` if one of these constants is out of its range."""
        for name in _COUNTS:
            if not getattr(self, name) >= 1:
                raise SettingError(f"{name} is {getattr(self, name)}, expected 1 or more")
        for name in _SHARES:
            if not 0 <= getattr(self, name) <= 1:
                raise SettingError(f"{name} is {getattr(self, name)}, expected a share in [0, 1]")
        for name in ("mixture_first_rate", "mixture_last_rate"):
            if not 0 < getattr(self, name) <= 1:
                raise SettingError(f"{name} is {getattr(self, name)}, expected one in (0, 1]")
        if self.rest_trials < 0 or not 0 <= self.rest_spread < math.inf:
            raise SettingError("rest_trials and rest_spread must be 0 or more")
