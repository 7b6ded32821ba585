import numpy as np
import pytest
from hypothesis import assume, given
from hypothesis import strategies as st
from hypothesis.extra.numpy import arrays

from sgim.errors import SpaceError
from sgim.spaces import Box, Choices, Space, space_from_description

NUMBERS = st.floats(-1e6, 1e6)
SHARES = arrays(np.float64, 3, elements=st.floats(0, 1))


@st.composite
def boxes(draw: st.DrawFn, dimension: int = 3) -> Box:
    ends = [sorted(draw(st.tuples(NUMBERS, NUMBERS))) for _ in range(dimension)]
    assume(all(high - low > 1e-6 for low, high in ends))
    return Box([low for low, _ in ends], [high for _, high in ends])


@given(boxes(), SHARES)
def test_a_vector_of_the_unit_box_decodes_to_a_point_within_the_bounds(
    box: Box, vector: np.ndarray
) -> None:
    assert box.contains(box.decode(vector))


@given(boxes())
def test_corners_of_the_unit_box_decode_within_the_bounds(box: Box) -> None:
    assert box.contains(box.decode(np.ones(3)))
    assert (box.decode(np.zeros(3)) == box.low).all()
    np.testing.assert_allclose(box.decode(np.ones(3)), box.high, rtol=0, atol=1e-9)


def test_rounding_does_not_decode_past_a_bound() -> None:
    box = Box(-0.1, 0.2)
    assert box.low + box.range > box.high  # What makes this box a trap.
    assert box.contains(box.decode(np.ones(1)))


@given(boxes(), SHARES)
def test_a_point_within_the_bounds_encodes_into_the_unit_box(box: Box, vector: np.ndarray) -> None:
    for point in (box.decode(vector), box.low, box.high):
        encoded = box.encode(point)
        assert ((encoded >= 0) & (encoded <= 1)).all()


@given(boxes(), arrays(np.float64, 3, elements=st.floats(-3, 4)))
def test_encoding_undoes_decoding_also_outside_the_bounds(box: Box, vector: np.ndarray) -> None:
    scale = np.maximum(np.abs(box.low), np.abs(box.high)) / box.range
    gap = np.abs(box.encode(box.decode(vector)) - vector)
    assert (gap <= 1e-14 * (10 + 10 * scale)).all()


@given(boxes(), st.integers(0, 2**32))
def test_samples_lie_within_the_bounds(box: Box, seed: int) -> None:
    assert box.contains(box.sample(np.random.default_rng(seed)))


def test_samples_spread_uniformly() -> None:
    box, rng = Box([-2, 0], [2, 10]), np.random.default_rng(0)
    points = np.array([box.sample(rng) for _ in range(4000)])
    np.testing.assert_allclose(points.mean(axis=0), [0, 5], atol=0.15)
    np.testing.assert_allclose(points.std(axis=0), box.range / np.sqrt(12), atol=0.1)


def test_encode_and_decode_take_rows_of_points() -> None:
    box = Box([0, 10], [2, 20])
    rows = np.array([[[0.0, 20.0]], [[1.0, 10.0]]])
    assert box.encode(rows).tolist() == [[[0, 1]], [[0.5, 0]]]
    assert (box.decode(box.encode(rows)) == rows).all()


@given(arrays(np.float64, 3, elements=st.floats(-1e100, 1e100)))
def test_packing_keeps_every_bit(point: np.ndarray) -> None:
    box = Box(0, 1, names="abc")
    restored = box.unpack(box.pack(point))
    assert restored.tobytes() == point.tobytes()
    restored[0] = 1.0  # It may be written to.


def test_check_makes_a_vector_of_its_own() -> None:
    box, given_point = Box(0, 1, names="ab"), np.array([0.25, 0.5])
    checked = box.check(given_point)
    given_point[0] = 9.0
    assert checked.tolist() == [0.25, 0.5]
    assert box.check((1, 2)).dtype == np.float64


def test_several_are_checked_as_each_is_alone() -> None:
    box, given_points = Box(0, 1, names="ab"), np.array([[0.25, 0.5], [7.0, -1.0]])
    checked = box.check_all(given_points)
    given_points[:] = 9.0
    assert [point.tolist() for point in checked] == [[0.25, 0.5], [7.0, -1.0]]
    assert [p.tolist() for p in Box(0, 1).check_all([0.5, [1], (2,)])] == [[0.5], [1.0], [2.0]]
    assert box.check_all([]) == []


@pytest.mark.parametrize("bad", [[0.0], [0.0, np.nan], [0.0, -1e200], "ab", None, [[0.0, 1.0]]])
def test_one_that_is_malformed_among_several_is_refused_as_alone(bad: object) -> None:
    box = Box(0, 1, names="ab")
    with pytest.raises(SpaceError) as alone:
        box.check(bad, "goal")
    with pytest.raises(SpaceError) as among:
        box.check_all([[0.5, 0.5], bad], "goal")
    assert str(among.value) == str(alone.value)


