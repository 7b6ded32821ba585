"""The constants of the learners: `thesis`, as the thesis has them, and `modern`, the default."""

from __future__ import annotations

import json
import math
from collections.abc import Mapping
from dataclasses import asdict, dataclass, replace
from typing import Any, Literal, get_args, get_type_hints

from sgim.errors import SettingError, unknown
from sgim.mixture_settings import MixtureSettings
from sgim.outcome.progress import InterestMeasure, MeanProgress
from sgim.task import Task

_AT_LEAST_ONE = (
    "search_movements",
    "mimicry_movements",
    "progress_window",
    "region_capacity",
    "split_candidates",
    "goals",
    "sharpness",
    "demonstration_every",
    "request_window",
)
_ABOVE_NOTHING = ("social_cost", "progress_scale", "request_cost")


@dataclass(frozen=True, slots=True)
class Configuration(MixtureSettings):
    """Every constant of a learner; nothing in it names a world.

    Those of the learners with Gaussian mixtures are in its base.

    Attributes:
        name: ``"thesis"``, ``"modern"``, or a name of one's own.
        search: The goal-directed explorer: ``"nelder-mead"``, ``"local"``, ``"pi2"``, or
            ``"cma-es"``, which needs the extra ``cma``.
        seconds_per_trial: What a trial may take to decide, in s; 0 if a trial costs little, as in a
            simulator. If it is more, a map over all trials guides the ``"local"`` search while
            they are few: so many that deciding keeps within these seconds (see `guided_trials`).
        guided_if_noisy: How many trials it guides at least, unless the world says that it is
            deterministic.
        answering: Which policy answers a goal: that of the ``"nearest"`` outcome, as in the thesis,
            the most ``"reliable"`` one, the best by a ``"kernel"`` mean, or by a ``"local"`` model.
        search_movements: Movements of an autonomous or emulation episode.
        mimicry_movements: Movements of a mimicry episode (nIm of algorithm 3.2.1).
        mimicry_radius: ε of algorithm 3.2.1, in the policy's own units.
        mimicry_exact_first: Whether the first repetition is without variation.
        social_cost: κ of the modes that ask a teacher; autonomous exploration has 1.
        progress_scale: α_p of eq. 4.2; for interest in ``"progress"``.
        progress_window: δ of eq. 4.3: how many of the latest episodes count.
        region_capacity: Episodes in a region before it is split: of one mode for ``"progress"``
            (g_max of algorithm 4.3.2), of all together for ``"gain"``.
        split_candidates: m of section 4.3.2.4.
        goal_rules: Probabilities of the rules uniform, interesting, worst_point; ``"gain"`` has
            the first two.
        prior: What an untried mode is expected to be worth, before division by its cost: its
            interest for ``"progress"``, the share of what is lacking that a movement removes for
            ``"gain"``.
        staleness: Interest that a pair regains with age, before division by the cost; for
            ``"progress"``.
        credit: Whether progress counts where the goal was ``chosen``, or at what was ``pursued``;
            for ``"progress"``.
        sized: Whether progress is divided by the sizes |A_i| of eq. 4.2, which the task states;
            for ``"progress"``.
        news: Whether requests are given up for exploring alone unless they are expected to bring
            a demonstration not seen before.
        reached_share: Local search ends an episode when its goal is within the task's tolerance
            and its cost at most this share of what it was before.
        feeds_map: Whether local search varies policies, where there is noise, by what suits the map
            that answers, instead of by what is lacking, and tries some again where it may be jumps.
        interest: What makes a goal interesting: recent ``"progress"`` in regions, as in the
            thesis; the ``"gain"`` that is expected of a movement; progress in a ``"mixture"`` over
            time, goals and competence, as in chapter 5; absolute progress, ``"alp-gmm"``; or
            nothing, for controls that do not choose: ``"uniform"``.
        goals: How many goals are drawn to choose among; for ``"gain"``.
        beyond_noise: By how many standard deviations of the noise, along one coordinate, an attempt
            must come nearer to its goal for that not to be luck, where outcomes may be noisy; 0 if
            noise is not heeded; for ``"gain"``.
        sharpness: How much a mode is preferred to those that gain less; for ``"gain"``.
        first_demonstrations: Requests of ``demonstrations-first`` before it explores alone.
        demonstration_every: Movements from one demonstration to the next, M of section 3.3.1;
            for ``sgim-d`` and ``imitation``.
        request_cost: What progress by imitation is divided by, cost of algorithm 4.2.2; for
            ``sgim-im``, as are those that follow.
        request_window: How many of the latest episodes of each mode count, ns.
        request_initiation: Episodes of each mode until which both are chosen alike, nbMin.
        request_least: Least probability of asking, and of not asking.
        label_window: δ of eq. 2.2, even: how many of the latest competences of a label and mode
            count; where goals are labels, as for those that follow.
        label_uniform: p₁ of algorithm 2.2.3: how often any label and mode is chosen.
        label_tested: Whether a picture shows competence for its label ``after`` it was learned or
            ``before``.
        label_pick: Whether labels and modes are drawn in proportion to their interest, or the most
            interesting is taken.
    """

    name: str
    search: Literal["nelder-mead", "local", "cma-es", "pi2"]
    search_movements: int = 20
    mimicry_movements: int = 10
    mimicry_radius: float = 0.05
    mimicry_exact_first: bool = False
    social_cost: float = 2.0
    progress_scale: float = 1000.0
    progress_window: int = 10
    region_capacity: int = 10
    split_candidates: int = 20
    goal_rules: tuple[float, float, float] = (0.05, 0.7, 0.25)
    prior: float = 0.3
    staleness: float = 0.0
    credit: Literal["chosen", "pursued"] = "pursued"
    sized: bool = True
    news: bool = False
    reached_share: float = 0.5
    feeds_map: bool = False
    interest: Literal["progress", "gain", "mixture", "alp-gmm", "uniform"] = "progress"
    goals: int = 3
    beyond_noise: float = 0.0
    sharpness: float = 3.0
    first_demonstrations: int = 100
    demonstration_every: int = 30
    request_cost: float = 100.0
    request_window: int = 20
    request_initiation: int = 10
    request_least: float = 0.1
    label_window: int = 8
    label_uniform: float = 0.3
    label_tested: Literal["after", "before"] = "after"
    label_pick: Literal["proportional", "argmax"] = "proportional"
    answering: Literal["nearest", "reliable", "kernel", "local"] = "nearest"
    seconds_per_trial: float = 0.0
    guided_if_noisy: int = 0

    def __post_init__(self) -> None:
        for name in _AT_LEAST_ONE:
            if not getattr(self, name) >= 1:
                raise SettingError(f"{name} is {getattr(self, name)}, expected 1 or more")
        for name in _ABOVE_NOTHING:
            if not 0 < getattr(self, name) < math.inf:
                raise SettingError(f"{name} is {getattr(self, name)}, expected a positive number")
        if not 0 <= self.seconds_per_trial < math.inf:
            said = self.seconds_per_trial
            raise SettingError(f"seconds_per_trial is {said}, expected seconds, or 0 for little")
        if not 0 <= self.beyond_noise < math.inf:
            said = self.beyond_noise
            raise SettingError(f"beyond_noise is {said}, expected a number of deviations, or 0")
        if self.guided_if_noisy < 0:
            raise SettingError(f"guided_if_noisy is {self.guided_if_noisy}, expected 0 or more")
        self.check_mixtures()

    def measure(self, task: Task) -> InterestMeasure:
        """How progress and interest are measured (eq. 4.2 and 4.3)."""
        sizes = task.sizes if self.sized else dict.fromkeys(task.sizes, 1.0)
        return MeanProgress(sizes, scale=self.progress_scale, window=self.progress_window)

    def describe(self) -> dict[str, Any]:
        """The constants, JSON-compatible."""
        return {**asdict(self), "goal_rules": list(self.goal_rules)}


