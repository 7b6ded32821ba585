import json
import math
import tempfile
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from sgim.errors import TeacherError
from sgim.primitives import EvenlySpaced, ViaPoints
from sgim.records import Demonstration, Goal, Trajectory
from sgim.spaces import Box, Choices
from sgim.task import Task
from sgim.teachers import DemonstrationSet, load_demonstrations, save_demonstrations
from sgim.teachers import demonstration_files as files

PRIMITIVE = ViaPoints(
    Box([-2, -2], [2, 2], names=["shoulder", "elbow"], unit="rad"), EvenlySpaced(3, 0.1, 5.0)
)
TASK = Task(
    PRIMITIVE.policy_space,
    {"place": Box([0, 0], [1, 1], unit="m"), "object": Choices(["cup", "ball"])},
    primitive=PRIMITIVE,
)


def recorded(seed: int, **outcome: Any) -> Demonstration:
    rng = np.random.default_rng(seed)
    times = np.cumsum(rng.uniform(0.01, 0.1, 12))
    trajectory = Trajectory(times, rng.normal(size=(12, 2)), ["shoulder", "elbow"])
    return Demonstration(outcome or {"place": rng.random(2)}, trajectory=trajectory)


def content() -> dict[str, Any]:
    """A file that is well formed, to be damaged."""
    return {
        "format": "sgim demonstrations",
        "version": 1,
        "teacher": "Ada",
        "joints": ["shoulder", "elbow"],
        "unit": "rad",
        "demonstrations": [
            {"rate": 10, "positions": [[0, 0], [0.1, 0.2]], "outcome": {"place": [0.2, 0.3]}},
            {
                "times": [0, 0.1, 0.3],
                "positions": [[0, 0], [0.1, 0.2], [0.2, 0.3]],
                "outcome": {"object": "cup"},
            },
        ],
    }


def written(path: Path, value: Any) -> Path:
    path.write_text(value if isinstance(value, str) else json.dumps(value), encoding="utf-8")
    return path


@pytest.fixture
def path(tmp_path: Path) -> Path:
    return tmp_path / "ada.json"


def test_what_is_saved_comes_back_exactly(path: Path) -> None:
    saved = [recorded(0), recorded(1, object="ball"), recorded(2, place=[0.5, 1.0], object="cup")]
    save_demonstrations(path, saved, TASK, teacher="Ada", comment="by hand, at 25 Hz")
    loaded = load_demonstrations(path, TASK)
    assert len(loaded) == 3
    for before, after in zip(saved, loaded, strict=True):
        assert before.trajectory is not None
        assert after.trajectory is not None
        np.testing.assert_array_equal(after.trajectory.times, before.trajectory.times)
        np.testing.assert_array_equal(after.trajectory.positions, before.trajectory.positions)
        assert after.trajectory.joints == before.trajectory.joints
        assert after.trajectory.unit == before.trajectory.unit
        assert after.outcome.keys() == before.outcome.keys()
        assert after.teacher == "Ada"
    np.testing.assert_array_equal(loaded[0].outcome["place"], saved[0].outcome["place"])
    assert loaded[1].outcome["object"] == "ball"
    assert json.loads(path.read_text("utf-8"))["comment"] == "by hand, at 25 Hz"


@given(st.lists(st.tuples(*[st.floats(-1e99, 1e99)] * 2), min_size=2, max_size=5))
def test_every_number_comes_back_to_the_last_bit(positions: list[tuple[float, float]]) -> None:
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / "a.json"
        trajectory = Trajectory(np.arange(len(positions)) / 3, positions, PRIMITIVE.joints)
        shown = Demonstration({"place": [0.1, 1 / 3]}, trajectory=trajectory)
        save_demonstrations(path, [shown], TASK, teacher="A")
        [loaded] = load_demonstrations(path, TASK)
        assert loaded.trajectory is not None
        np.testing.assert_array_equal(loaded.trajectory.positions, positions)


def test_contexts_are_kept(path: Path) -> None:
    task = Task(Box(0, 1), {"place": Box(0, 1)}, context_space=Box(-1, 1))
    trajectory = Trajectory([0, 1], [[0], [1]], ["elbow"])
    shown = Demonstration({"place": [0.5]}, trajectory=trajectory, context=np.array([0.25]))
    save_demonstrations(path, [shown], task, teacher="Ada")
    [loaded] = load_demonstrations(path, task)
    np.testing.assert_array_equal(loaded.context, [0.25])
    with pytest.raises(TeacherError, match="demonstration 0: this task has no context space"):
        load_demonstrations(path, Task(Box(0, 1), {"place": Box(0, 1)}))


