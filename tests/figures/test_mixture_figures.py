"""Toys of mixtures, and the strategies of a vocal learner, are drawn."""

import io

import numpy as np
import pytest
from matplotlib.figure import Figure

from sgim.environments.vocal.perception import SOUND
from sgim.experiments.vocal import BATCH
from sgim.experiments.vocal_history import VocalHistory
from sgim.figures import mixture_interest, mixture_learning
from sgim.figures.mixtures import GOALS
from sgim.figures.vocal_strategies import SMOOTHING, strategy_curves


def drawn(figure: Figure) -> bool:
    stream = io.BytesIO()
    figure.savefig(stream, format="png", dpi=40)
    return stream.getvalue().startswith(b"\x89PNG")


def test_each_moment_of_the_toy_has_three_panels_with_every_goal() -> None:
    figure = mixture_learning((60, 100, 200))
    assert [a.get_title() for a in figure.axes[::3]] == [
        f"after {n} trials" for n in (60, 100, 200)
    ]
    for axes in figure.axes[::3]:
        lines = [line.get_ydata() for line in axes.lines]
        assert sum(len(ys) == 2 and ys[0] in GOALS for ys in map(np.asarray, lines)) == len(GOALS)
        assert axes.patches  # the mixture's ellipses
    assert drawn(figure)


def test_interest_is_drawn_where_competence_grows() -> None:
    figure = mixture_interest()
    density = figure.axes[-1] if figure.axes[-1].lines else figure.axes[3]
    before, after = (np.asarray(line.get_ydata(), dtype=float) for line in density.lines)
    places = np.asarray(density.lines[0].get_xdata(), dtype=float)
    assert (places * after).sum() / after.sum() > (places * before).sum() / before.sum() + 0.3
    assert drawn(figure)


def test_progress_and_choice_of_a_strategy_are_those_of_windows_of_updates() -> None:
    updates = 3 * SMOOTHING
    n = updates * BATCH
    emulates = (np.arange(n) // BATCH) % 2 == 0
    distance = np.where(np.arange(n) < n // 2, 1.0, 0.0)
    sounds = np.zeros((n, len(SOUND)))
    goals = np.zeros((n, len(SOUND)))
    goals[:, 0] = np.where(emulates, distance, 2.0)
    modes = np.where(emulates, 1, 0)
    history = VocalHistory(sounds, goals, ("autonomous", "emulate 1"), modes)
    competence, progress, share = strategy_curves(history, "emulate")
    np.testing.assert_allclose(competence[[0, 100, -1]], [np.exp(-1), np.exp(-1), 1.0])
    assert progress[-51] == pytest.approx(1 - np.exp(-1), abs=0.02)
    assert progress[120] == pytest.approx(0.0, abs=1e-9)
    np.testing.assert_allclose(share[SMOOTHING:], 0.5, atol=0.01)
    alone = strategy_curves(history, "autonomous")
    np.testing.assert_allclose(alone[0][1:], np.exp(-2))
