"""Vocalisations can be heard."""

import wave
from pathlib import Path

import numpy as np
import pytest

from sgim.environments import VocalTract
from sgim.environments.vocal import spoken
from sgim.environments.vocal.articulations import formants_of
from sgim.environments.vocal.sound import RATE, waveform, write_wav
from sgim.spaces import FloatArray

QUIET = VocalTract(noise=0.0)


def said(first: str, second: str) -> FloatArray:
    return waveform(QUIET.vocalise(spoken(first, second)))


def loudness(samples: FloatArray, start: float, end: float) -> float:
    return float(np.sqrt((samples[round(start * RATE) : round(end * RATE)] ** 2).mean()))


@pytest.mark.parametrize("name", ["a", "i", "u"])
def test_a_vowel_is_loudest_near_its_first_formant(name: str) -> None:
    samples = said(name, name)[round(0.6 * RATE) :]
    spectrum = np.abs(np.fft.rfft(samples * np.hanning(len(samples))))
    frequencies = np.fft.rfftfreq(len(samples), 1 / RATE)
    assert frequencies[spectrum.argmax()] == pytest.approx(formants_of(name)[0], abs=130)


def test_nothing_sounds_while_the_tract_is_closed_or_at_rest() -> None:
    syllable = said("labial", "a")
    assert loudness(syllable, 0.25, 0.32) < 0.02 < loudness(syllable, 0.5, 0.8)
    assert not waveform(QUIET.vocalise(QUIET.task.rest)).any()


def test_a_wav_file_has_what_was_said(tmp_path: Path) -> None:
    samples = said("a", "i")
    write_wav(tmp_path / "ai.wav", samples)
    with wave.open(str(tmp_path / "ai.wav")) as file:
        assert (file.getnchannels(), file.getframerate()) == (1, RATE)
        assert file.getnframes() == len(samples) == round(0.8 * RATE)
        heard = np.frombuffer(file.readframes(len(samples)), "<i2") / 32767
    assert heard == pytest.approx(samples, abs=1e-4)
    assert 0.5 < np.abs(samples).max() <= 1
