"""What the documentation shows is executed, and what its tables say is true."""

import os
import re
import runpy
import shlex
import signal
import subprocess
import sys
import time
from dataclasses import fields
from inspect import signature
from pathlib import Path

import pytest

import sgim
from sgim.algorithms import ALGORITHMS
from sgim.configurations import CONFIGURATIONS, Configuration
from sgim.environments import AirHockey
from sgim.errors import JournalError
from sgim.events import Answered, Ended, Opened, Told
from sgim.mixture_settings import MixtureSettings
from sgim.outcome.expected_gain import ExpectedGain
from sgim.outcome.region_tree import RegionTree
from sgim.policy.answering import KernelMean, Reliable
from sgim.policy.guided_search import GuidedSearch
from sgim.policy.local_model import LocalModel
from sgim.policy.local_search import LocalSearch
from sgim.policy.model import NearestModel
from sgim.policy.nelder_mead import NelderMeadSearch
from sgim.policy.simple import NoisyNearest
from sgim.runs.rows import RecordedPlan
from sgim.teachers import load_demonstrations

ROOT = Path(__file__).parent.parent.parent
EXAMPLES = ROOT / "docs" / "examples"


def start(*arguments: str, cwd: Path) -> subprocess.Popen[str]:
    command = [sys.executable, "-W", "error", *arguments]
    pipe = subprocess.PIPE
    return subprocess.Popen(command, cwd=cwd, stdout=pipe, stderr=pipe, text=True)


def output(*arguments: str, cwd: Path) -> str:
    """What Python prints, after ending well."""
    process = start(*arguments, cwd=cwd)
    out, err = process.communicate(timeout=100)
    assert process.returncode == 0, err
    return out


def python_blocks(page: str) -> list[str]:
    return re.findall(r"```python\n(.*?)```", (ROOT / page).read_text("utf-8"), re.DOTALL)


def test_the_lines_of_the_readme_run(tmp_path: Path) -> None:
    (block,) = python_blocks("README.md")
    output("-c", block, cwd=tmp_path)
    assert (tmp_path / "runs" / "a.sgim").is_file()


def test_a_world_a_teacher_and_a_map_of_ones_own_are_checked_and_learn(tmp_path: Path) -> None:
    lines = output(str(EXAMPLES / "own_world.py"), cwd=tmp_path).splitlines()
    first, *_, last = [float(line.split()[-1]) for line in lines if "mean error" in line]
    assert first == 1.0
    assert last < 0.05


def test_a_learner_composed_by_hand_learns_in_all_its_modes() -> None:
    names = runpy.run_path(str(EXAMPLES / "own_world.py"))
    world = names["PuckTable"]()
    learner = names["compose_learner"](world.task, seed=7)
    opened = []
    learner.record = lambda event: opened.append(event) if isinstance(event, Opened) else None
    sgim.Run(learner, world, {"Ada": names["LeftSider"]()}).go(500)
    assert {event.mode for event in opened} == {"autonomous", "mimic Ada", "emulate Ada"}
    assert learner.solve("puck", [0.4, 0.6]).cost < 0.1


def test_a_world_from_gymnasium_is_learned(tmp_path: Path) -> None:
    lines = output(str(EXAMPLES / "gymnasium_world.py"), cwd=tmp_path).splitlines()
    first, *_, last = [float(line.split()[-1]) for line in lines if "mean error" in line]
    assert first == 1.0
    assert last < 0.06


def test_a_world_with_contexts_is_learned(tmp_path: Path) -> None:
    uphill, downhill = output(str(EXAMPLES / "contexts.py"), cwd=tmp_path).splitlines()[::-1]
    faster, slower = [float(line.split()[5]) for line in (uphill, downhill)]
    assert faster > slower
    for line in (uphill, downhill):
        assert abs(float(line.split()[-2]) - 1.0) < 0.1


# A real arm, killed and resumed.

ARM = str(EXAMPLES / "real_arm.py")
TRIALS = 60


class Recorded:
    """What a journal of the arm says, also while it is being written."""

    def __init__(self, path: Path) -> None:
        self.plans: dict[int, RecordedPlan] = {}
        self.told: dict[int, Told] = {}
        self.ended: dict[int, Ended] = {}
        self.answered: dict[int, Answered] = {}
        with sgim.Journal.open(path, append=False) as journal:
            for event in journal.events():
                match event:
                    case RecordedPlan(number):
                        assert number not in self.plans
                        self.plans[number] = event
                    case Told(number):
                        assert number not in self.told
                        self.told[number] = event
                    case Ended(number):
                        assert number not in self.ended
                        self.ended[number] = event
                    case Answered(number):
                        self.answered[number] = event

    def started_and_never_told(self) -> set[int]:
        resolved = {*self.told, *self.ended, *self.answered}
        return {n for n, plan in self.plans.items() if plan.teacher is None} - resolved

    def how(self, ending: str) -> set[int]:
        return {n for n, event in self.ended.items() if event.how == ending}


