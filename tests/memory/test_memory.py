import copy
from typing import Any

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from hypothesis.extra.numpy import arrays

from sgim.memory import Memory
from sgim.records import Trial
from sgim.spaces import Box, Choices
from sgim.task import Task

THROW = Box([-10, 0], [10, 5], unit="m")
TASK = Task(
    Box(-1, 1, names=["a", "b", "c"]),
    {"throw": THROW, "place": Box(0, 1)},
    context_space=Box(0, 4, names=["wind"]),
)


class Pictures:
    """Small pictures, which nobody here can compare."""

    dimension = None

    def check(self, value: Any, what: str = "value") -> Any:
        return np.array(value, dtype=np.uint8)

    def contains(self, point: Any) -> bool:
        return True

    def sample(self, rng: np.random.Generator) -> Any:
        return rng.integers(256, size=(2, 3), dtype=np.uint8)

    def encode(self, point: Any) -> Any:
        raise AssertionError("a picture must not be encoded")

    def pack(self, point: Any) -> bytes:
        return bytes(point.tobytes())

    def unpack(self, data: bytes) -> Any:
        return np.frombuffer(data, dtype=np.uint8).reshape(2, 3)

    def describe(self) -> dict[str, Any]:
        return {"space": "pictures"}


def vectors(dimension: int) -> st.SearchStrategy[np.ndarray]:
    # Few values, so that outcomes and contexts repeat and distances tie.
    elements = st.sampled_from([-2.0, -0.0, 0.0, 0.3, 0.5, 0.7, 1.0, 4.0, 12.0])
    return arrays(np.float64, dimension, elements=elements)


@st.composite
def trials(draw: st.DrawFn) -> Trial:
    outcome = {}
    if draw(st.booleans()):
        outcome["throw"] = draw(vectors(2))
    if draw(st.booleans()):
        outcome["place"] = draw(vectors(1))
    return Trial(draw(vectors(3)), outcome, draw(vectors(1)))


def filled(given_trials: list[Trial], task: Task = TASK) -> Memory:
    memory = Memory(task)
    for number, trial in enumerate(given_trials):
        assert memory.add(trial) == number
    return memory


def same_bits(one: np.ndarray, other: np.ndarray) -> bool:
    return (
        one.dtype == other.dtype and one.shape == other.shape and one.tobytes() == other.tobytes()
    )


@given(st.lists(trials(), max_size=30))
def test_every_trial_comes_back_exactly(given_trials: list[Trial]) -> None:
    memory = filled(given_trials)
    assert len(memory) == len(given_trials)
    for number, trial in enumerate(given_trials):
        restored = memory.trial(number)
        assert same_bits(restored.policy, trial.policy)
        assert same_bits(restored.context, trial.context)
        assert restored.outcome.keys() == trial.outcome.keys()
        for kind, point in trial.outcome.items():
            assert same_bits(restored.outcome[kind], point)


@given(st.lists(trials(), min_size=1, max_size=30), vectors(2), vectors(1), st.integers(1, 35))
def test_nearest_are_those_nearest_in_scaled_outcome_and_scaled_context(
    given_trials: list[Trial], goal: np.ndarray, wind: np.ndarray, k: int
) -> None:
    throws = [(i, t) for i, t in enumerate(given_trials) if "throw" in t.outcome]
    assert TASK.context_space is not None
    expected = []
    for row, (number, trial) in enumerate(throws):
        apart = THROW.encode(trial.outcome["throw"]) - THROW.encode(goal)
        blown = TASK.context_space.encode(trial.context) - TASK.context_space.encode(wind)
        distance = np.sqrt(apart[0] ** 2 + apart[1] ** 2 + blown[0] ** 2)
        expected.append((distance, row, number))
    expected.sort()
    memory = filled(given_trials)
    kind = memory.kinds["throw"]
    if not throws:
        assert len(kind) == 0
    distances, rows = kind.nearest(memory.key("throw", goal, wind), k)
    assert rows.tolist() == [row for _, row, _ in expected[:k]]
    np.testing.assert_allclose(distances, [d for d, _, _ in expected[:k]], rtol=1e-14)
    assert kind.trials.rows[rows].tolist() == [number for _, _, number in expected[:k]]


def random_trial(number: int) -> Trial:
    rng = np.random.default_rng(number)
    both = {"throw": THROW.sample(rng), "place": rng.random(1)}
    outcome = {kind: both[kind] for kind in [("throw",), ("place",), both][number % 3]}
    return Trial(TASK.policy_space.sample(rng), outcome, 4 * rng.random(1))


def test_a_batch_of_keys_gets_what_each_alone_gets() -> None:
    memory = filled([random_trial(i) for i in range(300)])
    kind = memory.kinds["throw"]
    keys = np.random.default_rng(0).random((20, 3))
    distances, rows = kind.nearest_batch(keys, 5)
    for key, its_distances, its_rows in zip(keys, distances, rows, strict=True):
        alone_distances, alone_rows = kind.nearest(key, 5)
        assert same_bits(alone_distances, its_distances)
        assert alone_rows.tolist() == its_rows.tolist()


