"""The five demonstrators of the thesis's section 3.3.3, and teachers made of them.

1. What a SAGG-RIAC learner has tried, drawn at random, one movement a tile.
2. The same, but of several in a tile the movement whose landings vary least.
3. Kinaesthetic demonstrations, simulated: recorded angles of the joints, not policies.
4. Those of 3 that land behind the arm's base, y < 0, where random movements seldom do.
5. Those of 3 that land before it, y > 0, where the float hangs at the start.
"""

from __future__ import annotations

from collections.abc import Sequence
from importlib.resources import files
from pathlib import Path

import numpy as np

from sgim.environments.fishing.model import JOINTS
from sgim.errors import SgimError, unknown
from sgim.records import Demonstration, Trajectory
from sgim.task import Task
from sgim.teachers import LeastExplored, Teacher

RECORDINGS = "fishing_kinaesthetic.npz"
FLOOR_RECORDINGS = "fishing_floor_kinaesthetic.npz"
LEARNED = {1: "fishing_learned_random.npz", 2: "fishing_learned_reliable.npz"}

TILE = 1 / 6
"""Length of the sides of the tiles that teachers watch, in m; each has about one demonstration."""

FLOOR_TILE = 1 / 6
"""The same for the floor, in sides of the view."""

DEMONSTRATORS = {
    1: "movements of a learner, drawn at random",
    2: "movements of a learner, the most reliable ones",
    3: "recorded movements of the joints, led smoothly",
    4: "those of D3 that land behind the base, where few do by chance",
    5: "those of D3 that land before the base",
}
"""Number → what it shows."""


def fishing_demonstrations(demonstrator: int) -> list[Demonstration]:
    """What a demonstrator has to show.

    Args:
        demonstrator: 1 to 5; see the module.

    Returns:
        Demonstrations with a policy from 1 and 2, and with a trajectory in rad from 3, 4 and 5.

    Raises:
        UnknownNameError: If there is no such demonstrator.
    """
    if demonstrator not in DEMONSTRATORS:
        raise unknown("demonstrator", demonstrator, map(str, DEMONSTRATORS))
    if demonstrator in LEARNED:
        return _read_policies(LEARNED[demonstrator])
    shown = _read_recordings(RECORDINGS, "float")
    if demonstrator == 3:
        return shown
    behind = demonstrator == 4
    return [d for d in shown if (d.outcome["float"][1] < 0) == behind]


def fishing_teacher(demonstrator: int, task: Task) -> Teacher:
    """A demonstrator who shows what the learner has explored least; one for each run."""
    shown = fishing_demonstrations(demonstrator)
    return LeastExplored(shown, task, kind="float", tile=TILE)


def floor_demonstrations() -> list[Demonstration]:
    """What the floor's teacher has to show: recorded movements, as those of demonstrator 3."""
    return _read_recordings(FLOOR_RECORDINGS, "ball")


def floor_teacher(task: Task) -> Teacher:
    """The floor's teacher, who shows what the learner has explored least; one for each run."""
    return LeastExplored(floor_demonstrations(), task, kind="ball", tile=FLOOR_TILE)


def write_recordings(path: Path, demonstrations: Sequence[Demonstration], kind: str) -> None:
    """Write demonstrations that are trajectories of the arm's joints, in rad."""
    recordings = [d.trajectory for d in demonstrations if d.trajectory is not None]
    np.savez_compressed(
        path,
        landings=np.array([d.outcome[kind] for d in demonstrations]),
        samples=np.array([len(r.times) for r in recordings]),
        times=np.concatenate([r.times for r in recordings]),
        positions=np.concatenate([r.positions for r in recordings]).astype(np.float32),
        joints=np.array(JOINTS),
    )


def write_policies(path: Path, demonstrations: Sequence[Demonstration]) -> None:
    """Write demonstrations that are policies."""
    np.savez_compressed(
        path,
        landings=np.array([d.outcome["float"] for d in demonstrations]),
        policies=np.array([d.policy for d in demonstrations]),
    )


def _read_recordings(name: str, kind: str) -> list[Demonstration]:
    stored = _read(name)
    ends = np.cumsum(stored["samples"])[:-1]
    joints = tuple(stored["joints"].tolist())
    parts = zip(
        stored["landings"],
        np.split(stored["times"], ends),
        np.split(stored["positions"], ends),
        strict=True,
    )
    return [
        Demonstration({kind: landing}, trajectory=Trajectory(times, positions, joints, "rad"))
        for landing, times, positions in parts
    ]


def _read_policies(name: str) -> list[Demonstration]:
    stored = _read(name)
    pairs = zip(stored["landings"], stored["policies"], strict=True)
    return [Demonstration({"float": landing}, policy=policy) for landing, policy in pairs]


def _read(name: str) -> dict[str, np.ndarray[tuple[int, ...], np.dtype[np.generic]]]:
    """The arrays of a file in the package's data folder."""
    resource = files("sgim.environments") / "data" / name
    if not resource.is_file():
        raise SgimError(f"the package has no data {name!r} in sgim/environments/data")
    with resource.open("rb") as stream, np.load(stream, allow_pickle=False) as stored:
        return dict(stored)
