"""Vocalisations as something to listen to: a voice, filtered by the tract's formants.

A buzz of Rosenberg's (1971) glottal pulses goes through resonators, one for each formant, one
after another (Klatt 1980). It is for people: the learner hears `perception`'s six numbers.
"""

from __future__ import annotations

import math
import wave
from pathlib import Path

import numpy as np

from sgim.environments.vocal.motor import DURATION
from sgim.environments.vocal.world import Vocalisation
from sgim.spaces import FloatArray

RATE = 16_000
"""Samples a second."""

_PITCHES = (125.0, 105.0)  # at the start and at the end, in Hz
_OPENING, _CLOSING = 0.4, 0.16  # shares of a period in which the glottis opens and closes
_BANDWIDTHS = (80.0, 100.0, 130.0, 180.0, 250.0)  # in Hz
_UPPER = (3500.0, 4500.0)  # the fourth and fifth formant, which are those of any man
_BLOCK = 80  # samples in which formants stay as they are: 5 ms
_RAMP = 0.01  # s in which the voice sets in
_LOUDEST = 0.8


def waveform(vocalisation: Vocalisation) -> FloatArray:
    """The sound pressure of a vocalisation.

    Args:
        vocalisation: As `VocalTract.vocalise` gives it.

    Returns:
        In [-1, 1], `RATE` samples a second for 0.8 s; silence where nothing is heard.
    """
    from scipy.signal import lfilter

    times = np.arange(round(DURATION * RATE)) / RATE
    loud = np.interp(times, vocalisation.times, vocalisation.heard)
    width = round(_RAMP * RATE)
    signal = _voice(times) * np.convolve(loud >= 0.5, np.full(width, 1 / width), mode="same")
    formants = _formants(vocalisation, times[::_BLOCK])
    for frequencies, bandwidth in zip(formants, _BANDWIDTHS, strict=True):
        state = np.zeros(2)
        for start, frequency in zip(range(0, len(signal), _BLOCK), frequencies, strict=True):
            block = slice(start, start + _BLOCK)
            gain, feedback = _resonator(float(frequency), bandwidth)
            signal[block], state = lfilter(gain, feedback, signal[block], zi=state)
    most = np.abs(signal).max()
    return _LOUDEST * signal / most if most > 0 else signal


def write_wav(path: str | Path, samples: FloatArray) -> None:
    """Write sound as a WAV file of one channel and 16 bits.

    Args:
        path: Where to; an existing file is replaced.
        samples: In [-1, 1], `RATE` a second.
    """
    with wave.open(str(path), "wb") as file:
        file.setnchannels(1)
        file.setsampwidth(2)
        file.setframerate(RATE)
        file.writeframes(np.round(samples * 32767).astype("<i2").tobytes())


def _voice(times: FloatArray) -> FloatArray:
    """Changes of the air flow through the glottis: what is heard outside of the lips."""
    start, end = _PITCHES
    cycles = start * times + (end - start) * times**2 / (2 * DURATION)
    phase = cycles % 1.0
    opening = 1 - np.cos(np.pi * phase / _OPENING)
    closing = 2 * np.cos(np.pi / 2 * (phase - _OPENING) / _CLOSING)
    flow = np.where(phase < _OPENING, opening, np.where(phase < _OPENING + _CLOSING, closing, 0.0))
    return np.diff(flow, prepend=0.0)


def _formants(vocalisation: Vocalisation, times: FloatArray) -> FloatArray:
    """Five formants at these times, held where nothing is heard, shape ``(5, t)``."""
    heard = vocalisation.heard > 0
    upper = np.repeat(np.array(_UPPER)[:, None], len(times), axis=1)
    if not heard.any():
        return np.concatenate([np.full((3, len(times)), 500.0), upper])
    lower = [np.interp(times, vocalisation.times[heard], f[heard]) for f in vocalisation.formants]
    return np.concatenate([lower, upper])


def _resonator(frequency: float, bandwidth: float) -> tuple[list[float], list[float]]:
    """Coefficients of a resonator whose gain is 1 at 0 Hz."""
    radius = math.exp(-math.pi * bandwidth / RATE)
    first = -2 * radius * math.cos(2 * math.pi * frequency / RATE)
    second = radius * radius
    return [1 + first + second], [1.0, first, second]