def test_trials_added_between_questions_are_found() -> None:
    memory = Memory(TASK)
    kind = memory.kinds["place"]
    for number in range(200):
        memory.add(Trial(np.zeros(3), {"place": np.array([number / 200])}, np.zeros(1)))
        distances, rows = kind.nearest(
            memory.key("place", np.array([number / 200]), np.zeros(1)), 1
        )
        assert (distances[0], rows[0]) == (0.0, number)


def test_neighbours_in_policy_space_are_those_that_produced_the_kind() -> None:
    given_trials = [random_trial(i) for i in range(120)]
    memory = filled(given_trials)
    kind = memory.kinds["place"]
    policy = np.array([0.2, 0.9, 0.5])
    with_kind = [t for t in given_trials if "place" in t.outcome]
    gaps = [np.linalg.norm(TASK.policy_space.encode(t.policy) - policy) for t in with_kind]
    distances, rows = kind.nearest_policies(policy, 7)
    assert rows.tolist() == np.argsort(gaps)[:7].tolist()
    np.testing.assert_allclose(distances, np.sort(gaps)[:7])
    expected = [TASK.policy_space.encode(with_kind[row].policy) for row in rows]
    assert same_bits(kind.encoded_policies(rows), np.array(expected))


def test_changing_what_was_given_or_returned_changes_no_memory() -> None:
    trial = Trial(np.zeros(3), {"place": np.zeros(1)}, np.zeros(1))
    memory = filled([trial])
    for one in (trial, memory.trial(0)):
        for array in (one.policy, one.outcome["place"], one.context):
            array += 1.0
    restored = memory.trial(0)
    assert not restored.policy.any()
    assert not restored.outcome["place"].any()
    assert not restored.context.any()


def test_opaque_outcomes_are_remembered_beside_those_that_have_neighbours() -> None:
    pictures = Pictures()
    task = Task(Choices(["near", "far"]), {"picture": pictures, "size": Box(0, 1)})
    rng = np.random.default_rng(0)
    given_trials = [
        Trial(["near", "far"][i % 2], {"picture": pictures.sample(rng), "size": rng.random(1)})
        for i in range(100)
    ]
    memory = filled(given_trials, task)
    for number, trial in enumerate(given_trials):
        restored = memory.trial(number)
        assert restored.policy == trial.policy
        assert restored.context is None
        assert same_bits(restored.outcome["picture"], trial.outcome["picture"])
    kind = memory.kinds["size"]
    size = given_trials[42].outcome["size"]
    assert kind.nearest(memory.key("size", size, None), 1)[1].tolist() == [42]
    np.testing.assert_allclose(
        kind.nearest_policies(task.policy_space.encode("far"), 3)[0], np.zeros(3)
    )


def test_labels_as_outcomes_have_neighbours() -> None:
    task = Task(Box(0, 1), {"word": Choices(["ba", "da"])})
    memory = filled(
        [Trial(np.array([i / 4]), {"word": w}) for i, w in enumerate(["da", "ba"])], task
    )
    distances, rows = memory.kinds["word"].nearest(memory.key("word", "ba", None), 2)
    assert rows.tolist() == [1, 0]
    assert distances.tolist() == pytest.approx([0.0, 1.0])


def test_a_copy_of_a_memory_grows_by_itself() -> None:
    memory = Memory(Task(Choices(["ba", "da"]), {"word": Choices(["ba", "da"])}))
    memory.add(Trial("ba", {"word": "da"}))
    again = copy.deepcopy(memory)
    again.add(Trial("da", {"word": "ba"}))
    memory.add(Trial("ba", {"word": "ba"}))
    assert [memory.trial(number).policy for number in range(2)] == ["ba", "ba"]
    assert [again.trial(number).policy for number in range(2)] == ["ba", "da"]


@pytest.mark.parametrize("dimension", [1, 2, 4])
def test_places_amid_rows_are_surrounded_and_those_beyond_are_not(dimension: int) -> None:
    space = Box(np.zeros(dimension), np.ones(dimension))
    memory = Memory(Task(Box(0, 1), {"place": space}))
    rng = np.random.default_rng(0)
    low, high = 0.3, 0.7
    for place in rng.uniform(low, high, (600, dimension)):
        memory.add(Trial(np.zeros(1), {"place": place}))
    kind = memory.kinds["place"]
    amid = rng.uniform(low, high, (500, dimension))
    assert kind.surrounded(amid).mean() > 0.93  # some are at the border
    assert [bool(kind.surrounded(place[None])[0]) for place in amid] == kind.surrounded(
        amid
    ).tolist()
    beyond = amid.copy()
    beyond[:, 0] += 0.8
    assert not kind.surrounded(beyond).any()


def test_nothing_is_surrounded_by_few_rows() -> None:
    memory = filled([random_trial(i) for i in range(8)])
    kind = memory.kinds["throw"]
    assert len(kind) <= 8
    assert kind.surrounded(kind.keys.rows).tolist() == [False] * len(kind)
