"""Fits a vocal tract to a speaker: to vowels, to a neutral tract, and to how often it closes.

Run it as ``python -m sgim.experiments.make_vocal_anatomy child``, or with a scale of one's own in
the place of ``child``; it takes a minute or two, prints the measures as an `Anatomy`, and how well
they do. For other vowels, call `fit`.
"""

from __future__ import annotations

import sys
from collections.abc import Mapping
from dataclasses import dataclass, fields, replace
from types import MappingProxyType
from typing import Any

import numpy as np

from sgim.environments.vocal.anatomy import ADULT, ARTICULATORS, Anatomy
from sgim.environments.vocal.articulations import CLOSURES, VOWELS
from sgim.environments.vocal.formants import RANGES, formants
from sgim.environments.vocal.geometry import Contours, Reals, contours, tube
from sgim.experiments.make_vocal_articulations import BOUND, search, vowel_cost
from sgim.spaces import FloatArray
from sgim.streams import Streams

CHILD = MappingProxyType(
    {
        "heed": (370.0, 3200.0),
        "hid": (530.0, 2730.0),
        "head": (690.0, 2610.0),
        "had": (1010.0, 2320.0),
        "hod": (1030.0, 1370.0),
        "hawed": (680.0, 1060.0),
        "hood": (560.0, 1410.0),
        "who'd": (430.0, 1170.0),
        "hud": (850.0, 1590.0),
        "heard": (560.0, 1820.0),
    }
)
"""F1 and F2 in Hz of English vowels as 15 children say them (Peterson and Barney 1952)."""

SCALES = MappingProxyType({"man": 1.0, "child": 0.72})
"""Size of a speaker's tract, a man's being 1: about the inverse ratio of second formants."""

OPEN = 0.5
"""Share of uniform draws that should be open."""

CLOSED = 0.2
"""Share of uniform draws that should close at each place, or more."""

_NO_LENGTHS = {"blade_angle", "tip_place", "lip_width_by_opening", "area_exponents"}
_KEPT = {"blade_angle", "area_exponents"}  # what the fit leaves as it is
_MOST = 0.3  # by which a measure may change, as a share of itself
_DRAWS = 1500
_SOFT = 0.03  # cm within which open passes into closed, to be fitted smoothly
_FINE_STEPS = 20
_DIFFERENCE = 2e-3  # by which unknowns are varied to see what depends on them
_LEAST_OPENING = 0.05  # cm, of a vowel
# What counts as much as 1 % of a formant: changing a measure by 20 %, a command of 3.3, a
# hundredth of a centimetre too narrow, 5 % of the draws too few.
_STAY, _EFFORT, _NARROW, _SHARE = 5.0, 0.3, 100.0, 20.0


@dataclass(frozen=True)
class Fitted:
    """A tract that was fitted.

    Attributes:
        anatomy: Its measures.
        articulations: Vowel → positions of the articulators, shape ``(7,)``.
        errors: Vowel → relative errors of F1 and F2.
    """

    anatomy: Anatomy
    articulations: Mapping[str, FloatArray]
    errors: Mapping[str, FloatArray]


def scaled(anatomy: Anatomy, scale: float) -> Anatomy:
    """The same tract in another size: areas grow with the square of lengths."""
    pharynx, mouth = anatomy.area_exponents
    powers = (2 - pharynx, 2 - mouth, 2 - mouth, 2 - mouth)
    changes: dict[str, Any] = {
        "larynx_area": anatomy.larynx_area * scale**2,
        "area_factors": tuple(
            factor * scale**power
            for factor, power in zip(anatomy.area_factors, powers, strict=True)
        ),
    }
    for field in fields(anatomy):
        if field.name not in _NO_LENGTHS | {*changes}:
            value = getattr(anatomy, field.name)
            pair = isinstance(value, tuple)
            changes[field.name] = tuple(v * scale for v in value) if pair else value * scale
    return replace(anatomy, **changes)


def fit(
    start: Anatomy,
    vowels: Mapping[str, tuple[float, float]],
    streams: Streams,
    *,
    rounds: int = 3,
    steps: int = 8,
) -> Fitted:
    """Fit the measures of a tract, by turns with the articulations of its vowels.

    In each round articulations are searched for the tract as it is; then both are moved together
    by nonlinear least squares.

    Args:
        start: Where to begin; the fit stays near it where the vowels do not ask otherwise.
        vowels: Name → F1 and F2 in Hz.
        streams: Random streams.
        rounds: How often articulations are searched anew.
        steps: Steps of least squares in a round.
    """
    from scipy.optimize import least_squares

    problem = _Problem(start, vowels, streams)
    measures = np.ones(len(problem.values))
    for number in range(rounds):
        anatomy = problem.anatomy(measures)
        positions = [
            search(vowel_cost(anatomy, np.array(wanted)), streams("make_vocal_anatomy/vowel", i))[0]
            for i, wanted in enumerate(vowels.values(), number * len(vowels))
        ]
        commands = np.ravel(positions)
        middle = np.concatenate([np.ones(len(measures)), np.zeros(len(commands))])
        bound = np.concatenate([np.full(len(measures), _MOST), np.full(len(commands), BOUND)])
        begun = np.concatenate([measures, commands])
        found = least_squares(
            problem.residuals,
            np.clip(begun, middle - 0.999 * bound, middle + 0.999 * bound),
            bounds=(middle - bound, middle + bound),
            diff_step=np.array(_DIFFERENCE),
            max_nfev=steps,
        )
        measures = found.x[: len(measures)]
    anatomy, articulated = problem.anatomy(measures), problem.positions(found.x)
    errors = formants_of(anatomy, articulated) / problem.wanted - 1
    return Fitted(
        anatomy,
        dict(zip(vowels, articulated.T, strict=True)),
        dict(zip(vowels, errors.T, strict=True)),
    )


