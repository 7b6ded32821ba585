"""Made-up pictures: a patterned box on a table that a camera looks down on at an angle."""

import numpy as np

from sgim.recognition import Picture

RED, YELLOW, GREEN = (200, 30, 30), (200, 180, 40), (30, 160, 60)


def picture(
    colours: tuple[tuple[int, int, int], ...], seed: int = 0, *, height: float = 0.05
) -> Picture:
    """A square of 60 pixels with upright stripes of these colours and a grain of its own."""
    rng = np.random.default_rng(seed)
    rows, columns = np.mgrid[0:120, 0:160]
    depth = 1 / (1.8 + 0.004 * rows + 0.0001 * columns)
    painted = np.full((120, 160, 3), 128.0)
    square = (slice(30, 90), slice(50, 110))
    stripe = (np.arange(60) * len(colours) // 60)[None, :].repeat(60, axis=0)
    painted[square] = np.array(colours)[stripe]
    grain = np.kron(rng.normal(0, 25, (15, 15)), np.ones((4, 4)))
    painted[square] += grain[..., None]
    painted += rng.normal(0, 2, painted.shape)
    depth[square] -= height
    return Picture(np.clip(painted, 0, 255).astype(np.uint8), depth)
