"""Tables over worlds: how learners do in each, or what a part is worth that is taken away.

Sweeps first, then a table of their journals; a row is a world, a column a learner::

    sgim sweep benchmarks/worlds/few.toml --out runs/few
    python benchmarks/worlds.py runs/few --at 100 --against sagg-riac
    sgim sweep benchmarks/worlds/ablations.toml --out runs/ablations
    python benchmarks/worlds.py runs/ablations --at 2000 --against "sagg-riac (modern)"

The first column is the reference's interquartile mean, the others the ratio of the learner's to it,
with the 95 % interval over paired seeds; in bold where the interval has no 1. Above 1 the reference
is better. The last row is how often each is better and worse in that sense.
"""

from __future__ import annotations

import argparse
from collections import defaultdict
from pathlib import Path

from sgim.experiments import EXPERIMENTS
from sgim.runs.comparison import compare
from sgim.runs.contrasts import Contrast
from sgim.runs.measured import MeasuredRun, read_measured


def read(folders: list[Path]) -> dict[str, list[MeasuredRun]]:
    """The runs of each experiment, in the library's order."""
    found: dict[str, list[MeasuredRun]] = defaultdict(list)
    for path in (path for folder in folders for path in sorted(folder.glob("*.sgim"))):
        run = read_measured(path)
        found[str(run.experiment)].append(run)
    return {name: found[name] for name in EXPERIMENTS if name in found}


def differs(contrast: Contrast) -> int:
    """1 if the reference is better, -1 if the other is, 0 if their order is not shown."""
    return int(contrast.ratio.low > 1) - int(contrast.ratio.high < 1)


def cell(contrast: Contrast | None) -> str:
    if contrast is None:
        return "–"
    ratio = contrast.ratio
    text = f"{ratio.value:.2f} [{ratio.low:.2f}, {ratio.high:.2f}]"
    return f"**{text}**" if differs(contrast) else text


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("folders", nargs="+", type=Path)
    parser.add_argument("--at", type=int, help="movements; the last evaluation if not given")
    parser.add_argument("--against", required=True, help="the reference")
    given = parser.parse_args()
    rows: dict[str, tuple[str, int, dict[str, Contrast]]] = {}
    for name, runs in read(given.folders).items():
        found = compare(runs, at=given.at, against=given.against)
        reference = next(group for group in found.groups if group.name == found.reference)
        middle, contrasts = reference.middle, {c.name: c for c in found.contrasts}
        text = f"{middle.value:.3g} [{middle.low:.3g}, {middle.high:.3g}]"
        rows[name] = (text, len(reference.runs), contrasts)
    names = sorted({name for _, _, contrasts in rows.values() for name in contrasts})
    print("| world | runs | " + " | ".join([given.against, *names]) + " |")
    print("|---" * (len(names) + 3) + "|")
    for world, (text, runs_made, contrasts) in rows.items():
        cells = [cell(contrasts.get(name)) for name in names]
        print(f"| `{world}` | {runs_made} | " + " | ".join([text, *cells]) + " |")
    counts = []
    for name in names:
        signs = [differs(c[name]) for _, _, c in rows.values() if name in c]
        counts.append(f"{signs.count(-1)} better, {signs.count(1)} worse, of {len(signs)}")
    print("| | | | " + " | ".join(counts) + " |")


if __name__ == "__main__":
    main()
