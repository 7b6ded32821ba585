import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from hypothesis.extra.numpy import arrays

from sgim.memory.neighbours import NearestNeighbours

# Few values, so that points repeat and distances tie, and values that make rounding show.
COORDINATES = st.one_of(
    st.sampled_from([0.0, -0.0, 1.0, 2.0, 3.0, -1.0]),
    st.sampled_from([0.1, 0.2, 0.30000000000000004, 0.3, 1.0000000000000002, 1.5e-8]),
    st.sampled_from([5e-324, 1e-162, 3e-162, -1e-160, 1e150, -1e150]),
    st.floats(-10, 10),
)
DIMENSIONS = st.integers(1, 5)


def point_of(dimension):
    return arrays(np.float64, (dimension,), elements=COORDINATES)


def points_of(dimension, least=0, most=40):
    count = st.integers(least, most)
    return count.flatmap(lambda n: arrays(np.float64, (n, dimension), elements=COORDINATES))


def all_by_distance(points, point):
    """Every point's distance and index, sorted by (distance, index), the plain way."""
    total = np.zeros(len(points))
    for column, coordinate in zip(points.T, point, strict=True):
        total = total + (column - coordinate) * (column - coordinate)
    distances = np.sqrt(total)
    order = np.lexsort((np.arange(len(points)), distances))
    return distances[order], order


def assert_same(found, expected):
    for one, other in zip(found, expected, strict=True):
        assert one.dtype == other.dtype
        assert one.shape == other.shape
        assert one.tobytes() == other.tobytes()


def assert_equals_brute_force(neighbours, points, point, k):
    distances, indices = all_by_distance(points, point)
    assert_same(neighbours.query(point, k), (distances[:k], indices[:k]))


def structure_with(points, **options):
    neighbours = NearestNeighbours(points.shape[1], **options)
    neighbours.extend(points)
    return neighbours


@given(st.data())
def test_any_mix_of_adding_and_asking_equals_brute_force(data):
    dimension = data.draw(DIMENSIONS)
    neighbours = NearestNeighbours(dimension, buffer_size=data.draw(st.integers(1, 8)))
    points = np.empty((0, dimension))
    for _ in range(data.draw(st.integers(1, 8))):
        if data.draw(st.booleans()):
            new = data.draw(points_of(dimension))
            neighbours.extend(new)
        else:
            new = data.draw(points_of(dimension, most=12))
            for point in new:
                neighbours.add(point)
        points = np.concatenate((points, new))
        assert len(neighbours) == len(points)
        assert neighbours.points.tobytes() == points.tobytes()
        point = data.draw(point_of(dimension))
        assert_equals_brute_force(neighbours, points, point, data.draw(st.integers(1, 60)))


@given(st.data())
def test_a_batch_equals_single_queries_to_the_last_bit(data):
    dimension = data.draw(DIMENSIONS)
    points = data.draw(points_of(dimension))
    neighbours = structure_with(points, buffer_size=data.draw(st.integers(1, 20)))
    queries, k = data.draw(points_of(dimension, most=5)), data.draw(st.integers(1, 50))
    if len(queries) and data.draw(st.booleans()):  # many are looked for together
        queries = np.resize(queries, (7, dimension))
    distances, indices = neighbours.query_batch(queries, k)
    assert distances.shape == indices.shape == (len(queries), min(k, len(points)))
    for i, query in enumerate(queries):
        assert_same((distances[i], indices[i]), neighbours.query(query, k))


@given(st.data())
def test_within_finds_exactly_the_points_at_most_the_radius_away(data):
    dimension = data.draw(DIMENSIONS)
    points, point = data.draw(points_of(dimension)), data.draw(point_of(dimension))
    neighbours = structure_with(points, buffer_size=data.draw(st.integers(1, 20)))
    distances, indices = all_by_distance(points, point)
    chosen = st.sampled_from([0.0, 1.0, 1e-161, 1e200, np.inf, *distances])
    radius = data.draw(chosen)
    inside = distances <= radius
    assert_same(neighbours.within(point, radius), (distances[inside], indices[inside]))


