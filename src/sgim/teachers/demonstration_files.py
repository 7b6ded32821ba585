"""Demonstrations as files: recorded movements and what they produced, in JSON."""

from __future__ import annotations

import json
import sys
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

import numpy as np

from sgim.errors import SgimError, TeacherError, unknown
from sgim.primitives.recordings import unit_factor
from sgim.records import Demonstration, Outcome, Trajectory
from sgim.spaces import FloatArray
from sgim.task import Task

FORMAT = "sgim demonstrations"
VERSION = 1
LARGEST_FILE = 64 * 2**20
"""Bytes of the largest file that is read: about 3 million positions."""

_FIELDS = ("format", "version", "teacher", "comment", "joints", "unit", "demonstrations")
_DEMONSTRATION_FIELDS = ("rate", "times", "positions", "outcome", "context")
_FEWEST_SAMPLES = 2
_SLOWEST, _FASTEST = 1e-3, 1e6


def save_demonstrations(
    path: str | Path,
    demonstrations: Sequence[Demonstration],
    task: Task,
    *,
    teacher: str,
    comment: str = "",
) -> None:
    """Write recorded movements to a file; docs/demonstrations.md describes the format.

    Policies are not kept: who reads the file maps each movement to a policy of their own.

    Args:
        path: Where to; an existing file is replaced.
        demonstrations: One or more, each with a trajectory and an outcome.
        task: Their task.
        teacher: The teacher's name.
        comment: How they were recorded.

    Raises:
        TeacherError: As `write_demonstrations`.
    """
    text = write_demonstrations(demonstrations, task, teacher=teacher, comment=comment)
    Path(path).write_text(text, encoding="utf-8")


def write_demonstrations(
    demonstrations: Sequence[Demonstration], task: Task, *, teacher: str, comment: str = ""
) -> str:
    """The text that `save_demonstrations` writes.

    Raises:
        TeacherError: If there is none, one has no trajectory or outcome, their joints or units
            differ, or an outcome is neither numbers nor a label.
    """
    if not demonstrations:
        raise TeacherError("there is no demonstration to save, expected one or more")
    rows, recorded = [], []
    for index, demonstration in enumerate(demonstrations):
        trajectory, where = demonstration.trajectory, f"demonstration {index}"
        if trajectory is None:
            raise TeacherError(f"{where} has no trajectory: only recorded movements can be saved")
        recorded.append(trajectory)
        if (trajectory.joints, trajectory.unit) != (recorded[0].joints, recorded[0].unit):
            raise TeacherError(
                f"{where} is of joints {', '.join(trajectory.joints)} in {trajectory.unit}, but "
                f"demonstration 0 is of {', '.join(recorded[0].joints)} in {recorded[0].unit}: "
                "save them in files of their own"
            )
        row: dict[str, Any] = {
            "times": trajectory.times.tolist(),
            "positions": trajectory.positions.tolist(),
            "outcome": {
                kind: _plain(value, f"{where}, outcome {kind!r}")
                for kind, value in _outcome(task, demonstration.outcome, where).items()
            },
        }
        if demonstration.context is not None:
            row["context"] = _plain(demonstration.context, f"{where}, context")
        rows.append(row)
    head = {"format": FORMAT, "version": VERSION, "teacher": teacher, "comment": comment}
    joints = {"joints": list(recorded[0].joints), "unit": recorded[0].unit}
    text = json.dumps({**head, **joints, "demonstrations": rows}, ensure_ascii=False)
    return text.replace('{"times"', '\n{"times"') + "\n"


def load_demonstrations(path: str | Path, task: Task) -> list[Demonstration]:
    """Read recorded movements from a file, for a `DemonstrationSet` to answer from.

    Args:
        path: The file, of at most 64 MiB.
        task: The task they are for. Outcomes must fit it and, if it has a primitive, so must
            joints and unit; angles may be in rad or deg.

    Returns:
        The demonstrations, each with trajectory, outcome and the teacher's name.

    Raises:
        TeacherError: If the file cannot be read, is too large or malformed, or does not belong
            to the task; the message says which demonstration and which field.
    """
    try:
        return _demonstrations(_content(Path(path)), task)
    except SgimError as error:
        raise TeacherError(f"{path}: {error}") from error
    except OSError as error:
        raise TeacherError(f"{path} cannot be read: {error.strerror or error}") from error


def _content(path: Path) -> Any:
    with path.open("rb") as file:
        size = file.seek(0, 2)
        if size > LARGEST_FILE:
            raise TeacherError(
                f"it has {size} bytes, but at most {LARGEST_FILE} are read: split it, or record "
                "fewer samples a second"
            )
        file.seek(0)
        return _parsed(file.read(LARGEST_FILE))


def read_demonstrations(data: bytes, task: Task) -> list[Demonstration]:
    """As `load_demonstrations`, of what such a file holds; the caller limits its size.

    Raises:
        TeacherError: If it is malformed, or does not belong to the task.
    """
    return _demonstrations(_parsed(data), task)


def _parsed(data: bytes) -> Any:
    try:
        return json.loads(data.decode("utf-8"))
    except (ValueError, RecursionError) as error:
        raise TeacherError(f"it is not a JSON file: {error}") from None


