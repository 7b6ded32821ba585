"""What the page shows of a run, read from its journal as that grows.

Counting and sampling are left to SQLite, so that a long run costs the page little and the run
nothing, and a page in the run's own process does not keep it from computing.
"""

from __future__ import annotations

import json
import sqlite3
from collections import Counter, deque
from collections.abc import Callable
from contextlib import closing
from pathlib import Path
from typing import Any

import numpy as np

from sgim.errors import SgimError
from sgim.experiments import EXPERIMENTS
from sgim.runs.journal_file import open_file
from sgim.runs.journal_reading import read_header, recorded_task
from sgim.runs.letters import has_letters
from sgim.runs.rows import DECLINED
from sgim.spaces import Box
from sgim.task import Task
from sgim.web.protocol import GoalMark, Kind, ModeFacts, Outcomes, Region, RunFacts

SLICE = 250
"""Fewest rows that are counted at once: the grain of the strip of modes."""

SLICES = 30
"""Most slices at a look, however much has come."""

AT_ONCE = 400_000
"""Rows read at once, so that the page answers meanwhile."""

MOST_POINTS = 4000
"""Outcomes of a kind on the page; of more, every so manieth is."""

WINDOWS = 60
LATEST_GOALS = 60
LATELY = 10

_DRAWN = 2