def test_a_rate_stands_for_times_from_zero(path: Path) -> None:
    first, second = load_demonstrations(written(path, content()), TASK)
    assert first.trajectory is not None
    assert second.trajectory is not None
    np.testing.assert_allclose(first.trajectory.times, [0, 0.1])
    np.testing.assert_allclose(second.trajectory.times, [0, 0.1, 0.3])


def test_a_demonstration_set_answers_from_a_file(path: Path) -> None:
    made = [np.array([0, 0, a, -a, a, a, 1.0]) for a in (0.5, 1.0)]
    shown = [
        Demonstration({"place": [p[2] / 2, 0.5]}, trajectory=PRIMITIVE.trajectory(p, 50))
        for p in made
    ]
    save_demonstrations(path, shown, TASK, teacher="Ada")
    teacher = DemonstrationSet(load_demonstrations(path, TASK), TASK)
    rng = np.random.default_rng(0)
    for policy in made:
        answer = teacher.demonstrate(Goal("place", np.array([policy[2] / 2, 0.4])), rng)
        assert answer.trajectory is not None
        fitted, residual = PRIMITIVE.fit(answer.trajectory)
        assert residual < 1e-6
        np.testing.assert_allclose(fitted, policy, atol=1e-5)


def test_a_file_in_degrees_is_accepted_and_fitted_in_radians(path: Path) -> None:
    value = content()
    value["unit"] = "deg"
    value["joints"] = ["elbow", "shoulder"]
    first, _ = load_demonstrations(written(path, value), TASK)
    assert first.trajectory is not None
    assert first.trajectory.unit == "deg"
    fitted, _ = PRIMITIVE.fit(first.trajectory)
    assert np.abs(fitted[:6]).max() < np.radians(1)


def test_a_task_without_a_primitive_takes_any_joints(path: Path) -> None:
    task = Task(Box(0, 1), TASK.outcome_spaces)
    value = content()
    value.update(joints=["left", "right"], unit="mm")
    assert len(load_demonstrations(written(path, value), task)) == 2


# Files that are refused, with what is wrong and where.

nan = math.nan
DAMAGES: list[tuple[str, Any, str]] = [
    ("format", "something", '"format" is not "sgim demonstrations"'),
    ("version", 2, "version is 2, but this sgim reads version 1"),
    ("teacher", None, "teacher is None"),
    ("techer", "Ada", "unknown field 'techer'. Did you mean 'teacher'"),
    ("joints", "shoulder", "joints is 'shoulder'"),
    ("joints", ["elbow", "elbow"], "list of different names"),
    ("joints", ["shoulder", "wrist"], "shoulder, wrist in rad, expected shoulder, elbow.*lacks"),
    ("unit", "mm", "in mm, expected rad"),
    ("unit", 3, "unit is 3"),
    ("demonstrations", [], "one or more"),
    ("demonstrations", {}, "one or more"),
]
DEMONSTRATION_DAMAGES: list[tuple[str, Any, str]] = [
    ("positions", [[0, 0]], "positions: expected a list of 2 or more"),
    ("positions", [[0, 0], [0, 0], [0]], r"positions\[2\] is \[0\], expected 2 numbers"),
    ("positions", [[0, 0], [0, nan], [0, 0]], r"positions\[1\]\[1\] is nan, expected a finite"),
    ("positions", [[0, 0], ["0", 0], [0, 0]], r"positions\[1\]\[0\] is '0'"),
    ("positions", [[0, 0], [True, 0], [0, 0]], r"positions\[1\]\[0\] is True"),
    ("positions", [[0, 0], [10**400, 0], [0, 0]], r"positions\[1\]\[0\] is 1000"),
    ("positions", None, "positions: expected a list"),
    ("times", [0, 0.1], "times: 2 numbers came, expected one for each of 3"),
    ("times", [0, 0.2, 0.2], r"times\[2\] = 0.2 comes after times\[1\] = 0.2"),
    ("times", [0, 0.3, 0.2], "times must increase"),
    ("times", [0, math.inf, 2], r"times\[1\] is inf"),
    ("times", 3, "times: 3 came"),
    ("rate", 10, "both times and rate"),
    ("outcome", {}, "outcome is empty"),
    ("outcome", [0, 1], r"outcome is \[0, 1\]"),
    ("outcome", {"plce": [0, 1]}, "unknown outcome kind 'plce'. Did you mean 'place'"),
    ("outcome", {"place": [0, nan]}, r"outcome 'place'\[1\] is nan"),
    ("outcome", {"place": [0, 1, 2]}, r"outcome 'place' has shape \(3,\)"),
    ("outcome", {"place": {"x": 0}}, "outcome 'place' is {'x': 0}"),
    ("outcome", {"object": "cop"}, "Did you mean 'cup'"),
    ("context", [1], "no context space"),
    ("policy", [1], "unknown field 'policy'"),
]