THESIS = Configuration("thesis", "nelder-mead")
MODERN = Configuration(
    "modern",
    "local",
    search_movements=2,
    mimicry_movements=1,
    mimicry_exact_first=True,
    interest="gain",
    region_capacity=40,
    split_candidates=10,
    goal_rules=(0.1, 0.9, 0.0),
    prior=0.5,
    first_demonstrations=200,
    news=True,
    mixture_starving=0.002,
    mixture_bounds="reflect",
    mixture_answers="memory",
    mixture_scaled=True,
    interest_weights="correlation",
    interest_uniform=0.1,
    interest_recent=0.02,
    interest_random_modes=0.05,
    answering="local",
    feeds_map=True,
    beyond_noise=0.5,
    guided_if_noisy=256,
)
CONFIGURATIONS = {c.name: c for c in (THESIS, MODERN)}


def configuration_of(given: str | Configuration | Mapping[str, Any]) -> Configuration:
    """A configuration by name, as it is, or from what its ``describe`` gave.

    Args:
        given: A name may be followed by settings that differ, as in
            ``"modern,social_cost=20,news=false"``; the whole is the new configuration's name.

    Raises:
        UnknownNameError: If there is no such configuration or setting.
        SettingError: If a setting is not of the form ``name=value``, or its value not of the
            setting's type.
    """
    if isinstance(given, Configuration):
        return given
    if isinstance(given, str):
        base, *settings = (part.strip() for part in given.split(","))
        if base not in CONFIGURATIONS:
            raise unknown("configuration", base, CONFIGURATIONS)
        configuration = CONFIGURATIONS[base]
        changes = dict(_setting(configuration, text) for text in settings)
        if not changes:
            return configuration
        return replace(configuration, **changes, name=",".join([base, *settings]))
    known = Configuration.__dataclass_fields__
    for key in given:
        if key not in known:
            raise unknown("setting of a configuration", key, known)
    return Configuration(**{**given, "goal_rules": tuple(given["goal_rules"])})


def _setting(configuration: Configuration, text: str) -> tuple[str, Any]:
    """Name and value of ``name=value``; the value is written as in JSON, text without quotes."""
    name, equals, written = (part.strip() for part in text.partition("="))
    apart = ("name", "goal_rules")  # The rules are three numbers, with commas between.
    known = [field for field in Configuration.__dataclass_fields__ if field not in apart]
    if name not in known:
        raise unknown("setting of a configuration", name, known)
    present = getattr(configuration, name)
    try:
        value = json.loads(written)
    except json.JSONDecodeError:
        value = written
    if isinstance(present, float) and type(value) is int:
        value = float(value)
    choices = get_args(get_type_hints(Configuration)[name])
    if not equals or type(value) is not type(present) or (choices and value not in choices):
        expected = " or ".join(choices) if choices else f"a value such as {json.dumps(present)}"
        raise SettingError(f"{name} is set by {text!r}, expected {name}= and {expected}")
    return name, value


__all__ = ["CONFIGURATIONS", "Configuration", "configuration_of"]