@given(st.data())
def test_the_way_points_were_added_changes_no_answer(data):
    dimension = data.draw(DIMENSIONS)
    points, point = data.draw(points_of(dimension, least=1)), data.draw(point_of(dimension))
    together = structure_with(points, buffer_size=data.draw(st.integers(1, 8)))
    one_by_one = NearestNeighbours(dimension, buffer_size=data.draw(st.integers(1, 8)))
    for row in points:
        one_by_one.add(row)
    k = data.draw(st.integers(1, 50))
    assert_same(together.query(point, k), one_by_one.query(point, k))


@settings(max_examples=20, deadline=None)
@given(st.integers(0, 2**32 - 1), st.integers(1, 64), DIMENSIONS)
def test_hundreds_of_points_on_a_grid_equal_brute_force(seed, buffer_size, dimension):
    rng = np.random.default_rng(seed)
    points = rng.integers(0, 7, (600, dimension)) / 4
    neighbours = NearestNeighbours(dimension, buffer_size=buffer_size)
    for count, point in enumerate(points, start=1):
        neighbours.add(point)
        if count % 50 == 0:
            query = rng.integers(0, 14, dimension) / 8
            k = int(rng.integers(1, 40))
            assert_equals_brute_force(neighbours, points[:count], query, k)


@pytest.mark.parametrize("dimension", [1, 2, 14])
@pytest.mark.parametrize("decimals", [1, 12])
def test_the_default_layout_equals_brute_force_beyond_its_buffer(dimension, decimals):
    rng = np.random.default_rng(1)
    points = rng.random((40_000, dimension)).round(decimals)
    neighbours = structure_with(points[:30_000])
    for point in points[30_000:]:
        neighbours.add(point)
    for query in rng.random((5, dimension)).round(decimals):
        for k in (1, 8, 20, 500):
            assert_equals_brute_force(neighbours, points, query, k)


@pytest.mark.parametrize("dimension", [1, 2])
def test_the_newest_are_found_by_many_who_ask_for_one_each(dimension):
    rng = np.random.default_rng(2)
    neighbours, points = NearestNeighbours(dimension), np.empty((0, dimension))
    for added in (100, 400, 30, 300, 9000, 30, 2000, 100):
        points = np.concatenate((points, rng.random((added, dimension)).round(2)))
        neighbours.extend(points[-added:])
        queries = np.concatenate((points[-4:], rng.random((20, dimension))))
        expected = [all_by_distance(points, query) for query in queries]
        nearest = np.array([distances[:1] for distances, _ in expected])
        rows = np.array([order[:1] for _, order in expected])
        assert_same((neighbours.gaps(queries),), (nearest[:, 0],))
        assert_same(neighbours.query_batch(queries, 1), (nearest, rows))


@pytest.mark.parametrize("buffer_size", [1, 100, 200_000])
def test_very_many_identical_points_are_found_in_order_of_insertion(buffer_size):
    points = np.full((100_000, 2), 0.25)
    points[50_000] = [0.25, 0.75]
    neighbours = structure_with(points, buffer_size=buffer_size)
    for query in ([0.25, 0.25], [0.0, 1.0], [0.25, 0.5]):
        for k in (1, 20, 60_000, 100_000):
            assert_equals_brute_force(neighbours, points, np.array(query), k)


@pytest.mark.parametrize("buffer_size", [1, 16, 1000])
def test_many_points_at_one_distance_are_found_in_order_of_insertion(buffer_size):
    corners = np.array(np.meshgrid(*[[-1.0, 1.0]] * 8)).reshape(8, -1).T
    neighbours = structure_with(corners, buffer_size=buffer_size)
    for k in (1, 3, 100, 256):
        distances, indices = neighbours.query(np.zeros(8), k)
        assert distances.tolist() == [np.sqrt(8.0)] * k
        assert indices.tolist() == list(range(k))