@given(arrays(np.float64, (2, 3), elements=st.floats(-0.5, 1.5) | st.just(np.nan)))
def test_rows_are_contained_where_each_point_is(points: np.ndarray) -> None:
    box = Box(0, 1, names="abc")
    within = [bool(((point >= 0) & (point <= 1)).all()) for point in points]
    assert [box.contains(point) for point in points] == within
    assert box.contains(points) == all(within)


def test_check_lets_bounds_be_passed_and_contains_tells() -> None:
    box = Box(0, 1)
    assert box.check([7.0]).tolist() == [7.0]
    assert not box.contains(box.check([7.0]))
    assert box.contains(np.array([0.0]))
    assert box.contains(np.array([1.0]))
    assert box.clip(np.array([7.0])).tolist() == [1.0]


@pytest.mark.parametrize("bad", [np.nan, np.inf, -np.inf, 1e200, -1e300])
def test_a_coordinate_that_is_not_finite_or_absurdly_large_is_named(bad: float) -> None:
    box = Box([-1, -1], [1, 1], names=["distance", "height"])
    with pytest.raises(SpaceError, match=r"outcome 'throw' has .* at 'height'; .* must be finite"):
        box.check([0.0, bad], "outcome 'throw'")


def test_large_numbers_that_cancel_are_refused_as_well() -> None:
    with pytest.raises(SpaceError, match="at 'a'"):
        Box(0, 1, names="ab").check([1e200, -1e200])
    assert Box(0, 1, names="ab").check([1e100, -1e100]).tolist() == [1e100, -1e100]


def test_a_wrong_shape_is_refused_with_the_coordinates_and_their_units() -> None:
    box = Box([0, 0], [1, 1], names=["distance", "height"], unit="m")
    with pytest.raises(SpaceError, match=r"has shape \(3,\), expected \(2,\): \(distance m, heigh"):
        box.check([1, 2, 3], "outcome 'throw'")
    with pytest.raises(SpaceError, match="goal is str 'far', expected"):
        box.check("far", "goal")
    with pytest.raises(SpaceError, match=r"x0, x1, …, x9"):
        Box(np.zeros(10), 1).check([1])


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        (([0, 0], [1, 1, 1]), "shapes"),
        (([0, 0], 1, ["a", "b", "c"]), "for 3 names"),
        ((0, np.inf), "must be finite"),
        (([0, 1], [1, 1]), "coordinate 1 has low=1 and high=1"),
        (([0, 0], [1, 1], ["a"]), "2 coordinates but 1 names"),
        (([0, 0], [1, 1], None, ["m"]), "2 coordinates but 1 units"),
    ],
)
def test_an_ill_defined_box_is_refused(arguments: tuple, message: str) -> None:
    with pytest.raises(SpaceError, match=message):
        Box(*arguments)


def test_one_number_is_a_bound_for_all_coordinates() -> None:
    box = Box(-1, [1, 2], unit=["m", "s"])
    assert box.low.tolist() == [-1, -1]
    assert box.names == ("x0", "x1")
    assert box.units == ("m", "s")
    assert Box(-1, 1, names=["a", "b", "c"]).dimension == 3


def test_bounds_cannot_be_written_to() -> None:
    box = Box(0, 1)
    for bound in (box.low, box.high, box.range):
        with pytest.raises(ValueError, match="read-only"):
            bound[0] = 5


def test_different_labels_are_at_distance_one() -> None:
    choices = Choices(["red", "green", "blue"])
    encoded = [choices.encode(label) for label in choices.labels]
    for i, one in enumerate(encoded):
        for j, other in enumerate(encoded):
            assert np.linalg.norm(one - other) == pytest.approx(float(i != j))


def test_labels_are_checked_sampled_and_packed() -> None:
    choices = Choices(["grün", "blau"])
    assert choices.check("blau") == "blau"
    assert choices.unpack(choices.pack("grün")) == "grün"
    rng = np.random.default_rng(0)
    drawn = [choices.sample(rng) for _ in range(400)]
    assert 160 < drawn.count("blau") < 240


def test_an_unknown_label_is_refused_with_the_nearest_known() -> None:
    with pytest.raises(SpaceError, match=r"unknown label 'gren'\. Did you mean 'green'"):
        Choices(["red", "green"]).check("gren", "goal")
    with pytest.raises(SpaceError, match="unknown label 3"):
        Choices(["red", "green"]).check(3)


@pytest.mark.parametrize("labels", [[], ["a", "a"]])
def test_labels_must_exist_and_differ(labels: list[str]) -> None:
    with pytest.raises(SpaceError, match="different labels"):
        Choices(labels)


@pytest.mark.parametrize(
    "space",
    [Box([-0.1, 2], [0.2, 3], names=["a", "b"], unit=["m", "s"]), Choices(["x", "y"]), Box(0, 1)],
)
def test_a_space_is_made_again_from_its_description(space: Box | Choices) -> None:
    assert isinstance(space, Space)
    again = space_from_description(space.describe())
    assert type(again) is type(space)
    assert again.describe() == space.describe()
    assert repr(again) == repr(space)


def test_a_space_of_somebodys_own_cannot_be_made_from_its_description() -> None:
    with pytest.raises(SpaceError, match=r"described as 'pictures'.*pass the task"):
        space_from_description({"space": "pictures"})