def formants_of(anatomy: Anatomy, positions: FloatArray) -> FloatArray:
    """F1 and F2 in Hz of positions, finely, shape ``(2, n)``."""
    return formants(
        tube(anatomy, positions, contours(anatomy, positions)), RANGES, steps=_FINE_STEPS
    )


def shares(anatomy: Anatomy, positions: FloatArray, soft: float = 1e-9) -> FloatArray:
    """Shares of positions that are open, and that close at each of `CLOSURES`.

    Args:
        anatomy: Whose tract.
        positions: Shape ``(7, n)``.
        soft: Length in cm within which open passes into closed.
    """
    shape = contours(anatomy, positions)
    closed = [1 - _soft(_least(shape, lines), soft) for lines in CLOSURES.values()]
    every: FloatArray = np.array([_soft(shape.opening, soft), *closed]).mean(axis=1)
    return every


class _Problem:
    """The residuals of a fit: what should be 0."""

    def __init__(
        self, start: Anatomy, vowels: Mapping[str, tuple[float, float]], streams: Streams
    ) -> None:
        self.start = start
        self.wanted = np.array([*vowels.values()]).T
        self.draws = streams("make_vocal_anatomy").uniform(-3, 3, (len(ARTICULATORS), _DRAWS))
        self.names = [field.name for field in fields(start) if field.name not in _KEPT]
        self.values = np.concatenate([np.ravel(getattr(start, name)) for name in self.names])

    def anatomy(self, measures: FloatArray) -> Anatomy:
        """The start with each of its measures multiplied by one of these."""
        rest = (measures * self.values).tolist()
        changes: dict[str, Any] = {}
        for name in self.names:
            value = getattr(self.start, name)
            count = len(value) if isinstance(value, tuple) else 1
            taken, rest = rest[:count], rest[count:]
            changes[name] = tuple(taken) if isinstance(value, tuple) else taken[0]
        return replace(self.start, **changes)

    def positions(self, unknowns: FloatArray) -> FloatArray:
        """The articulations among the unknowns, shape ``(7, vowels)``."""
        return unknowns[len(self.values) :].reshape(-1, len(ARTICULATORS)).T

    def residuals(self, unknowns: FloatArray) -> FloatArray:
        """In hundredths of a formant."""
        measures = unknowns[: len(self.values)]
        anatomy, positions = self.anatomy(measures), self.positions(unknowns)
        found = formants_of(anatomy, positions)
        narrow = np.minimum(contours(anatomy, positions).opening - _LEAST_OPENING, 0.0)
        opened, *closed = shares(anatomy, self.draws, _SOFT)
        return np.concatenate(
            [
                100 * np.log(found / self.wanted).ravel(),
                _NARROW * narrow,
                _EFFORT * positions.ravel(),
                _STAY * (measures - 1),
                [_SHARE * (opened - OPEN)],
                _SHARE * np.minimum(np.array(closed) - CLOSED, 0.0),
            ]
        )


def _least(shape: Contours, lines: tuple[int, int] | None) -> Reals:
    least: Reals = shape.lips if lines is None else shape.gaps[slice(*lines)].min(axis=0)
    return least


def _soft(gaps: Reals, soft: float) -> FloatArray:
    """1 where a gap is open, 0 where it is closed."""
    opened: FloatArray = 1 / (1 + np.exp(-np.clip(gaps / soft, -50, 50).astype(np.float64)))
    return opened


def main(speaker: str) -> None:
    """Fit a speaker, and print the measures and how well they do."""
    scale = SCALES.get(speaker)
    vowels = CHILD if speaker == "child" else VOWELS
    found = fit(scaled(ADULT, float(speaker) if scale is None else scale), vowels, Streams(0))
    print("Anatomy(")
    for field in fields(found.anatomy):
        value = getattr(found.anatomy, field.name)
        rounded = tuple(round(v, 4) for v in value) if isinstance(value, tuple) else round(value, 4)
        print(f"    {field.name}={rounded},")
    print(")")
    for name, errors in found.errors.items():
        print(f"{name}: F1 {errors[0]:+.1%}, F2 {errors[1]:+.1%}")
    neutral = np.zeros((len(ARTICULATORS), 1))
    length = tube(found.anatomy, neutral, contours(found.anatomy, neutral)).lengths.sum()
    first, second = formants_of(found.anatomy, neutral)[:, 0]
    print(f"neutral: {first:.0f} and {second:.0f} Hz, {length:.1f} cm")
    draws = Streams(1)("make_vocal_anatomy").uniform(-3, 3, (len(ARTICULATORS), 20_000))
    opened, *closed = shares(found.anatomy, draws)
    places = ", ".join(f"{n} {share:.0%}" for n, share in zip(CLOSURES, closed, strict=True))
    print(f"uniform draws: {opened:.0%} open; closed: {places}")


if __name__ == "__main__":
    main(sys.argv[1] if len(sys.argv) > 1 else "child")
