"""The fishing world without a learner: goals, demonstrations, their mapping, and the noise."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from sgim.environments.fishing import FishingRod, fishing_demonstrations, fishing_goals
from sgim.environments.fishing.model import JOINTS
from sgim.environments.fishing.movement import FISHING
from sgim.errors import SgimError
from sgim.figures.style import OKABE_ITO, new_figure, tidy
from sgim.records import Demonstration

if TYPE_CHECKING:
    from collections.abc import Sequence

    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

_RATE = 50.0
_TEACHERS = (1, 2, 3)


def fishing_goals_and_demonstrations() -> Figure:
    """Draw the benchmark, and where the demonstrations of three teachers land (figure 3.3.1b–c)."""
    figure = new_figure(10.0, 2.9)
    panels = figure.subplots(1, 1 + len(_TEACHERS), sharex=True, sharey=True)
    goals = np.array([goal.point for goal in fishing_goals()])
    panels[0].plot(*goals.T, ".", color=OKABE_ITO[0], markersize=3)
    panels[0].set_title(f"benchmark: {len(goals)} goals")
    for axes, number in zip(panels[1:], _TEACHERS, strict=True):
        landings = np.array([shown.outcome["float"] for shown in fishing_demonstrations(number)])
        axes.plot(*landings.T, "x", color=OKABE_ITO[1], markersize=3)
        axes.set_title(f"D{number}: {len(landings)} demonstrations")
    for axes in panels:
        axes.set_aspect("equal")
        axes.set_xlabel("x (m)")
        tidy(axes)
    panels[0].set_ylabel("y (m)")
    return figure


def mapped_demonstrations(demonstrations: Sequence[Demonstration]) -> Figure:
    """Draw how recorded movements are mapped to policies (figure 3.2.2): a panel for each.

    Args:
        demonstrations: With trajectories of the arm's joints.
    """
    figure = new_figure(4.2 * len(demonstrations), 3.2)
    panels = figure.subplots(1, len(demonstrations), squeeze=False)[0]
    for axes, demonstration in zip(panels, demonstrations, strict=True):
        recorded = demonstration.trajectory
        assert recorded is not None
        policy, residual = FISHING.fit(recorded)
        fitted = FISHING.trajectory(policy, _RATE)
        for number, joint in enumerate(JOINTS):
            colour = OKABE_ITO[number]
            axes.plot(recorded.times, np.degrees(recorded.positions[:, number]), color=colour)
            axes.plot(fitted.times, np.degrees(fitted.positions[:, number]), "--", color=colour)
            end = np.degrees(recorded.positions[-1, number])
            axes.text(recorded.times[-1], end, f" {joint}", fontsize=7, verticalalignment="center")
        axes.set_title(f"root-mean-square residual {np.degrees(residual):.2f}°")
        axes.set_xlabel("time (s)")
        tidy(axes)
    panels[0].set_ylabel("angle (°); dashed: as mapped")
    return figure


def repeated_movements(
    policies: Sequence[Any], repetitions: int = 20, world: FishingRod | None = None, seed: int = 0
) -> Figure:
    """Draw where movements land that are repeated with noise (figure 3.2.3).

    Args:
        policies: The policies, of shape ``(25,)``.
        repetitions: How often each is executed.
        world: Where; that of the experiment ``fishing`` if None.
        seed: Of the noise.
    """
    world = FishingRod() if world is None else world
    rng = np.random.default_rng(seed)
    figure = new_figure(4.6, 4.2)
    axes = figure.subplots()
    for number, policy in enumerate(policies):
        landed = _landings(world, policy, repetitions, rng)
        x, y = landed.std(axis=0, ddof=1) if len(landed) > 1 else (np.nan, np.nan)
        label = f"({x:.3f}, {y:.3f}) m, {len(landed)} of {repetitions} land"
        axes.plot(*landed.T, "o^sDvPX*"[number % 8], color=OKABE_ITO[number % 8], label=label)
    axes.set_aspect("equal", adjustable="datalim")
    axes.set_xlabel("x (m)")
    axes.set_ylabel("y (m)")
    axes.legend(title="standard deviations", fontsize=8, title_fontsize=8, frameon=False)
    tidy(axes)
    return figure


def demonstrated_joint(joint: str = "base") -> Figure:
    """Draw one joint in all demonstrations of three teachers (figure 3.5.4).

    Raises:
        SgimError: If there is no such joint.
    """
    if joint not in JOINTS:
        raise SgimError(f"joint is {joint!r}, expected one of {', '.join(JOINTS)}")
    column = JOINTS.index(joint)
    figure = new_figure(10.0, 3.0)
    panels = figure.subplots(1, len(_TEACHERS), sharey=True)
    for axes, number in zip(panels, _TEACHERS, strict=True):
        for demonstration in fishing_demonstrations(number):
            _follow(axes, demonstration, column)
        axes.set_title(f"D{number}")
        axes.set_xlabel("time (s)")
        tidy(axes)
    panels[0].set_ylabel(f"{joint} (°)")
    return figure


def _follow(axes: Axes, demonstration: Demonstration, column: int) -> None:
    shown = demonstration.trajectory or FISHING.trajectory(demonstration.policy, _RATE)
    angles = np.degrees(shown.positions[:, column])
    axes.plot(shown.times - shown.times[0], angles, color=OKABE_ITO[0], linewidth=0.5, alpha=0.6)


def _landings(world: FishingRod, policy: Any, repetitions: int, rng: np.random.Generator) -> Any:
    outcomes = [world.execute(policy, None, rng) for _ in range(repetitions)]
    landed = [outcome["float"] for outcome in outcomes if "float" in outcome]
    return np.array(landed).reshape(-1, 2)
