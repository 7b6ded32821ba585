import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from sgim.environments import ARMS, PlanarArm
from sgim.errors import SpaceError
from sgim.spaces import FloatArray


def postures(arm: PlanarArm, count: int, seed: int = 0) -> FloatArray:
    return np.random.default_rng(seed).uniform(-arm.limit, arm.limit, (count, arm.joints))


def generators(count: int) -> list[np.random.Generator]:
    return [np.random.default_rng(i) for i in range(count)]


@given(name=st.sampled_from(sorted(ARMS)), count=st.integers(1, 40), seed=st.integers(0, 2**32 - 1))
def test_a_batch_gives_bit_for_bit_what_single_postures_give(
    name: str, count: int, seed: int
) -> None:
    arm = ARMS[name]
    policies = postures(arm, count, seed)
    batch = arm.execute_batch(policies, None, generators(count))
    for policy, outcome, rng in zip(policies, batch, generators(count), strict=True):
        assert arm.execute(policy, None, rng)["hand"].tobytes() == outcome["hand"].tobytes()


def test_a_batch_with_contexts_gives_bit_for_bit_what_single_postures_give() -> None:
    arm = PlanarArm(7, vary_start=True)
    policies = postures(arm, 30)
    contexts = [arm.sample_context(rng) for rng in generators(30)]
    batch = arm.execute_batch(policies, contexts, generators(30))
    trials = zip(policies, contexts, generators(30), batch, strict=True)
    for policy, context, rng, outcome in trials:
        assert arm.execute(policy, context, rng)["hand"].tobytes() == outcome["hand"].tobytes()


def test_a_stretched_arm_reaches_one_metre_along_x() -> None:
    for arm in ARMS.values():
        hand = arm.without_noise().execute(np.zeros(arm.joints))["hand"]
        np.testing.assert_allclose(hand, [1.0, 0.0], atol=1e-12)


def test_angles_are_relative_to_the_link_before() -> None:
    arm = PlanarArm(2, limit=np.pi, noise=0)
    a, b = 0.7, -1.9
    expected = [(np.cos(a) + np.cos(a + b)) / 2, (np.sin(a) + np.sin(a + b)) / 2]
    np.testing.assert_allclose(arm.execute([a, b])["hand"], expected)


def test_links_fall_in_length_by_the_ratio_to_a_total_of_one_metre() -> None:
    lengths = PlanarArm(4, length_ratio=0.5).lengths
    np.testing.assert_allclose(lengths, np.array([8, 4, 2, 1]) / 15)


def test_noise_has_the_standard_deviation_asked_for_and_no_bias() -> None:
    arm = PlanarArm(7, noise=0.02)
    policy = postures(arm, 1)[0]
    count = 2000
    hands = arm.execute_batch([policy] * count, None, generators(count))
    noise = np.array([o["hand"] for o in hands]) - arm.without_noise().execute(policy)["hand"]
    np.testing.assert_allclose(noise.std(axis=0), 0.02, rtol=0.1)
    np.testing.assert_allclose(noise.mean(axis=0), 0.0, atol=0.002)


def test_an_arm_without_noise_is_deterministic_and_needs_no_generator() -> None:
    noisy = PlanarArm(3, length_ratio=0.7, limit=0.9, low=(-2, -3), high=(2, 3), vary_start=True)
    arm = noisy.without_noise()
    assert arm.deterministic
    assert not noisy.deterministic
    assert arm.task.describe() == noisy.task.describe()
    np.testing.assert_array_equal(arm.lengths, noisy.lengths)
    once, twice = (arm.execute(np.full(3, 0.3), np.array([0.1]))["hand"] for _ in range(2))
    np.testing.assert_array_equal(once, twice)


def test_the_base_turns_the_whole_arm() -> None:
    fixed, turning = PlanarArm(7, noise=0), PlanarArm(7, noise=0, vary_start=True)
    policy, turn = postures(fixed, 1)[0], 0.4
    x, y = fixed.execute(policy)["hand"]
    turned = [x * np.cos(turn) - y * np.sin(turn), x * np.sin(turn) + y * np.cos(turn)]
    np.testing.assert_allclose(turning.execute(policy, np.array([turn]))["hand"], turned)


def test_contexts_are_angles_of_the_base_where_it_varies() -> None:
    assert PlanarArm(2).sample_context(np.random.default_rng(0)) is None
    context = PlanarArm(2, vary_start=True).sample_context(np.random.default_rng(0))
    assert context.shape == (1,)
    assert abs(context[0]) <= 0.5


@pytest.mark.parametrize(
    ("arm", "policy", "context", "message"),
    [
        (PlanarArm(3, noise=0), np.zeros(2), None, r"expected \(n, 3\)"),
        (PlanarArm(3, noise=0), np.zeros(3), np.zeros(1), "no contexts"),
        (PlanarArm(3, noise=0, vary_start=True), np.zeros(3), None, "pass the angle of the base"),
        (PlanarArm(3, noise=0, vary_start=True), np.zeros(3), np.zeros(2), "contexts have shape"),
        (PlanarArm(3), np.zeros(3), None, "needs a generator"),
    ],
)
def test_what_cannot_be_executed_is_refused(
    arm: PlanarArm, policy: FloatArray, context: FloatArray | None, message: str
) -> None:
    with pytest.raises(SpaceError, match=message):
        arm.execute(policy, context)


def test_too_few_generators_are_refused() -> None:
    with pytest.raises(SpaceError, match="each of 2 trials, got 1"):
        PlanarArm(2).execute_batch(np.zeros((2, 2)), None, generators(1))


def test_an_empty_batch_gives_nothing() -> None:
    assert PlanarArm(2).execute_batch([]) == []


@pytest.mark.parametrize("wrong", [{"joints": 0}, {"length_ratio": 0.0}, {"noise": -1.0}])
def test_impossible_arms_are_refused(wrong: dict[str, float]) -> None:
    with pytest.raises(SpaceError, match=next(iter(wrong))):
        PlanarArm(**wrong)  # type: ignore[arg-type]
