"""Conformance suites: whether a user's own parts keep the promises that sgim builds on.

Each suite is a function that returns when every promise is kept, and otherwise raises an
`AssertionError` that says what was promised, what came, and what to do. Call them from a test::

    def test_my_world_keeps_its_promises() -> None:
        sgim.testing.check_environment(MyWorld())

============================  ===============================================================
suite                         for
============================  ===============================================================
`check_space`                 spaces of points that are neither vectors nor labels
`check_environment`           worlds
`check_teacher`               teachers
`check_interest_map`          interest maps, the middle level
`check_model`                 competence models and inverse models
`check_explorer`              explorers, the lower level
============================  ===============================================================
"""

from sgim.testing.environment import check_environment
from sgim.testing.explorer import check_explorer
from sgim.testing.interest_map import check_interest_map
from sgim.testing.model import check_model
from sgim.testing.space import check_space
from sgim.testing.teacher import check_teacher

__all__ = [
    "check_environment",
    "check_explorer",
    "check_interest_map",
    "check_model",
    "check_space",
    "check_teacher",
]
