"""Facts of the fishing world: where random movements land, how they scatter, and how long it takes.

Run it as ``python benchmarks/fishing_world.py``; it takes some minutes.
"""

import time

import numpy as np

from sgim.environments import FishingFloor, FishingRod
from sgim.errors import SgimError

MOVEMENTS = {True: 5000, False: 1500}
SCATTERED = 400
REPETITIONS = 10


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


fast, full = model(True), model(False)
apart = np.linalg.norm(fast[: len(full)] - full, axis=1)
print(
    f"fast and full model land apart: median {np.nanmedian(apart):.4f}, 90th percentile "
    f"{np.nanquantile(apart, 0.9):.3f} m; "
    f"{(np.isnan(fast[: len(full), 0]) != np.isnan(full[:, 0])).mean():.1%} land in one model only"
)
for factor in (0.4, 1.0):
    scatter(factor)
floor()
