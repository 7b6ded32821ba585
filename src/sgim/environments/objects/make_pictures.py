"""Make the pictures that recognition is measured by.

Run it as ``python -m sgim.environments.objects.make_pictures``.
"""

from __future__ import annotations

from pathlib import Path

import numpy as np

from sgim import environments
from sgim.environments.objects.pictures import PICTURES_FILE, make_pictures
from sgim.environments.objects.table import ToyTable
from sgim.recognition.features import FEATURES


def main(folder: Path) -> None:
    """Write them to ``folder``."""
    made = [(toy, one) for toy, several in make_pictures(ToyTable()).items() for one in several]
    packed = [FEATURES.pack(one.arrays) for _, one in made]
    np.savez_compressed(
        folder / PICTURES_FILE,
        packed=np.frombuffer(b"".join(packed), np.uint8),
        lengths=np.array([len(one) for one in packed]),
        toys=np.array([toy for toy, _ in made]),
    )
    print(f"{PICTURES_FILE}: {len(made)} pictures")


if __name__ == "__main__":
    main(Path(environments.__file__).parent / "data")