def killed_in_a_trial(path: Path) -> Recorded:
    """Let the arm work, kill it while a movement goes on, and read what it left."""
    process = start(ARM, str(path), str(TRIALS), "0.1", cwd=path.parent)
    for _ in range(3000):
        time.sleep(0.01)
        assert process.poll() is None, process.communicate()[1]
        try:
            seen = Recorded(path)
        except JournalError:  # not made yet
            continue
        if len(seen.told) >= 10 and seen.started_and_never_told():
            break
    process.send_signal(signal.SIGKILL)
    process.communicate(timeout=30)
    assert process.returncode == -signal.SIGKILL
    return Recorded(path)


@pytest.mark.skipif(sys.platform == "win32", reason="there is no SIGKILL")
def test_a_real_arm_killed_in_a_trial_goes_on_with_nothing_told_lost_and_nothing_repeated(
    tmp_path: Path,
) -> None:
    path = tmp_path / "arm.sgim"
    before = killed_in_a_trial(path)
    assert 10 <= len(before.told) < TRIALS

    shown = output(ARM, str(path), str(TRIALS), cwd=tmp_path)
    after = Recorded(path)
    done = len(before.told) + len(before.how("failed"))
    assert shown.startswith(f"{done} trials so far\nhit with ")
    assert len(after.told) + len(after.how("failed")) == TRIALS
    assert before.told.keys() <= after.told.keys()
    assert after.how("lost") == before.started_and_never_told()
    assert not after.started_and_never_told()


def test_a_real_arm_meets_every_ending_of_a_trial_and_says_what_trials_cost(
    tmp_path: Path,
) -> None:
    path = tmp_path / "arm.sgim"
    output(ARM, str(path), "120", cwd=tmp_path)
    recorded = Recorded(path)
    assert recorded.how("refused")
    assert recorded.how("failed")
    assert recorded.how("expired")
    assert all(event.seconds and event.seconds > 0 for event in recorded.told.values())
    shown = [event.demonstration for event in recorded.answered.values()]
    assert any(d is not None and d.trajectory is not None for d in shown)
    assert all(d is None or d.policy is not None for d in shown)


# The command line, as shown.

NUMBER = re.compile(r"-?[0-9]+(?:\.[0-9]*)?(?:e[-+]?[0-9]+)?%?|–|\s+")


def shape(text: str) -> str:
    """A text without its numbers and its spacing, which differ between processors."""
    return NUMBER.sub("", text)


def shown_by(commands: list[str], cwd: Path) -> str:
    """The commands, each followed by what it prints."""
    lines = []
    for command in commands:
        program, *arguments = shlex.split(command.removeprefix("$ "))
        before = {"sgim": ["-m", "sgim.cli"], "python": []}[program]
        arguments = [str(ROOT / a) if a.startswith("docs/") else a for a in arguments]
        printed = output(*before, *arguments, cwd=cwd)
        lines += [command, *printed.splitlines()]
    return "\n".join(lines) + "\n"