@pytest.mark.parametrize("buffer_size", [1, 2, 10])
def test_distances_that_round_to_the_same_are_ordered_by_index(buffer_size):
    # The squared distances of these two differ in the last bit, their roots do not.
    points = np.array([[1.0, 1.5e-8], [1.0, 0.0], [9.0, 9.0]])
    neighbours = structure_with(points, buffer_size=buffer_size)
    distances, indices = neighbours.query([0.0, 0.0], 1)
    assert distances.tolist() == [1.0]
    assert indices.tolist() == [0]


def test_a_distance_is_the_same_whether_its_point_is_new_or_old():
    rng = np.random.default_rng(2)
    point, query = rng.random(14), rng.random(14)
    neighbours = NearestNeighbours(14, buffer_size=4)
    seen = set()
    neighbours.add(point)
    for far in 100 + rng.random((40, 14)):
        seen.add(float(neighbours.query(query, 1)[0][0]))
        neighbours.add(far)
    assert len(seen) == 1


def test_zeros_of_both_signs_are_equal_coordinates():
    points = np.array([[-0.0, 1.0], [0.0, 1.0], [0.0, 1.0], [-0.0, 1.0], [-0.0, 1.0]])
    neighbours = structure_with(points, buffer_size=1)
    for k in range(1, 6):
        assert neighbours.query([0.0, 0.0], k)[1].tolist() == list(range(k))


def test_an_empty_structure_answers_with_empty_arrays():
    neighbours = NearestNeighbours(3)
    nothing = (np.empty(0), np.empty(0, dtype=np.intp))
    assert len(neighbours) == 0
    assert neighbours.points.shape == (0, 3)
    assert_same(neighbours.query([0, 0, 0], 5), nothing)
    assert_same(neighbours.within([0, 0, 0], 5), nothing)
    assert [part.shape for part in neighbours.query_batch(np.zeros((2, 3)), 5)] == [(2, 0)] * 2


@pytest.mark.parametrize("buffer_size", [1, 100])
def test_fewer_points_than_asked_for_are_all_returned(buffer_size):
    neighbours = structure_with(np.array([[1.0], [0.0], [1.0]]), buffer_size=buffer_size)
    distances, indices = neighbours.query([0.0], 10)
    assert distances.tolist() == [0.0, 1.0, 1.0]
    assert indices.tolist() == [1, 0, 2]
    assert [part.shape for part in neighbours.query_batch(np.empty((0, 1)), 2)] == [(0, 2)] * 2


def test_points_cannot_be_written_through_the_view_or_the_arguments():
    given_points = np.array([[1.0, 2.0], [3.0, 4.0]])
    neighbours = structure_with(given_points, buffer_size=1)
    given_points[:] = 0
    view = neighbours.points
    with pytest.raises(ValueError, match="read-only"):
        view[0, 0] = 5
    neighbours.extend(np.zeros((500, 2)))
    assert view.tolist() == neighbours.points[:2].tolist() == [[1.0, 2.0], [3.0, 4.0]]


def test_writing_into_an_answer_changes_no_later_answer():
    neighbours = structure_with(np.arange(10.0)[:, None], buffer_size=4)
    before = neighbours.query([3.2], 5)
    expected = tuple(part.copy() for part in before)
    for part in before:
        part[:] = 7
    assert_same(neighbours.query([3.2], 5), expected)


@pytest.mark.parametrize("method", ["add", "query", "within"])
def test_a_point_of_wrong_shape_is_refused_saying_what_was_expected(method):
    neighbours = structure_with(np.zeros((3, 2)))
    rest = {"add": [], "query": [1], "within": [1.0]}[method]
    message = r"point has shape \(3,\), expected \(2,\)"
    with pytest.raises(ValueError, match=message):
        getattr(neighbours, method)([1.0, 2.0, 3.0], *rest)
    with pytest.raises(ValueError, match=r"point has shape \(\), expected \(2,\)"):
        getattr(neighbours, method)(1.0, *rest)
    assert len(neighbours) == 3


