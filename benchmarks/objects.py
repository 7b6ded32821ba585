"""What recognising objects costs: an action, a picture, its features, and recognising it.

Every figure is the median over actions of all kinds with all toys, in processor time of one core,
in turn with a reference: a fixed loop of small NumPy operations. Run it with
``python benchmarks/objects.py``; it takes a minute.
"""

from __future__ import annotations

import time
from collections.abc import Callable
from typing import TypeVar

import numpy as np

from sgim.environments.objects import ToyTable, kept_pictures
from sgim.environments.objects.table import ACTIONS
from sgim.recognition import Recogniser
from sgim.streams import Streams

PICTURES = 150
REQUIRED = 20.0  # ms

Result = TypeVar("Result")


def timed(work: Callable[[], Result], times: list[float]) -> Result:
    begun = time.process_time()
    result = work()
    times.append(1000 * (time.process_time() - begun))
    return result


def reference(iterations: int = 500) -> None:
    x = np.linspace(0, 1, 20)
    for _ in range(iterations):
        y = np.sqrt(x * x + 1.0)
        x = y / y.max()


def main() -> None:
    table, streams, recogniser = ToyTable(), Streams(0), Recogniser()
    for toy, features in kept_pictures().items():
        for one in features[:20]:
            recogniser.learn(one, toy)
    policies = [f"{action} {toy}" for action in ACTIONS for toy in table.toys.labels]
    for number in range(30):  # the camera keeps the empty table of each zoom
        table.execute(policies[number % len(policies)], None, streams("warm", number))
    references: list[float] = []
    moving: list[float] = []
    seeing: list[float] = []
    looking: list[float] = []
    recognising: list[float] = []
    for number in range(PICTURES):
        action, toy = policies[number % len(policies)].split(" ")
        rng = streams("benchmark", number)
        timed(reference, references)
        pose = timed(lambda: table.moved(toy, action, rng), moving)  # noqa: B023
        picture = timed(lambda: table.picture(toy, pose, rng), seeing)  # noqa: B023
        features = timed(lambda: table.eye.look(picture), looking)  # noqa: B023
        timed(lambda: recogniser.recognise(features), recognising)  # noqa: B023
    report("reference", references, references)
    report("action and settling", moving, references)
    report("camera, 320 × 240", seeing, references)
    report("features", looking, references)
    report(f"recognition among {len(recogniser.views.labels)} views", recognising, references)
    whole = np.array(moving) + seeing
    report(f"simulation and camera, at most {REQUIRED:g} ms", [*whole], references)
    picture_in = np.array(looking) + recognising
    report(f"recognition of a picture, at most {REQUIRED:g} ms", [*picture_in], references)


def report(what: str, times: list[float], references: list[float]) -> None:
    ratio = np.median(times) / np.median(references)
    print(f"{what:46} {np.median(times):6.1f} ms {ratio:7.2f} × reference")


if __name__ == "__main__":
    main()