@pytest.mark.parametrize("name", ["first-run", "your-own-world", "comparing"])
def test_commands_print_what_their_page_shows(
    name: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Numbers may differ. To write the page anew: SGIM_UPDATE_DOCS=1 pytest tests/docs."""
    monkeypatch.setenv("COLUMNS", "100")
    page = ROOT / "docs" / f"{name}.md"
    before = page.read_text("utf-8")

    def again(block: re.Match[str]) -> str:
        commands = [line for line in block[1].splitlines() if line.startswith("$ ")]
        return f"```console\n{shown_by(commands, tmp_path)}```"

    after = re.sub(r"```console\n(.*?)```", again, before, flags=re.DOTALL)
    if os.environ.get("SGIM_UPDATE_DOCS"):
        page.write_text(after, "utf-8")
    else:
        assert shape(after) == shape(before)


def test_the_lines_of_the_page_on_journals_read_one(tmp_path: Path) -> None:
    output("-m", "sgim.cli", "run", "throwing", "--movements", "400", cwd=tmp_path)
    for block in python_blocks("docs/journal.md"):
        assert output("-c", block, cwd=tmp_path)


def test_the_lines_of_the_page_on_comparing_compare(tmp_path: Path) -> None:
    sweep = "sweep throwing --learners random,sgim-acts --seeds 0-1 --movements 40 --jobs 1"
    output("-m", "sgim.cli", *sweep.split(), "--out", "runs/short", cwd=tmp_path)
    (block,) = python_blocks("docs/comparing.md")
    assert output("-c", block, cwd=tmp_path).startswith("sgim-acts ")


def test_the_lines_of_the_page_on_configurations_run(tmp_path: Path) -> None:
    (block,) = python_blocks("docs/configurations.md")
    output("-c", block, cwd=tmp_path)


def test_the_file_and_the_lines_of_the_page_on_demonstrations_teach(tmp_path: Path) -> None:
    page = (ROOT / "docs/demonstrations.md").read_text("utf-8")
    (file,) = re.findall(r"```json\n(.*?)```", page, re.DOTALL)
    (tmp_path / "ada.json").write_text(file, "utf-8")
    (block,) = python_blocks("docs/demonstrations.md")
    fitted, learned = output("-c", block, cwd=tmp_path).splitlines()
    assert float(fitted.split()[2]) < 20
    assert float(fitted.split()[-1]) == pytest.approx(0.27, abs=0.05)
    assert float(learned) > -0.1
    assert (tmp_path / "copy.json").is_file()


def test_the_page_on_demonstrations_shows_refusals_as_they_are(tmp_path: Path) -> None:
    page = (ROOT / "docs/demonstrations.md").read_text("utf-8")
    (file,) = re.findall(r"```json\n(.*?)```", page, re.DOTALL)
    (shown,) = re.findall(r"```text\n(.*?)```", page, re.DOTALL)
    damages = [
        ("[0.13, -0.57]", "[NaN, -0.57]"),
        ("0.35, 0.6", "0.35, 0.35"),
        ('"hit": [0.27]', '"hitt": [0.27]'),
        ('"unit": "m"', '"unit": "cm"'),
    ]
    for (right, wrong), line in zip(damages, shown.splitlines(), strict=True):
        assert right in file
        (tmp_path / "ada.json").write_text(file.replace(right, wrong), "utf-8")
        with pytest.raises(sgim.SgimError) as refused:
            load_demonstrations(tmp_path / "ada.json", AirHockey().task)
        assert str(refused.value) == line.replace("ada.json", str(tmp_path / "ada.json"), 1)


def test_the_lines_of_the_page_on_air_hockey_print_and_draw_what_it_shows(tmp_path: Path) -> None:
    shares, figure = python_blocks("docs/hockey.md")
    page = (ROOT / "docs/hockey.md").read_text("utf-8")
    assert output("-c", shares, cwd=tmp_path) in page
    output("-c", figure, cwd=tmp_path)
    assert (tmp_path / "hockey.png").read_bytes().startswith(b"\x89PNG")


# What tables say.


def table(page: str, first_cell: str) -> dict[str, list[str]]:
    """The rows of the page's table whose head begins with this cell, by their first cell."""
    text = (ROOT / page).read_text("utf-8")
    lines = iter(text[text.index(f"\n| {first_cell} |") + 1 :].splitlines()[2:])
    rows = {}
    for line in lines:
        if not line.startswith("|"):
            break
        cells = [cell.strip() for cell in line.strip("|").split("|")]
        rows[cells[0].strip("`")] = [cell.strip("`") for cell in cells[1:]]
    return rows


@pytest.mark.parametrize("name", list(CONFIGURATIONS))
def test_the_page_of_configurations_has_every_constant_as_it_is(name: str) -> None:
    of_mixtures = [field.name for field in fields(MixtureSettings)]
    apart = {"name", *of_mixtures}
    others = [field.name for field in fields(Configuration) if field.name not in apart]
    column = list(CONFIGURATIONS).index(name)
    for first_cell, names in (("constant", others), ("constant of mixtures", of_mixtures)):
        rows = table("docs/configurations.md", first_cell)
        assert list(rows) == names
        shown = {constant: cells[column] for constant, cells in rows.items()}
        assert shown == {
            constant: str(getattr(CONFIGURATIONS[name], constant)) for constant in names
        }


PARTS = (
    NearestModel,
    Reliable,
    KernelMean,
    LocalModel,
    NelderMeadSearch,
    LocalSearch,
    GuidedSearch,
    NoisyNearest,
    RegionTree,
    ExpectedGain,
)


def test_the_page_of_configurations_has_the_constants_of_the_parts() -> None:
    parts = {part.__name__: part for part in PARTS}
    for name, (shown,) in table("docs/configurations.md", "parameter").items():
        part, constant = name.split(".")
        default = signature(parts[part]).parameters.get(constant)
        value = getattr(parts[part], constant) if default is None else default.default
        assert shown == str(value), name


@pytest.mark.parametrize("page", ["README.md", "docs/algorithms.md"])
def test_tables_of_algorithms_have_every_algorithm(page: str) -> None:
    assert list(table(page, "name")) == list(ALGORITHMS)