@pytest.mark.parametrize(("field", "value", "message"), DAMAGES)
def test_a_malformed_file_is_refused(path: Path, field: str, value: Any, message: str) -> None:
    damaged = content()
    damaged[field] = value
    with pytest.raises(TeacherError, match=rf"ada\.json: .*{message}"):
        load_demonstrations(written(path, damaged), TASK)


@pytest.mark.parametrize(("field", "value", "message"), DEMONSTRATION_DAMAGES)
def test_a_malformed_demonstration_is_refused_by_its_number(
    path: Path, field: str, value: Any, message: str
) -> None:
    damaged = content()
    damaged["demonstrations"][1][field] = value
    with pytest.raises(TeacherError, match=rf"ada\.json: demonstration 1.*{message}"):
        load_demonstrations(written(path, damaged), TASK)


@pytest.mark.parametrize("rate", [0, -5, nan, "10", None, 1e-320, 1e7])
def test_a_rate_that_gives_no_times_is_refused(path: Path, rate: Any) -> None:
    damaged = content()
    damaged["demonstrations"][0]["rate"] = rate
    with pytest.raises(TeacherError, match=r"demonstration 0.*rate"):
        load_demonstrations(written(path, damaged), TASK)


@pytest.mark.parametrize("field", ["teacher", "joints", "unit", "demonstrations"])
def test_a_field_that_is_missing_is_named(path: Path, field: str) -> None:
    damaged = content()
    del damaged[field]
    with pytest.raises(TeacherError, match=f"lacks the field '{field}'"):
        load_demonstrations(written(path, damaged), TASK)


@pytest.mark.parametrize("field", ["positions", "outcome", "times"])
def test_a_field_that_a_demonstration_lacks_is_named(path: Path, field: str) -> None:
    damaged = content()
    del damaged["demonstrations"][1][field]
    with pytest.raises(TeacherError, match=f"demonstration 1.*{field}"):
        load_demonstrations(written(path, damaged), TASK)


@pytest.mark.parametrize(
    "text", ["", "[1, 2", "[" * 100_000, "1" * 5000, "[]", "null", '{"format": 1}', "\x80"]
)
def test_what_is_not_a_file_of_demonstrations_is_refused(path: Path, text: str) -> None:
    with pytest.raises(TeacherError, match=r"ada\.json: it is not a"):
        load_demonstrations(written(path, text), TASK)


def test_bytes_that_are_no_text_are_refused(path: Path) -> None:
    path.write_bytes(b"\xff\xfe\x00PK")
    with pytest.raises(TeacherError, match="not a JSON file"):
        load_demonstrations(path, TASK)


def test_a_file_that_is_too_large_is_refused_before_it_is_read(path: Path) -> None:
    with path.open("wb") as file:  # sparse: takes no space
        file.truncate(files.LARGEST_FILE + 1)
    with pytest.raises(TeacherError, match="67108865 bytes, but at most 67108864"):
        load_demonstrations(path, TASK)


def test_a_file_that_is_not_there_is_named(tmp_path: Path) -> None:
    with pytest.raises(TeacherError, match=r"absent\.json cannot be read: No such file"):
        load_demonstrations(tmp_path / "absent.json", TASK)
    with pytest.raises(TeacherError, match="cannot be read"):
        load_demonstrations(tmp_path, TASK)


def test_what_cannot_be_saved_is_refused(path: Path) -> None:
    other = Trajectory([0, 1], [[0], [1]], ["wrist"])
    in_degrees = Trajectory([0, 1], [[0, 0], [1, 1]], ["shoulder", "elbow"], "deg")
    place = {"place": [0.1, 0.2]}
    wrong = [
        ([], "no demonstration"),
        ([recorded(0), Demonstration(place, policy=np.zeros(7))], "demonstration 1 has no traj"),
        ([recorded(0), Demonstration(place, trajectory=other)], "demonstration 1 is of joints"),
        ([recorded(0), Demonstration(place, trajectory=in_degrees)], "in deg, but"),
        ([Demonstration({}, trajectory=in_degrees)], "demonstration 0, outcome is empty"),
        ([recorded(0, place=[1.0])], r"demonstration 0: outcome 'place' has shape"),
    ]
    for demonstrations, message in wrong:
        with pytest.raises(TeacherError, match=message):
            save_demonstrations(path, demonstrations, TASK, teacher="Ada")
    assert not path.exists()


def test_points_that_are_neither_numbers_nor_labels_are_not_saved(path: Path) -> None:
    class Anything(Box):
        def check(self, value: Any, what: str = "value") -> Any:
            return value

    task = Task(Box(0, 1), {"picture": Anything(0, 1)})
    shown = Demonstration({"picture": {1, 2}}, trajectory=recorded(0).trajectory)
    with pytest.raises(TeacherError, match="only numbers and labels"):
        save_demonstrations(path, [shown], task, teacher="Ada")
