import numpy as np
import pytest

from sgim.streams import Streams


def numbers(seed: int, name: str, index: int = 0) -> list[float]:
    return Streams(seed)(name, index).random(4).tolist()


def test_a_stream_is_a_function_of_seed_name_and_index() -> None:
    assert numbers(3, "learner", 5) == numbers(3, "learner", 5)
    assert Streams(3)("learner").random() == Streams(np.int64(3))("learner", 0).random()


def test_opening_other_streams_shifts_nobodys_numbers() -> None:
    streams = Streams(3)
    streams("environment", 9).random(100)
    streams("learner", 5).random(100)
    assert streams("learner", 5).random(4).tolist() == numbers(3, "learner", 5)


def test_streams_differ_in_seed_name_and_index() -> None:
    drawn = [
        numbers(seed, name, index)
        for seed in (0, 1, 2**40)
        for name in ("learner", "teacher", "teacher/a", "")
        for index in (0, 1, 2**40)
    ]
    assert len({tuple(n) for n in drawn}) == 36


def test_streams_of_neighbouring_indices_are_not_correlated() -> None:
    first = np.array([Streams(0)("trial", i).random() for i in range(2000)])
    assert abs(np.corrcoef(first[:-1], first[1:])[0, 1]) < 0.08
    assert abs(first.mean() - 0.5) < 0.03


def test_the_numbers_of_a_stream_never_change_between_releases() -> None:
    assert Streams(7)("learner/choice", 12).integers(2**32, size=3).tolist() == GOLDEN


GOLDEN = [999239217, 3599706214, 3219659213]


@pytest.mark.parametrize("seed", [-1, 1.5, "7", None, True])
def test_a_seed_that_is_not_a_non_negative_integer_is_refused(seed: object) -> None:
    with pytest.raises(ValueError, match="expected a non-negative integer"):
        Streams(seed)  # type: ignore[arg-type]
