"""The learners of chapter 5, whose model and interest are Gaussian mixtures."""

from __future__ import annotations

from dataclasses import replace

from sgim.configurations import configuration_of
from sgim.errors import SgimError
from sgim.learner import Learner
from sgim.parts import Given, MakeMap, Parts, Teachers
from sgim.policy import AroundRest, Learning, MixtureModel, MixtureSearch
from sgim.strategy import JointChoice, Mode, RestFirst
from sgim.streams import Streams
from sgim.task import Task


def sagg_riac_gmm(
    task: Task,
    teachers: Teachers = (),
    *,
    configuration: Given = "modern",
    seed: int = 0,
    interest: MakeMap | None = None,
) -> Learner:
    """Goal babbling with mixtures, without teachers (algorithm 5.2.1)."""
    return _composed(Parts("sagg-riac-gmm", task, (), configuration, seed, interest))


def goal_babbling_gmm(
    task: Task,
    teachers: Teachers = (),
    *,
    configuration: Given = "modern",
    seed: int = 0,
    interest: MakeMap | None = None,
) -> Learner:
    """As sagg-riac-gmm, but its goals ignore progress: a control."""
    config = replace(configuration_of(configuration), interest_weights="none")
    return _composed(Parts("goal-babbling-gmm", task, (), config, seed, interest))


def sgim_acts_gmm(
    task: Task,
    teachers: Teachers,
    *,
    configuration: Given = "modern",
    seed: int = 0,
    interest: MakeMap | None = None,
) -> Learner:
    """Goal babbling with mixtures, or emulation of what a teacher shows (algorithm 5.2.2)."""
    parts = Parts("sgim-acts-gmm", task, teachers, configuration, seed, interest)
    if not parts.teachers:
        raise SgimError("sgim-acts-gmm emulates: name one or more teachers, or use sagg-riac-gmm")
    return _composed(parts)


def _composed(parts: Parts) -> Learner:
    """One movement a goal; the policy is drawn from the joint mixture, given the goal."""
    config, task = parts.config, parts.task
    learning = Learning(
        components=config.mixture_components,
        every=config.mixture_every,
        first_rate=config.mixture_first_rate,
        last_rate=config.mixture_last_rate,
        lifetime=config.mixture_lifetime,
        starving=config.mixture_starving,
    )
    model = MixtureModel(
        task,
        Streams(parts.seed),
        learning,
        nearest=parts.model if config.mixture_answers == "memory" else None,
        scaled=config.mixture_scaled,
    )
    around = AroundRest(task, config.rest_spread, config.mixture_bounds)
    search = MixtureSearch(model, around, config.mixture_bounds)
    alone = Mode("autonomous", search, 1)
    emulating = [
        Mode(f"emulate {t}", search, 1, teacher=t, pursues="demonstrated") for t in parts.teachers
    ]
    modes = [alone, *emulating]
    costs = {mode.name: mode.cost for mode in modes}
    make = parts.interest
    interest = parts.mixture_interest(costs, model) if make is None else make(costs)
    choice = JointChoice(modes, interest, alone)
    resting = Mode("rest", around, 1, pursues="nothing")
    return parts.learner(RestFirst(resting, config.rest_trials, choice), model)
