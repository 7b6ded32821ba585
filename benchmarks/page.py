"""Times the page: from a drag to the answered pose, and what watching costs a run.

Run it as ``python benchmarks/page.py`` (drags), or with ``--watch`` (a vocal run with and without a
page that watches it, in the same process and beside it: the time it takes, and the CPU time of its
process, on which what else the machine does counts less).
"""

from __future__ import annotations

import argparse
import asyncio
import json
import statistics
import subprocess
import sys
import tempfile
import threading
import time
from pathlib import Path
from urllib.error import HTTPError
from urllib.parse import urlsplit
from urllib.request import HTTPRedirectHandler, Request, build_opener

import numpy as np
import websockets

import sgim
from sgim.environments.fishing import FishingRod
from sgim.experiments import experiment
from sgim.experiments.vocal import BATCH
from sgim.teachers import RemoteTeacher
from sgim.web import serve

DRAGS = 600
VOCALISATIONS = 240_000


def cookie_of(url: str) -> str:
    """What the token of a page's address is exchanged for."""

    class Stay(HTTPRedirectHandler):
        def redirect_request(self, *_: object) -> None:
            return None

    try:
        build_opener(Stay).open(Request(url))
    except HTTPError as answer:
        return str(answer.headers["set-cookie"]).partition(";")[0]
    raise RuntimeError("no cookie came")


async def drags(url: str) -> list[float]:
    """Times in ms from sending a sample of a drag to the pose that answers it, at 60 a second."""
    host = urlsplit(url).netloc
    waits = []
    async with websockets.connect(
        f"ws://{host}/socket",
        origin=f"http://{host}",
        additional_headers={"Cookie": cookie_of(url)},
    ) as socket:

        async def send(**message: object) -> None:
            await socket.send(json.dumps(message))

        async def pose(number: int) -> None:
            while True:
                message = json.loads(await socket.recv())
                if message["what"] == "pose" and message["number"] == number:
                    return

        await send(what="hello", version=1, page="benchmark", name="benchmark")
        await send(what="control", take=True)
        await send(what="reset", joints=None)
        await pose(-1)
        for number in range(DRAGS):
            t = number / 60
            place = [0.2 * np.sin(2 * t), 0.5 + 0.1 * np.cos(3 * t), 0.75 + 0.1 * np.sin(t)]
            begun = time.perf_counter()
            await send(what="lead", number=number, by="tip", samples=[[t, *place]])
            await pose(number)
            waits.append(1000 * (time.perf_counter() - begun))
            await asyncio.sleep(max(0.0, 1 / 60 - (time.perf_counter() - begun)))
    return waits


def report(what: str, waits: list[float]) -> None:
    low, high = np.percentile(waits, [5, 95])
    median = statistics.median(waits)
    print(f"{what:44} median {median:5.1f} ms, 5 to 95 %: {low:.1f} to {high:.1f} ms", flush=True)


def time_drags(folder: Path) -> None:
    """Drags of the tip: with a run that stands, at the pace of a lesson, and at full speed."""
    for what, pace in (
        ("the run stands", None),
        ("the run goes on, 2 movements a second", 2.0),
        ("the run goes on as fast as it can", float("inf")),
    ):
        rod = FishingRod()
        learner = sgim.algorithms.make("sgim-acts", rod.task, ["person"], seed=1)
        run = sgim.Run(
            learner,
            rod,
            {"person": RemoteTeacher()},
            journal=folder / f"{pace}.sgim",
            about={"experiment": "fishing"},
        )
        with serve(run, port=0) as page:
            over = threading.Event()
            going = threading.Thread(target=explore_on, args=(run, pace, over))
            going.start()
            report(what, asyncio.run(drags(page.url)))
            over.set()
            going.join()
        run.close()


def explore_on(run: sgim.Run, pace: float | None, over: threading.Event) -> None:
    """Let a run go on at a pace, if it is to go on, until it is over."""
    while pace is not None and not over.is_set():
        run.go(run.movements + 2, pace=pace)


def explore(folder: Path, name: str, movements: int, watched: str) -> tuple[float, float]:
    """Seconds of a run, and of CPU of its process, if nobody watches, a page in it, or another."""
    vocal, path = experiment("vocal"), folder / f"{name}.sgim"
    learner = vocal.learner("sagg-riac-gmm", seed=1)
    run = vocal.run(learner, path, batch=BATCH, evaluate_every=10**9)
    assert run.journal is not None
    run.journal.commit()
    others: list[subprocess.Popen[str]] = []
    page = serve(run, port=0) if watched == "here" else None
    url = "" if page is None else page.url
    if watched == "beside":
        command = [sys.executable, "-m", "sgim.cli", "watch", str(path), "--port", "0"]
        others.append(subprocess.Popen(command, stdout=subprocess.PIPE, text=True))
        url = next(line for line in others[0].stdout or () if line.startswith("open")).split()[1]
    if url:
        command = [sys.executable, __file__, "--look", url]
        others.append(subprocess.Popen(command, stdout=subprocess.PIPE, text=True))
        next(iter(others[-1].stdout or ()))
    begun, cpu = time.perf_counter(), time.process_time()
    run.go(movements)
    took = time.perf_counter() - begun, time.process_time() - cpu
    for other in reversed(others):
        other.kill()
        other.communicate()
    if page is not None:
        page.close()
    run.close()
    return took


async def look(url: str) -> None:
    """Read all that a page is sent, as a browser does, until it is closed."""
    host = urlsplit(url).netloc
    async with websockets.connect(
        f"ws://{host}/socket",
        origin=f"http://{host}",
        additional_headers={"Cookie": cookie_of(url)},
    ) as socket:
        hello = {"what": "hello", "version": 1, "page": "looker", "name": "looker"}
        await socket.send(json.dumps(hello))
        async for _ in socket:
            print("looking", flush=True)


def time_watching(folder: Path, movements: int, rounds: int) -> None:
    """How much longer a run takes when it is watched, in turn with one that is not."""
    times: dict[str, list[tuple[float, float]]] = {"nobody": [], "here": [], "beside": []}
    for number in range(rounds):
        for watched, kept in times.items():
            kept.append(explore(folder, f"{watched}{number}", movements, watched))
            print(f"{watched:8} {kept[-1][0]:.2f} s, {kept[-1][1]:.2f} s of CPU", flush=True)
    for watched in ("here", "beside"):
        for which, what in enumerate(("time", "CPU time")):
            pairs = zip(times[watched], times["nobody"], strict=True)
            ratios = sorted(one[which] / other[which] for one, other in pairs)
            print(
                f"watched {watched}: {statistics.median(ratios):.3f} times the {what} "
                f"({ratios[0]:.3f} to {ratios[-1]:.3f}), {movements} movements"
            )


def main() -> None:
    """Time what is asked for."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--watch", action="store_true")
    parser.add_argument("--look", help="only read what a page of this address is sent")
    parser.add_argument("--movements", type=int, default=VOCALISATIONS)
    parser.add_argument("--rounds", type=int, default=3)
    given = parser.parse_args()
    if given.look:
        asyncio.run(look(given.look))
        return
    with tempfile.TemporaryDirectory() as name:
        if given.watch:
            time_watching(Path(name), given.movements, given.rounds)
        else:
            time_drags(Path(name))


if __name__ == "__main__":
    main()