def _demonstrations(content: Any, task: Task) -> list[Demonstration]:
    if not isinstance(content, dict) or content.get("format") != FORMAT:
        raise TeacherError(f'it is not a file of demonstrations: "format" is not "{FORMAT}"')
    if content.get("version") != VERSION:
        raise TeacherError(
            f"version is {content.get('version')!r:.40}, but this sgim reads version {VERSION}: "
            "use the release that wrote it, or a newer one"
        )
    _require_fields(content, _FIELDS, ("teacher", "joints", "unit", "demonstrations"), "file")
    teacher, unit, joints = content["teacher"], content["unit"], content["joints"]
    for field, value in (("teacher", teacher), ("unit", unit)):
        if not isinstance(value, str) or not value:
            raise TeacherError(f"{field} is {value!r:.40}, expected a name")
    if not _are_names(joints):
        raise TeacherError(f"joints is {joints!r:.80}, expected a list of different names")
    if task.primitive is not None:
        expected = (task.primitive.joints, task.primitive.unit)
        unit_factor((joints, unit), expected, "joints and unit: it")
    rows = content["demonstrations"]
    if not isinstance(rows, list) or not rows:
        raise TeacherError("demonstrations: expected a list of one or more")
    return [_demonstration(row, i, task, teacher, joints, unit) for i, row in enumerate(rows)]


def _demonstration(
    row: Any, index: int, task: Task, teacher: str, joints: list[str], unit: str
) -> Demonstration:
    where = f"demonstration {index}"
    if not isinstance(row, dict):
        raise TeacherError(f"{where} is {row!r:.40}, expected an object")
    _require_fields(row, _DEMONSTRATION_FIELDS, ("positions", "outcome"), where)
    positions = _positions(row["positions"], joints, f"{where}, positions")
    times = _times(row, len(positions), where)
    outcome, context = row["outcome"], row.get("context")
    if not isinstance(outcome, dict):
        raise TeacherError(f"{where}, outcome is {outcome!r:.40}, expected {{kind: point}}")
    for kind, value in outcome.items():
        _require_point(value, f"{where}, outcome {kind!r}")
    try:
        trajectory = Trajectory(times, positions, joints, unit)
        if context is not None:
            _require_point(context, f"{where}, context")
            context = task.check_context(context)
    except SgimError as error:
        raise TeacherError(f"{where}: {error}") from error
    shown = _outcome(task, outcome, where)
    return Demonstration(shown, trajectory=trajectory, teacher=teacher, context=context)


def _require_fields(
    row: Mapping[str, Any], known: Sequence[str], needed: Sequence[str], where: str
) -> None:
    for field in row:
        if field not in known:
            raise TeacherError(f"{where}: {unknown('field', field, known)}")
    for field in needed:
        if field not in row:
            raise TeacherError(f"{where} lacks the field {field!r}")


def _are_names(value: Any) -> bool:
    named = isinstance(value, list) and all(isinstance(v, str) and v for v in value)
    return named and 0 < len(value) == len(set(value))


def _positions(value: Any, joints: list[str], where: str) -> FloatArray:
    if not isinstance(value, list) or len(value) < _FEWEST_SAMPLES:
        raise TeacherError(f"{where}: expected a list of {_FEWEST_SAMPLES} or more samples")
    for i, sample in enumerate(value):
        if not isinstance(sample, list) or len(sample) != len(joints):
            raise TeacherError(
                f"{where}[{i}] is {sample!r:.40}, expected {len(joints)} numbers: "
                f"[{', '.join(joints)}]"
            )
        _require_numbers(sample, f"{where}[{i}]")
    return np.array(value, dtype=np.float64)


def _times(row: Mapping[str, Any], samples: int, where: str) -> FloatArray:
    if ("times" in row) == ("rate" in row):
        raise TeacherError(f"{where} has both times and rate, or neither: give one of them")
    if "rate" in row:
        rate = row["rate"]
        _require_number(rate, f"{where}, rate")
        if not _SLOWEST <= rate <= _FASTEST:
            raise TeacherError(
                f"{where}, rate is {rate}, expected {_SLOWEST:g} to {_FASTEST:g} samples a second"
            )
        return np.arange(samples) / float(rate)
    times = row["times"]
    if not isinstance(times, list) or len(times) != samples:
        came = f"{len(times)} numbers" if isinstance(times, list) else f"{times!r:.40}"
        raise TeacherError(f"{where}, times: {came} came, expected one for each of {samples}")
    _require_numbers(times, f"{where}, times")
    return np.array(times, dtype=np.float64)


def _require_point(value: Any, where: str) -> None:
    """A vector or a number, all finite, or a label."""
    if isinstance(value, list):
        _require_numbers(value, where)
    elif not isinstance(value, str):
        _require_number(value, where)


def _require_numbers(values: list[Any], where: str) -> None:
    for i, value in enumerate(values):
        _require_number(value, f"{where}[{i}]")


def _require_number(value: Any, where: str) -> None:
    number = isinstance(value, int | float) and not isinstance(value, bool)
    if not number or not abs(value) <= sys.float_info.max:
        raise TeacherError(f"{where} is {value!r:.40}, expected a finite number")


def _outcome(task: Task, outcome: Outcome, where: str) -> dict[str, Any]:
    try:
        checked = task.check_outcome(outcome)
    except SgimError as error:
        raise TeacherError(f"{where}: {error}") from error
    if not checked:
        raise TeacherError(f"{where}, outcome is empty: a demonstration shows one kind or more")
    return checked


def _plain(value: Any, where: str) -> Any:
    """The point as JSON has it."""
    if isinstance(value, str):
        return value
    array = np.asarray(value)
    if array.dtype.kind not in "iuf" or array.ndim > 1:
        raise TeacherError(f"{where} is {value!r:.40}; only numbers and labels can be saved")
    return array.tolist()