@pytest.mark.parametrize("method", ["extend", "query_batch"])
def test_points_of_wrong_shape_are_refused_saying_what_was_expected(method):
    neighbours = structure_with(np.zeros((3, 2)))
    rest = {"extend": [], "query_batch": [1]}[method]
    with pytest.raises(ValueError, match=r"points have shape \(2,\), expected \(n, 2\)"):
        getattr(neighbours, method)([1.0, 2.0], *rest)
    with pytest.raises(ValueError, match=r"points have shape \(4, 3\), expected \(n, 2\)"):
        getattr(neighbours, method)(np.zeros((4, 3)), *rest)
    assert len(neighbours) == 3


@pytest.mark.parametrize("bad", [np.nan, np.inf, -np.inf, 1e151, -1e300])
def test_coordinates_not_finite_or_too_large_are_refused_and_nothing_is_added(bad):
    neighbours = structure_with(np.zeros((3, 2)))
    for call in (
        lambda: neighbours.add([0.0, bad]),
        lambda: neighbours.extend([[0.0, 1.0], [bad, 0.0]]),
        lambda: neighbours.query([bad, bad], 1),
        lambda: neighbours.query_batch([[0.0, bad]], 1),
        lambda: neighbours.within([bad, 0.0], 1.0),
    ):
        with pytest.raises(ValueError, match="expected finite, at most 1e"):
            call()
    assert neighbours.points.tolist() == [[0.0, 0.0]] * 3


def test_the_largest_coordinates_are_accepted_one_by_one_and_together():
    neighbours = NearestNeighbours(2, buffer_size=1)
    neighbours.add([1e150, 1e150])
    neighbours.extend([[-1e150, -1e150]])
    distances, indices = neighbours.query([1e150, 1e150], 2)
    assert distances.tolist() == [0.0, np.hypot(2e150, 2e150)]
    assert indices.tolist() == [0, 1]


@pytest.mark.parametrize("k", [0, -3])
def test_asking_for_fewer_than_one_neighbour_is_refused(k):
    neighbours = structure_with(np.zeros((3, 2)))
    for call in (
        lambda: neighbours.query([0.0, 0.0], k),
        lambda: neighbours.query_batch([[0.0, 0.0]], k),
    ):
        with pytest.raises(ValueError, match=f"k is {k}, expected at least 1"):
            call()


@pytest.mark.parametrize("radius", [-1.0, np.nan])
def test_a_radius_below_zero_or_not_a_number_is_refused(radius):
    neighbours = structure_with(np.zeros((3, 2)))
    with pytest.raises(ValueError, match=r"radius is .*, expected at least 0"):
        neighbours.within([0.0, 0.0], radius)


def test_a_dimension_or_buffer_size_below_one_is_refused():
    with pytest.raises(ValueError, match="dimension is 0, expected at least 1"):
        NearestNeighbours(0)
    with pytest.raises(ValueError, match="buffer_size is 0, expected at least 1"):
        NearestNeighbours(2, buffer_size=0)


@pytest.mark.parametrize("dimension", [1, 2, 3])
def test_many_points_asked_at_once_get_the_answers_of_one_by_one(dimension):
    rng = np.random.default_rng(dimension)
    found = NearestNeighbours(dimension, buffer_size=50)
    # A coarse grid, so that there are equal points and ties.
    found.extend(np.round(rng.random((230, dimension)), 1))
    wanted = np.round(rng.random((300, dimension)), 2)
    distances, indices = found.query_batch(wanted, 1)
    for i, point in enumerate(wanted):
        one = found.query(point, 1)
        assert (distances[i] == one[0]).all()
        assert (indices[i] == one[1]).all()


@pytest.mark.parametrize("buffer_size", [4, 1000])
def test_gaps_are_the_distances_to_the_nearest(buffer_size: int) -> None:
    rng = np.random.default_rng(0)
    neighbours = NearestNeighbours(3, buffer_size=buffer_size)
    asked = rng.random((20, 3))
    assert np.isinf(neighbours.gaps(asked)).all()
    for _ in range(8):
        neighbours.extend(rng.random((9, 3)))
        expected = neighbours.query_batch(asked, 1)[0][:, 0]
        np.testing.assert_allclose(neighbours.gaps(asked), expected, rtol=1e-12)
    assert neighbours.gaps(neighbours.points[:3]) == pytest.approx(0.0, abs=1e-15)