class Watched:
    """A run, as the page sees it.

    Args:
        number: Its number on the page.
        path: Its journal.
        task: Its task, if it is not of the library's spaces.
        regions: Gives the regions of its interest map; None if they are not known.
    """

    def __init__(
        self,
        number: int,
        path: Path,
        task: Task | None = None,
        regions: Callable[[], list[Region]] | None = None,
    ) -> None:
        self.number = number
        self.path = path
        with closing(open_file(path, append=False, durable=False)) as db:
            self.header = read_header(db, path)
        self.task = recorded_task(self.header, path, task)
        self.movements = 0
        self._regions = regions
        self._boxes = {k: s for k, s in self.task.outcome_spaces.items() if isinstance(s, Box)}
        self._problem = ""
        self._after = 0
        self._target = 0
        self._evaluations: list[list[float]] = []
        self._errors: list[str] = []
        self._modes: dict[str, list[float]] = {}
        self._lately: dict[str, deque[tuple[float, float]]] = {}
        self._strip: list[tuple[int, Counter[str]]] = []
        self._goals: deque[GoalMark] = deque(maxlen=LATEST_GOALS)
        self._shown: deque[GoalMark] = deque(maxlen=500)
        self._requests: Counter[str] = Counter()
        self._seconds = 0.0
        self._every = 1
        self._points: dict[str, list[tuple[int, int, float, float]]] = {k: [] for k in self._boxes}
        self._fresh: dict[str, int] = dict.fromkeys(self._boxes, 0)

    def look(self) -> bool:
        """Read on.

        Returns:
            Whether there was anything new.
        """
        try:
            with closing(open_file(self.path, append=False, durable=False)) as db:
                ((last,),) = db.execute("SELECT coalesce(max(seq), 0) FROM events")
                end = min(last, self._after + AT_ONCE)
                begun = self._after
                grain = max(SLICE, (end - begun) // SLICES)
                while self._after < end:
                    upto = min(end, self._after + grain)
                    self._count(db, self._after, upto)
                    self._after = upto
                if has_letters(db):
                    self._requests["asked"] = db.execute(
                        "SELECT count(*) FROM requests"
                    ).fetchone()[0]
        except (sqlite3.Error, SgimError) as error:
            changed = self._problem != str(error)
            self._problem = str(error)
            return changed
        changed = begun < end or bool(self._problem)
        self._problem = ""
        return changed

    def _count(self, db: sqlite3.Connection, after: int, upto: int) -> None:
        rows = (after, upto)
        within = "FROM events WHERE seq > ? AND seq <= ?"
        counts = dict(db.execute(f"SELECT event, count(*) {within} GROUP BY event", rows))
        if "told" in counts:
            self._sample(db, within, rows, counts["told"])
        self.movements += counts.get("told", 0)
        if "opened" in counts:
            statement = f"SELECT name, count(*) {within} AND event = 'opened' GROUP BY name"
            opened = Counter(dict(db.execute(statement, rows)))
            for mode in opened:
                self._mode(mode)
            self._strip.append((self.movements, opened))
            if len(self._strip) > 4 * WINDOWS:
                self._strip = _merged(self._strip, 2 * WINDOWS)
            statement = (
                f"SELECT kind, point, name {within} AND event = 'opened' AND kind IS NOT NULL "
                f"ORDER BY seq DESC LIMIT {LATEST_GOALS}"
            )
            for kind, packed, mode in db.execute(statement, rows).fetchall()[::-1]:
                self._mark(self._goals, kind, packed, list(self._mode(mode)[1]).index(mode))
        if "closed" in counts:
            self._end_episodes(db, within, rows)
        if counts.keys() & {"answered", "demonstrated", "ended"}:
            self._count_requests(db, within, rows)
        if counts.keys() & {"evaluated", "session"}:
            statement = f"SELECT event, detail {within} AND event IN ('evaluated', 'session')"
            for event, detail in db.execute(statement, rows):
                self._note(event, json.loads(detail))

    def _mode(self, name: str) -> tuple[list[float], dict[str, list[float]]]:
        """Sums of a mode (episodes, movements, progress), and those of all."""
        return self._modes.setdefault(name, [0.0, 0.0, 0.0]), self._modes

    def _sample(self, db: sqlite3.Connection, within: str, rows: Any, told: int) -> None:
        """Keep some of the outcomes, each with about the movement it came at."""
        after, upto = rows
        statement = (
            f"SELECT seq, kind, point {within} AND event IN ('told', 'also') "
            "AND kind IS NOT NULL AND seq % ? < 8"
        )
        # Whole groups of rows are kept, so that each kind of outcome is met.
        for seq, kind, packed in db.execute(statement, (*rows, 8 * self._every)):
            box = self._boxes.get(kind)
            if box is not None:
                x, y = (*box.unpack(packed)[:_DRAWN].tolist(), 0.0)[:_DRAWN]
                number = self.movements + told * (seq - after) // (upto - after)
                self._points[kind].append((seq, number, x, y))
        while any(len(points) > MOST_POINTS for points in self._points.values()):
            self._every *= 2
            for kind, points in self._points.items():
                self._points[kind] = [p for p in points if p[0] % (8 * self._every) < 8]
                self._fresh[kind] = 0

    def _end_episodes(self, db: sqlite3.Connection, within: str, rows: Any) -> None:
        gain = "json_extract(detail, '$.after') - json_extract(detail, '$.before')"
        statement = (
            f"SELECT name, count(*), sum(json_extract(detail, '$.movements')), sum({gain}) "
            f"{within} AND event = 'closed' GROUP BY name"
        )
        for name, episodes, movements, progress in db.execute(statement, rows):
            sums = self._mode(name)[0]
            lately = self._lately.setdefault(name, deque(maxlen=LATELY))
            lately.append((movements or 0, progress or 0.0))
            for i, value in enumerate((episodes, movements or 0, progress or 0.0)):
                sums[i] += value

    def _count_requests(self, db: sqlite3.Connection, within: str, rows: Any) -> None:
        statement = (
            f"SELECT event, name, kind, point, seconds, detail {within} "
            "AND event IN ('answered', 'demonstrated', 'ended')"
        )
        for event, name, kind, packed, seconds, detail in db.execute(statement, rows):
            self._seconds += seconds or 0.0 if event == "answered" else 0.0
            if event == "ended":
                self._requests[name] += 1
            elif event == "answered" and detail == DECLINED:
                self._requests["declined"] += 1
            else:
                self._requests["answered" if event == "answered" else "unasked"] += 1
                self._mark(self._shown, kind, packed, self.movements)

    def _mark(self, marks: deque[GoalMark], kind: str, packed: bytes, number: int) -> None:
        space = self.task.goal_spaces.get(kind, self.task.outcome_spaces.get(kind))
        if isinstance(space, Box):
            marks.append(GoalMark(kind, space.unpack(packed)[:_DRAWN].tolist(), number))

    def _note(self, event: str, facts: dict[str, Any]) -> None:
        if event == "session":
            self._target = int(facts.get("target", self._target))
        else:
            self._errors = list(facts["errors"])
            self._evaluations.append([facts["movements"], *facts["errors"].values()])

    def facts(self) -> RunFacts:
        """How the run stands."""
        experiment = str(self.header.get("experiment") or "")
        declared = EXPERIMENTS.get(experiment)
        recipe = self.header.get("recipe") or {}
        learner = self.header.get("learner") or recipe.get("learner")
        parts = [experiment, learner, f"seed {recipe['seed']}" if "seed" in recipe else None]
        modes = list(self._modes)
        return RunFacts(
            run=self.number,
            title=", ".join(str(p) for p in parts if p) or self.path.stem,
            experiment=experiment,
            movements=self.movements,
            target=self._target,
            finished=0 < self._target <= self.movements,
            unit=declared.unit if declared else "",
            kinds=[_kind(kind, box) for kind, box in self._boxes.items()],
            evaluations=self._evaluations,
            errors=self._errors,
            modes=[self._mode_facts(name) for name in modes],
            strip=[
                [end, *(counts[mode] for mode in modes)]
                for end, counts in _merged(self._strip, WINDOWS)
            ],
            goals=list(self._goals),
            shown=list(self._shown),
            regions=self._regions() if self._regions is not None else [],
            requests=dict(self._requests),
            seconds=self._seconds,
            problem=self._problem,
        )

    def _mode_facts(self, name: str) -> ModeFacts:
        episodes, movements, progress = self._modes[name]
        moved, gained = np.sum(self._lately.get(name) or [(0, 0.0)], axis=0).tolist()
        lately = gained / moved if moved else 0.0
        return ModeFacts(name, int(episodes), int(movements), progress, lately)

    def outcomes(self, *, all_: bool = False) -> list[Outcomes]:
        """The outcomes that the page has not been sent yet, or all of those kept."""
        news = []
        for kind, points in self._points.items():
            first = 0 if all_ else self._fresh[kind]
            if len(points) > first or all_:
                rows = [[n, _short(x), _short(y)] for _, n, x, y in points[first:]]
                news.append(Outcomes(self.number, kind, first == 0, rows))
            if not all_:
                self._fresh[kind] = len(points)
        return news


def _short(value: float) -> float:
    return float(f"{value:.4g}")


def _kind(kind: str, box: Box) -> Kind:
    return Kind(
        kind,
        list(box.names),
        [unit or "" for unit in box.units],
        box.low.tolist(),
        box.high.tolist(),
    )


def _merged(strip: list[tuple[int, Counter[str]]], windows: int) -> list[tuple[int, Counter[str]]]:
    """Slices as at most so many windows of equal length in movements."""
    if not strip:
        return []
    merged: list[tuple[int, Counter[str]]] = []
    length = max(1.0, strip[-1][0] / windows)
    window = -1
    for end, counts in strip:
        if (number := int((end - 1) / length)) != window:
            window = number
            merged.append((end, Counter()))
        merged[-1] = (end, merged[-1][1] + counts)
    return merged
