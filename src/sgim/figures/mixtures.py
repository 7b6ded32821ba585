"""How mixtures learn and choose, on toys of one dimension (figures 5.2.4 and 5.2.5)."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Any

import numpy as np

from sgim import algorithms
from sgim.figures.style import OKABE_ITO, new_figure, tidy
from sgim.mixtures import GaussianMixture, fit
from sgim.outcome import MixtureInterest
from sgim.policy import MixtureModel
from sgim.spaces import Box, FloatArray
from sgim.streams import Streams
from sgim.task import Task

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

GOALS = (-9.0, 0.0, 8.0)
_NOISE = 0.5
_COLOURS = OKABE_ITO[:3]
_TOY = Task(Box(-10.0, 10.0, names=["m"]), {"s": Box(-11.0, 11.0, names=["s"])})
_SETTINGS = (
    "modern,mixture_components=6,mixture_every=50,mixture_lifetime=3000,rest_trials=50,"
    "rest_spread=0.03,mixture_answers=mixture,interest_every=100,interest_window=400"
)


def toy_world(motor: FloatArray) -> FloatArray:
    """The toy's outcome without noise: it bends twice, and is steep only in the middle."""
    outcome: FloatArray = 10 * np.tanh(motor / 3) + 1.5 * np.sin(motor)
    return outcome


def mixture_learning(moments: tuple[int, ...] = (100, 500, 1500), seed: int = 0) -> Figure:
    """Draw what a learner with a joint mixture knows and can reach, as it learns (figure 5.2.4).

    Args:
        moments: After how many trials, for each column.
        seed: Of the learner and of the noise.
    """
    learner = algorithms.make("sagg-riac-gmm", _TOY, configuration=_SETTINGS, seed=seed)
    assert isinstance(learner.model, MixtureModel)
    figure = new_figure(8.4, 5.4)
    grid = figure.add_gridspec(2, 2 * len(moments), height_ratios=[2, 1], width_ratios=[3, 1] * 3)
    trials: list[tuple[float, float]] = []
    for column, moment in enumerate(moments):
        while learner.movements < moment:
            plan = learner.ask()
            noise = learner.streams("environment", plan.id).standard_normal(1)
            outcome = toy_world(plan.policy) + _NOISE * noise
            trials.append((float(plan.policy[0]), float(outcome[0])))
            learner.tell(plan, {"s": outcome})
        joint = figure.add_subplot(grid[0, 2 * column])
        reached = figure.add_subplot(grid[0, 2 * column + 1], sharey=joint)
        motors = figure.add_subplot(grid[1, 2 * column], sharex=joint)
        _draw_joint(joint, learner.model, np.array(trials))
        joint.set_title(f"after {moment} trials")
        _draw_inference(motors, reached, learner.model, seed)
        if column == 0:
            joint.set_ylabel("outcome s")
            motors.set_ylabel("density of m")
        for axes in (joint, reached, motors):
            tidy(axes)
        reached.tick_params(labelleft=False)
        reached.set_xticks([])
        motors.set_yticks([])
    return figure


def _draw_joint(axes: Axes, model: MixtureModel, trials: FloatArray) -> None:
    axes.plot(*trials.T, ".", color="0.6", markersize=2, zorder=1)
    motors = np.linspace(-10, 10, 300)
    axes.plot(motors, toy_world(motors), color="black", linewidth=1)
    mixture = model.kinds["s"].mixture
    if mixture is not None:
        outcomes, policies = model.spaces["s"], model.policy_space
        scale = np.array([outcomes.range[0], policies.range[0]])
        low = np.array([outcomes.low[0], policies.low[0]])
        for weight, mean, covariance in zip(
            mixture.weights, mixture.means, mixture.covariances, strict=True
        ):
            if weight > 0.01:
                shape = covariance[::-1, ::-1] * np.outer(scale[::-1], scale[::-1])
                _draw_ellipse(axes, (low + mean * scale)[::-1], shape, OKABE_ITO[1])
    for goal, colour in zip(GOALS, _COLOURS, strict=True):
        axes.axhline(goal, color=colour, linewidth=0.8, linestyle="--")
    axes.set_xlim(-10, 10)
    axes.set_ylim(-12.5, 12.5)


