"""The simplex search against the thesis's algorithm, SciPy's, and a trace reckoned by hand."""

from collections.abc import Callable, Iterator

import numpy as np
import pytest
from scipy.optimize import minimize

from sgim.policy.nelder_mead import nelder_mead

Function = Callable[[np.ndarray], float]
Step = tuple[str, list[np.ndarray]]
START = np.array([[0.9, 0.1], [1.0, 0.4], [0.7, 0.3]])


def bowl(x: np.ndarray) -> float:
    return float((x[0] - 0.2) ** 2 + 3 * (x[1] - 0.6) ** 2)


def valley(x: np.ndarray) -> float:
    return float(100 * (x[1] - x[0] ** 2) ** 2 + (1 - x[0]) ** 2)


def ripples(x: np.ndarray) -> float:
    return bowl(x) + 0.2 * float(np.sin(23 * x[0]) * np.sin(31 * x[1]))


def evaluated(function: Function, points: np.ndarray, count: int) -> list[np.ndarray]:
    """The first points that the search evaluates."""
    search = nelder_mead(list(points), [None] * len(points))
    asked = [next(search)]
    while len(asked) < count:
        asked.append(search.send(function(asked[-1])))
    return asked


def reference(function: Function, points: np.ndarray) -> Iterator[Step]:
    """Algorithm 3.2.3, written down as it is printed, one iteration at a time."""
    x = sorted(points, key=function)
    while True:
        n = len(x) - 1
        m = sum(x[:n]) / n
        r = 2 * m - x[n]
        if function(x[0]) <= function(r) < function(x[n - 1]):
            name, tried, kept = "reflect", [r], [*x[:n], r]
        elif function(r) < function(x[0]):
            s = m + 2 * (m - x[n])
            better = function(s) < function(r)
            name, tried = "expand" if better else "reflect after all", [r, s]
            kept = [*x[:n], s if better else r]
        else:
            outside = function(r) < function(x[n])
            towards = r if outside else x[n]
            c = m + (towards - m) / 2
            name, tried = "contract outside" if outside else "contract inside", [r, c]
            kept = [*x[:n], c]
            if not function(c) < function(towards):
                shrunk = [x[0] + (v - x[0]) / 2 for v in x[1:]]
                name, tried, kept = "shrink", [*tried, *shrunk], [x[0], *shrunk]
        x = sorted(kept, key=function)
        yield name, tried


def test_a_search_on_a_bowl_goes_as_reckoned_by_hand() -> None:
    def function(x: np.ndarray) -> float:
        return float(x @ x)

    asked = evaluated(function, np.array([[1.0, 1], [2, 1], [1, 2]]), 11)
    assert [point.tolist() for point in asked] == [
        [1, 1],  # The three vertices cost 2, 5 and 5.
        [2, 1],
        [1, 2],
        [2, 0],  # 4: reflected, in place of (1, 2).
        [1, 0],  # 1, better than the best,
        [0.5, -0.5],  # so further: 1/2, expanded.
        [-0.5, 0.5],  # 1/2: reflected.
        [-1, -1],  # 2, no better than the worst,
        [0.5, 0.5],  # so contracted inside: 1/2. All three cost 1/2 now.
        [-0.5, -0.5],  # 1/2 once more,
        [0.25, 0.25],  # so contracted inside.
    ]


@pytest.mark.parametrize("function", [bowl, valley, ripples])
def test_every_step_is_that_of_the_printed_algorithm(function: Function) -> None:
    expected = [*START]
    for _, tried in reference(function, START):
        expected += tried
        if len(expected) > 80:
            break
    asked = evaluated(function, START, len(expected))
    np.testing.assert_allclose(asked, expected, rtol=0, atol=1e-12)


def test_the_compared_searches_make_every_kind_of_step() -> None:
    seen = set()
    for function in (bowl, valley, ripples):
        steps = reference(function, START)
        seen |= {next(steps)[0] for _ in range(40)}
    assert seen == {
        "reflect",
        "expand",
        "reflect after all",
        "contract outside",
        "contract inside",
        "shrink",
    }


@pytest.mark.parametrize("function", [bowl, valley])
def test_a_search_evaluates_the_points_that_scipy_evaluates(function: Function) -> None:
    theirs: list[np.ndarray] = []

    def noted(x: np.ndarray) -> float:
        theirs.append(x.copy())
        return function(x)

    options = {"initial_simplex": START, "maxfev": 70, "xatol": 0, "fatol": 0}
    minimize(noted, START[0], method="Nelder-Mead", options=options)
    np.testing.assert_allclose(evaluated(function, START, 70), theirs, rtol=0, atol=1e-9)


@pytest.mark.parametrize(("function", "best"), [(bowl, [0.2, 0.6]), (valley, [1.0, 1.0])])
def test_a_search_converges_to_the_minimum(function: Function, best: list[float]) -> None:
    asked = evaluated(function, START, 200)
    np.testing.assert_allclose(asked[-1], best, atol=1e-6)


def test_a_search_in_many_dimensions_keeps_improving() -> None:
    centre = np.linspace(0.2, 0.8, 8)

    def function(x: np.ndarray) -> float:
        return float(((x - centre) ** 2).sum())

    start = np.full((9, 8), 0.5) + 0.1 * np.eye(9, 8)
    costs = [function(x) for x in evaluated(function, start, 600)]
    assert min(costs) < 1e-4 * costs[0]


def test_vertices_whose_cost_is_known_are_not_evaluated() -> None:
    costs = [bowl(x) for x in START]
    search = nelder_mead(list(START), costs)
    _, (reflected, *_) = next(reference(bowl, START))
    np.testing.assert_allclose(next(search), reflected, atol=1e-15)


def test_vertices_whose_cost_is_unknown_are_evaluated_first_in_order() -> None:
    search = nelder_mead(list(START), [None, bowl(START[1]), None])
    assert next(search).tolist() == START[0].tolist()
    assert search.send(bowl(START[0])).tolist() == START[2].tolist()
    _, (reflected, *_) = next(reference(bowl, START))
    np.testing.assert_allclose(search.send(bowl(START[2])), reflected, atol=1e-15)


def test_equal_costs_everywhere_do_not_stop_the_search() -> None:
    asked = evaluated(lambda x: 1.0, START, 50)
    assert len({tuple(x) for x in asked}) > 20
