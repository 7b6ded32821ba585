"""Our formants on another model's tubes, against that model's own transfer function.

VocalTractLab (Birkholz) is published under the GPL; it is an optional extra, which only this test
and a benchmark use.
"""

import numpy as np
import pytest

from sgim.environments.vocal.formants import formants
from sgim.environments.vocal.geometry import Tube

vocaltractlab = pytest.importorskip("vocaltractlab_cython", reason="sgim[vocaltractlab]")

VOWELS = ("a", "e", "i", "o", "u", "E:", "I", "E", "O", "U", "Y", "9", "y", "2", "@", "6")


def test_formants_agree_with_a_lossy_model_within_a_few_percent() -> None:
    apart = []
    for vowel in VOWELS:
        shape = vocaltractlab.get_shape(vowel, "tract")
        their = vocaltractlab.tract_state_to_tube_state(shape)
        found = vocaltractlab.tract_state_to_transfer_function(shape, n_spectrum_samples=8192)
        spectrum = found["magnitude_spectrum"][:4096]
        frequencies = np.arange(4096) * 44100 / 8192
        peaks = 1 + np.flatnonzero(
            (spectrum[1:-1] > spectrum[:-2]) & (spectrum[1:-1] >= spectrum[2:])
        )
        tubes = Tube(their["tube_area"][:, None], their["tube_length"][:, None])
        apart.append(formants(tubes)[:, 0] / frequencies[peaks[:2]] - 1)
    first, second = np.median(np.abs(apart), axis=0)
    assert first < 0.15
    assert second < 0.08
