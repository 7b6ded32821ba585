"""Socially guided intrinsic motivation: learners that choose what to aim at, how, and from whom.

The names here are all that most uses need; they are imported when used, so that importing the
package costs little.
"""

from __future__ import annotations

from importlib import import_module
from importlib.metadata import PackageNotFoundError
from importlib.metadata import version as _version
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from sgim import algorithms
    from sgim.configurations import CONFIGURATIONS, Configuration
    from sgim.errors import SgimError
    from sgim.learner import Learner
    from sgim.records import Demonstration, Goal, Outcome, Plan, Solution, Trajectory, Trial
    from sgim.runs import Benchmark, Journal, Run, keep_journal
    from sgim.runs import open_repertoire as open  # noqa: A004 - sgim.open is meant
    from sgim.spaces import Box, Choices, Space
    from sgim.task import Task

_HOMES = {
    "Benchmark": "sgim.runs",
    "Box": "sgim.spaces",
    "CONFIGURATIONS": "sgim.configurations",
    "Choices": "sgim.spaces",
    "Configuration": "sgim.configurations",
    "Demonstration": "sgim.records",
    "Goal": "sgim.records",
    "Journal": "sgim.runs",
    "Learner": "sgim.learner",
    "Outcome": "sgim.records",
    "Plan": "sgim.records",
    "Run": "sgim.runs",
    "SgimError": "sgim.errors",
    "Solution": "sgim.records",
    "Space": "sgim.spaces",
    "Task": "sgim.task",
    "Trajectory": "sgim.records",
    "Trial": "sgim.records",
    "keep_journal": "sgim.runs",
    "open": "sgim.runs",
}

_PACKAGES = {
    "algorithms",
    "environments",
    "experiments",
    "figures",
    "memory",
    "outcome",
    "policy",
    "primitives",
    "runs",
    "statistics",
    "strategy",
    "teachers",
    "testing",
    "web",
}

try:
    __version__ = _version("sgim")
except PackageNotFoundError:  # run from a source tree that is not installed
    __version__ = "0"

__all__ = [
    "Benchmark",
    "Box",
    "CONFIGURATIONS",
    "Choices",
    "Configuration",
    "Demonstration",
    "Goal",
    "Journal",
    "Learner",
    "Outcome",
    "Plan",
    "Run",
    "SgimError",
    "Solution",
    "Space",
    "Task",
    "Trajectory",
    "Trial",
    "algorithms",
    "keep_journal",
    "open",
]


def __getattr__(name: str) -> Any:
    if name in _PACKAGES:
        return import_module(f"sgim.{name}")
    if name not in _HOMES:
        raise AttributeError(f"module 'sgim' has no attribute {name!r}")
    home = import_module(_HOMES[name])
    value = getattr(home, "open_repertoire" if name == "open" else name)
    globals()[name] = value
    return value


def __dir__() -> list[str]:
    return sorted([*__all__, *_PACKAGES, "__version__"])