def _draw_inference(motors: Axes, reached: Axes, model: MixtureModel, seed: int) -> None:
    """Densities of policies inferred for the goals, and of what these would produce."""
    inverse = model.inverse("s")
    if inverse is None:
        return
    rng = np.random.default_rng(seed)
    for goal, colour in zip(GOALS, _COLOURS, strict=True):
        keys = np.tile(model.spaces["s"].encode(np.array([goal])), (4000, 1))
        drawn = inverse.draw(keys, rng.random(4000), rng.standard_normal((4000, 1)))
        policies = model.policy_space.decode(drawn[:, 0])
        inside = policies[np.abs(policies) <= 10]
        shown: Any = {"bins": 80, "density": True, "color": colour, "alpha": 0.6}
        motors.hist(inside, range=(-10, 10), **shown)
        outcomes = toy_world(inside) + _NOISE * rng.standard_normal(len(inside))
        reached.hist(outcomes, range=(-12.5, 12.5), orientation="horizontal", **shown)
        reached.axhline(goal, color=colour, linewidth=0.8, linestyle="--")
    motors.set_xlabel("policy m")


def mixture_interest(seed: int = 0) -> Figure:
    """Draw how interest follows from time, goals and competence (figure 5.2.5).

    Competence grows over time for goals above 0, and falls for those below, the more the farther.

    Args:
        seed: Of the made-up history.
    """
    rng = np.random.default_rng(seed)
    n = 400
    times, goals = (np.arange(n) + 0.5) / n, rng.uniform(-1, 1, n)
    competences = 0.5 + 0.45 * goals * (times - 0.5) * 2 + 0.02 * rng.standard_normal(n)
    data = np.column_stack((goals, competences, times))
    mixture = fit(data, 6, rng, floor=1e-4)
    interest = MixtureInterest({"s": Box(-1.0, 1.0)}, {"alone": 1.0}, Streams(seed))
    progress = interest.progress(mixture)
    figure = new_figure(8.0, 5.6)
    grid = figure.add_gridspec(2, 2)
    panels = {
        "time": (figure.add_subplot(grid[0, 0]), (2, 0)),
        "competence by goal": (figure.add_subplot(grid[0, 1]), (0, 1)),
        "competence by time": (figure.add_subplot(grid[1, 0]), (2, 1)),
    }
    names = ("goal s", "competence", "time")
    colours = [OKABE_ITO[2] if p > 0.01 * progress.max() else "0.55" for p in progress]
    for axes, (x, y) in panels.values():
        points: Any = axes.scatter(data[:, x], data[:, y], c=competences, s=4, cmap="viridis")
        for mean, covariance, colour in zip(
            mixture.means, mixture.covariances, colours, strict=True
        ):
            chosen = covariance[np.ix_((x, y), (x, y))]
            _draw_ellipse(axes, mean[[x, y]], chosen, colour)
        axes.set_xlabel(names[x])
        axes.set_ylabel(names[y])
        tidy(axes)
    figure.colorbar(points, ax=panels["time"][0], label="competence")
    density = figure.add_subplot(grid[1, 1])
    places = np.linspace(-1.5, 1.5, 300)
    for weights, style, name in (
        (mixture.weights, "0.55", "goals as they were"),
        (mixture.weights * progress, OKABE_ITO[2], "by interest"),
    ):
        density.plot(places, _density(mixture.reweighted(weights), places), color=style, label=name)
    density.set_xlabel("goal s")
    density.set_ylabel("density")
    density.legend(frameon=False, fontsize=8)
    tidy(density)
    return figure


def _density(mixture: GaussianMixture, places: FloatArray) -> FloatArray:
    density: FloatArray = np.exp(mixture.marginal([0]).log_parts(places[:, None])).sum(axis=1)
    return density


def _draw_ellipse(axes: Axes, mean: FloatArray, covariance: FloatArray, colour: str) -> None:
    """The ellipse of two standard deviations."""
    from matplotlib.patches import Ellipse

    values, vectors = np.linalg.eigh(covariance)
    width, height = 4 * np.sqrt(np.maximum(values, 0.0))
    angle = math.degrees(math.atan2(vectors[1, 0], vectors[0, 0]))
    axes.add_patch(
        Ellipse((mean[0], mean[1]), width, height, angle=angle, fill=False, color=colour, lw=1.3)
    )
