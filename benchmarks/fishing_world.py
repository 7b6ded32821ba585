"""Facts of the fishing world: where movements land, how they scatter, and how long it takes.

Run it as ``python benchmarks/fishing_world.py``; it takes some minutes.
"""

import time

import numpy as np

from sgim.environments import FishingFloor, FishingRod, fishing_demonstrations
from sgim.environments.fishing.movement import FISHING
from sgim.errors import SgimError
from sgim.records import Trajectory

MOVEMENTS = {True: 5000, False: 1500}
SCATTERED = 400
REPETITIONS = 10
SHOWN_AGAIN = 4


def landings(world: FishingRod, policies: np.ndarray, rng: np.random.Generator) -> np.ndarray:
    """Where each policy lands, shape (n, 2); NaN where it does not."""
    found = np.full((len(policies), 2), np.nan)
    for i, policy in enumerate(policies):
        try:
            found[i] = world.execute(policy, None, rng).get("float", np.nan)
        except SgimError:
            print("  one movement was unstable")
    return found


def model(fast: bool) -> np.ndarray:
    rng = np.random.default_rng(0)
    policies = rng.random((MOVEMENTS[True], 25))[: MOVEMENTS[fast]]
    world = FishingRod(0.0, fast=fast)
    begun = time.process_time()
    reached = landings(world, policies, rng)
    milliseconds = 1000 * (time.process_time() - begun) / len(policies)
    landed = reached[~np.isnan(reached[:, 0])]
    print(
        f"{'fast' if fast else 'full'} model: {milliseconds:.1f} ms a movement; the float hangs at "
        f"{np.round(world.rest, 3)}\n  {1 - len(landed) / len(reached):.1%} never land; median "
        f"{np.round(np.median(landed, axis=0), 3)}, sd {np.round(landed.std(axis=0), 3)}; "
        f"{(landed[:, 1] < 0).mean():.1%} at y < 0"
    )
    return reached


def scatter(noise: float) -> None:
    rng = np.random.default_rng(1)
    world = FishingRod(noise)
    deviations = []
    for policy in rng.random((SCATTERED, 25)):
        again = landings(world, np.repeat(policy[None], REPETITIONS, axis=0), rng)
        again = again[~np.isnan(again[:, 0])]
        if len(again) > REPETITIONS / 2:
            deviations.append(again.std(axis=0, ddof=1))
    spread = np.ravel(deviations)
    print(
        f"noise {noise}: standard deviations over {REPETITIONS} repetitions, each axis: median "
        f"{np.median(spread):.4f}, 90th percentile {np.quantile(spread, 0.9):.3f}, mean "
        f"{spread.mean():.3f} m"
    )


def floor() -> None:
    rng = np.random.default_rng(2)
    world = FishingFloor()
    begun = time.process_time()
    seen = [world.execute(policy, None, rng)["ball"][0] < 2 for policy in rng.random((400, 54))]
    milliseconds = 1000 * (time.process_time() - begun) / len(seen)
    print(f"floor: {milliseconds:.1f} ms a movement; {np.mean(seen):.1%} come to rest in view")


def demonstrations() -> None:
    """How far demonstrations land from where they did, repeated or as the robot copies them."""
    rng = np.random.default_rng(3)
    still, usual, full = FishingRod(0.0), FishingRod(), FishingRod(fast=False)
    for number in (1, 2, 3):
        shown = fishing_demonstrations(number)
        landed = [d.outcome["float"] for d in shown]
        moves: list[np.ndarray | Trajectory | None] = [d.trajectory or d.policy for d in shown]
        print(f"D{number}: {len(shown)} demonstrations, {sum(y < 0 for _, y in landed)} at y < 0")
        if number == 3:
            apart("led again", still, moves, landed, 1, rng)
            apart("led with noise", usual, moves, landed, SHOWN_AGAIN, rng)
            fits = [FISHING.fit(d.trajectory) for d in shown if d.trajectory is not None]
            residuals = np.degrees([residual for _, residual in fits])
            print(f"  residual: median {np.median(residuals):.2f}°, most {residuals.max():.2f}°")
            moves = [policy for policy, _ in fits]
        apart("without noise", still, moves, landed, 1, rng)
        apart("with noise", usual, moves, landed, SHOWN_AGAIN, rng)
        apart("in the full model, with noise", full, moves, landed, 1, rng)


def apart(
    what: str,
    world: FishingRod,
    moves: list[np.ndarray | Trajectory | None],
    landed: list[np.ndarray],
    repetitions: int,
    rng: np.random.Generator,
) -> None:
    """Print how far movements land from where they should; one that does not land counts 1 m."""
    misses = []
    for move, where in zip(moves, landed, strict=True):
        for _ in range(repetitions):
            led = isinstance(move, Trajectory)
            outcome = world.follow(move, rng) if led else world.execute(move, None, rng)
            misses.append(float(np.linalg.norm(outcome["float"] - where)) if outcome else 1.0)
    print(f"  {what}: median {np.median(misses):.3f}, mean {np.mean(misses):.3f} m")


demonstrations()
fast, full = model(True), model(False)
gaps = np.linalg.norm(fast[: len(full)] - full, axis=1)
print(
    f"fast and full model land apart: median {np.nanmedian(gaps):.4f}, 90th percentile "
    f"{np.nanquantile(gaps, 0.9):.3f} m; "
    f"{(np.isnan(fast[: len(full), 0]) != np.isnan(full[:, 0])).mean():.1%} land in one model only"
)
for factor in (0.4, 1.0):
    scatter(factor)
floor()
