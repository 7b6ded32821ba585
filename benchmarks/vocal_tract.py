"""How many vocalisations the vocal tract makes a second, and how its formants compare.

Run it as ``python benchmarks/vocal_tract.py``; it takes some seconds. The reference is a loop of
plain Python in the same process, so that ratios to it hold on other machines too. With
``pip install 'sgim[vocaltractlab]'``, formants are also compared with VocalTractLab's.
"""

import importlib.util
import time
from collections.abc import Callable

import numpy as np

from sgim.environments import VocalTract
from sgim.environments.vocal.anatomy import ADULT
from sgim.environments.vocal.formants import WALL_MASS, formants, ladder
from sgim.environments.vocal.geometry import Tube, contours, tube

BATCH = 400
REPETITIONS = 30


def seconds(work: Callable[[], object]) -> float:
    """Processor time of the fastest of some repetitions."""
    taken = []
    for _ in range(REPETITIONS):
        begun = time.process_time()
        work()
        taken.append(time.process_time() - begun)
    return min(taken)


def reference() -> float:
    """A million additions."""
    total = 0.0
    for i in range(1_000_000):
        total += i
    return total


def speed() -> None:
    rng = np.random.default_rng(0)
    policies = rng.uniform(-3, 3, (BATCH, 18))
    voiced = policies.copy()
    voiced[:, [7, 8, 16, 17]] = 1.0
    world, one = VocalTract(), VocalTract(noise=0.0)
    generators = [np.random.default_rng(i) for i in range(BATCH)]
    loop = seconds(reference)
    print(f"reference: a million additions in {1000 * loop:.1f} ms")
    for name, work, count in (
        ("random policies", lambda: one.sounds(policies), BATCH),
        ("all of them voiced", lambda: one.sounds(voiced), BATCH),
        ("as a world, voiced", lambda: world.execute_batch(voiced, None, generators), BATCH),
        ("one voiced policy", lambda: one.sounds(voiced[:1]), 1),
    ):
        taken = seconds(work)
        print(
            f"{name}: {1000 * taken:.2f} ms for {count}, {count / taken:.0f} vocalisations a "
            f"second, {taken / loop:.3f} of the reference"
        )


def accuracy() -> None:
    positions = np.random.default_rng(1).uniform(-3, 3, (7, 3000))
    shape = contours(ADULT, positions)
    tubes = tube(ADULT, positions, shape)
    chosen = np.flatnonzero(shape.opening > 0)[:1000]
    tubes = Tube(tubes.areas[:, chosen], tubes.lengths[:, chosen])
    off = np.abs(formants(tubes) - dense(tubes))
    print(
        f"bisection against a dense solver, {len(chosen)} open tracts: at most "
        f"{off[0].max():.2f} Hz (F1) and {off[1].max():.2f} Hz (F2)"
    )
    hard = dense(tubes, wall_mass=np.inf)
    lower = dense(tubes)[0] - hard[0]
    print(
        f"hard walls lower F1 by {np.quantile(lower, 0.1):.0f} to {np.quantile(lower, 0.9):.0f} Hz"
    )


def dense(
    tubes: Tube, wall_mass: float = WALL_MASS, compliance: np.ndarray | None = None
) -> np.ndarray:
    """The first two resonances by NumPy's eigenvalue solver, in Hz."""
    diagonal, beside = ladder(tubes, wall_mass)
    if compliance is not None:  # a cavity beside a section adds to its capacitance
        volume = tubes.areas * tubes.lengths
        share = volume / (volume + compliance[:, None])
        diagonal, beside = diagonal * share, beside * share[1:] * share[:-1]
    found = []
    for entries, squares in zip(diagonal.T, beside.T, strict=True):
        roots = np.sqrt(squares)
        matrix = np.diag(entries) + np.diag(roots, 1) + np.diag(roots, -1)
        found.append(np.sqrt(np.linalg.eigvalsh(matrix)[:2]) / (2 * np.pi))
    return np.array(found).T


def cross_check() -> None:
    import vocaltractlab_cython as vocaltractlab

    vowels = ("a", "e", "i", "o", "u", "E:", "I", "E", "O", "U", "Y", "9", "y", "2", "@", "6")
    ways = {
        "as it is": (WALL_MASS, 0.0),
        "hard walls": (np.inf, 0.0),
        "a side cavity of 2 cm³": (WALL_MASS, 2.0),
        "walls of 2.1 g/cm²": (2.1, 0.0),
        "both": (2.1, 2.0),
    }
    apart: dict[str, list[np.ndarray]] = {name: [] for name in ways}
    for vowel in vowels:
        state = vocaltractlab.get_shape(vowel, "tract")
        their = vocaltractlab.tract_state_to_tube_state(state)
        found = vocaltractlab.tract_state_to_transfer_function(state, n_spectrum_samples=8192)
        spectrum, frequencies = found["magnitude_spectrum"][:4096], np.arange(4096) * 44100 / 8192
        inner = spectrum[1:-1]
        peaks = frequencies[1:-1][(inner > spectrum[:-2]) & (inner >= spectrum[2:])][:2]
        tubes = Tube(their["tube_area"][:, None], their["tube_length"][:, None])
        depth = np.cumsum(tubes.lengths) - tubes.lengths[:, 0] / 2
        for name, (mass, cavity) in ways.items():
            beside = np.where(np.arange(len(depth)) == np.abs(depth - 3.0).argmin(), cavity, 0.0)
            apart[name].append(dense(tubes, mass, beside)[:, 0] / peaks - 1)
    for name, values in apart.items():
        middle, most = np.median(values, axis=0), np.abs(values).max(axis=0)
        print(
            f"VocalTractLab, {len(vowels)} vowels, {name}: median F1 {middle[0]:+.1%}, F2 "
            f"{middle[1]:+.1%}; at most {most[0]:.0%}, {most[1]:.0%}"
        )


speed()
accuracy()
if importlib.util.find_spec("vocaltractlab_cython"):
    cross_check()
