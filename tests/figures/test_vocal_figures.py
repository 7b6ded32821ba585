"""The vocal tract, its vocalisations and its learners are drawn."""

import io
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from matplotlib.figure import Figure
from matplotlib.table import Cell
from matplotlib.text import Text

from sgim.cli import main
from sgim.environments import VocalTract, ambient_language
from sgim.environments.vocal import articulations, spoken
from sgim.environments.vocal.anatomy import ARTICULATORS
from sgim.environments.vocal.articulations import VOWELS
from sgim.experiments import experiment
from sgim.experiments.vocal_history import VocalRun, read_vocal_run
from sgim.figures import (
    draw_tract,
    of_worlds,
    vocal_articulators,
    vocal_classes,
    vocal_densities,
    vocal_sounds,
    vocal_stages,
    vocal_vowels,
    vocalisation,
)
from sgim.figures.style import new_figure
from sgim.figures.vocal_classes import count_stages


@pytest.fixture(scope="module")
def paths(tmp_path_factory: pytest.TempPathFactory) -> list[Path]:
    """Journals of two learners, one of them amid a language."""
    folder, vocal = tmp_path_factory.mktemp("vocal"), experiment("vocal")
    found = []
    for learner in ("random", "emulation:2"):
        path = vocal.journal_path(learner, folder=folder)
        with vocal.start(learner, path, batch=40, evaluate_every=60) as run:
            run.go(120)
        found.append(path)
    return found


@pytest.fixture(scope="module")
def runs(paths: list[Path]) -> list[VocalRun]:
    return [read_vocal_run(path) for path in paths]


def drawn(figure: Figure) -> bool:
    stream = io.BytesIO()
    figure.savefig(stream, format="png", dpi=40)
    return stream.getvalue().startswith(b"\x89PNG")


def texts(figure: Figure) -> set[str]:
    cells = {c.get_text().get_text() for a in figure.axes for c in a.findobj(Cell)}
    return cells | {text.get_text() for axes in figure.axes for text in axes.findobj(Text)}


def test_each_articulator_has_a_panel_with_three_positions() -> None:
    figure = vocal_articulators()
    assert [axes.get_title() for axes in figure.axes[:7]] == [*ARTICULATORS]
    assert drawn(figure)


@pytest.mark.parametrize("name", articulations())
def test_every_articulation_can_be_drawn(name: str) -> None:
    figure = new_figure(2, 2)
    axes = figure.add_subplot()
    draw_tract(axes, articulations()[name])
    assert len(axes.lines) > 5
    low, high = axes.get_xlim()
    assert all(
        ((line.get_xdata() >= low) & (line.get_xdata() <= high)).all() for line in axes.lines
    )


def test_a_vocalisation_is_drawn_with_its_sound_and_what_is_heard() -> None:
    figure = vocalisation(spoken("labial", "a"))
    titles = [axes.get_title() for axes in figure.axes]
    assert titles[1:3] == ["B  250 ms", "800 ms"]
    assert drawn(figure)


def test_english_vowels_lie_among_what_the_tract_can_say() -> None:
    figure = vocal_vowels(np.random.default_rng(0))
    (axes,) = figure.axes
    assert {*VOWELS} <= {text.get_text() for text in axes.texts}
    assert drawn(figure)


def test_silence_is_drawn_too() -> None:
    rest = VocalTract().task.rest
    assert drawn(vocalisation(rest))


def test_classes_are_drawn_run_by_run_with_their_stages_counted(runs: list[VocalRun]) -> None:
    figure = vocal_classes(runs)
    assert {"stage I", "stage IV", "articulated", "seed 0"} <= texts(figure)
    assert drawn(figure)


def test_the_stages_of_a_run_have_their_types(runs: list[VocalRun]) -> None:
    figure = vocal_stages(runs[0])
    assert {"NN", "VV", "I"} <= texts(figure)
    assert drawn(figure)


def test_stages_are_counted_by_place_and_label(runs: list[VocalRun]) -> None:
    assert np.sum(count_stages([[], []])) == 0


def test_densities_have_goals_commands_and_sounds(runs: list[VocalRun]) -> None:
    figure = vocal_densities(runs[1])
    assert len(figure.axes) == 2 * (3 + 9 + 3)
    assert {"goals", "commands", "heard"} <= texts(figure)
    assert drawn(figure)


def test_sounds_are_drawn_with_those_of_the_language(runs: list[VocalRun]) -> None:
    alone, amid = (vocal_sounds(run) for run in runs)
    assert [len(figure.axes[0].lines) for figure in (alone, amid)] == [0, 1]
    circles = amid.axes[1].lines[0].get_xydata()
    assert circles == pytest.approx(ambient_language("2").sounds[:, 2:4])
    assert drawn(amid)


def test_plot_draws_what_only_vocal_runs_have(
    paths: list[Path], tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    assert main(["plot", str(paths[1]), "--out", str(tmp_path)]) == 0
    names = {path.stem.removeprefix("vocal-emulation-2-0-") for path in tmp_path.iterdir()}
    assert {"stages", "densities", "sounds", "errors"} <= names
    assert "vocal-emulation-2-0-densities.png" in capsys.readouterr().out


def test_classes_of_several_runs_are_drawn_together(runs: list[VocalRun]) -> None:
    several = of_worlds.drawings("vocal", runs, [runs[0].path])
    names = [name.removeprefix("vocal-") for name, _ in several]
    assert names[:4] == ["classes", "random-0-stages", "random-0-densities", "random-0-sounds"]
    assert not of_worlds.drawings("other", [replace(runs[0], header={})], [])
