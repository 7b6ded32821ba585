"""The five toys, built of MuJoCo's primitives.

They stand as the caregiver presents them: the front faces the camera, which is on the side of
negative y; x is to the right and z up. Lengths are in m.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

YELLOW = (0.66, 0.55, 0.15)
RED = (0.82, 0.14, 0.13)
GREEN = (0.16, 0.62, 0.25)
GREY = (0.55, 0.55, 0.57)
DARK = (0.16, 0.16, 0.18)
VIOLET = (0.48, 0.20, 0.62)
BLUE = (0.14, 0.28, 0.72)

Colour = tuple[float, float, float]


@dataclass(frozen=True)
class Part:
    """One primitive of a toy.

    Attributes:
        shape: ``box``, ``sphere``, ``ellipsoid``, ``cylinder`` or ``capsule``, as MuJoCo has it.
        size: MuJoCo's half sizes in m.
        place: Centre in m.
        colour: Red, green and blue from 0 to 1.
        turn: Euler angles in degrees.
    """

    shape: str
    size: Sequence[float]
    place: Sequence[float]
    colour: Colour
    turn: Sequence[float] = (0.0, 0.0, 0.0)


@dataclass(frozen=True)
class Toy:
    """A toy.

    Attributes:
        name: Its name, which is its label.
        parts: What it is made of.
        lies: Whether it is presented on its back, since it would not stand.
    """

    name: str
    parts: Sequence[Part]
    lies: bool = False


def _cubes() -> Toy:
    # Four cubes side by side and on top of each other; front and back are painted differently.
    front = {(-1, -1): YELLOW, (-1, 1): YELLOW, (1, -1): RED, (1, 1): RED}
    back = {(-1, -1): YELLOW, (-1, 1): YELLOW, (1, -1): GREEN, (1, 1): GREEN}
    half, parts = 0.021, []
    for (column, row), colour in front.items():
        for depth, paint in ((-1, colour), (1, back[column, row])):
            place = (column * half, depth * half / 2, row * half)
            parts.append(Part("box", (half, half / 2, half), place, paint))
    return Toy("cubes", parts)


def _car() -> Toy:
    body = [
        Part("box", (0.056, 0.026, 0.013), (0, 0, -0.006), YELLOW),
        Part("box", (0.030, 0.023, 0.012), (-0.006, 0, 0.018), YELLOW),
        Part("box", (0.002, 0.018, 0.004), (0.0555, 0, -0.004), RED),
    ]
    wheels = [
        Part("cylinder", (0.012, 0.006), (x, y, -0.017), DARK, (90, 0, 0))
        for x in (-0.034, 0.034)
        for y in (-0.025, 0.025)
    ]
    return Toy("car", body + wheels)


def _dog() -> Toy:
    body = [
        Part("ellipsoid", (0.046, 0.024, 0.024), (-0.006, 0, 0.004), GREY),
        Part("ellipsoid", (0.022, 0.020, 0.020), (0.044, 0, 0.030), GREY),
        Part("ellipsoid", (0.014, 0.010, 0.009), (0.064, 0, 0.024), GREY),
        Part("sphere", (0.005,), (0.077, 0, 0.026), DARK),
        Part("ellipsoid", (0.006, 0.004, 0.014), (0.040, -0.020, 0.034), DARK),
        Part("ellipsoid", (0.006, 0.004, 0.014), (0.040, 0.020, 0.034), GREY),
        Part("capsule", (0.005, 0.014), (-0.056, 0, 0.018), GREY, (0, -40, 0)),
        Part("ellipsoid", (0.020, 0.006, 0.012), (-0.014, 0.021, 0.008), DARK),
    ]
    legs = [
        Part("capsule", (0.009, 0.014), (x, y, -0.022), GREY)
        for x in (-0.032, 0.022)
        for y in (-0.014, 0.014)
    ]
    return Toy("dog", body + legs)


def _ball() -> Toy:
    halves = ((-1, VIOLET), (1, BLUE))
    return Toy("ball", [Part("sphere", (0.040,), (0, y * 0.0015, 0), c) for y, c in halves])


def _bear() -> Toy:
    return Toy(
        "bear",
        [
            Part("ellipsoid", (0.030, 0.024, 0.034), (0, 0, -0.010), RED),
            Part("ellipsoid", (0.023, 0.023, 0.008), (0, 0, 0.019), GREEN),
            Part("sphere", (0.024,), (0, 0, 0.040), RED),
            Part("ellipsoid", (0.010, 0.008, 0.008), (0, -0.021, 0.036), RED),
            Part("sphere", (0.004,), (0, -0.029, 0.038), DARK),
            *(Part("sphere", (0.009,), (x, 0, 0.062), RED) for x in (-0.017, 0.017)),
            *(Part("sphere", (0.003,), (x, -0.0215, 0.046), DARK) for x in (-0.009, 0.009)),
            *(
                Part("capsule", (0.010, 0.014), (x, -0.006, 0.004), RED, (0, x / 0.034 * 40, 0))
                for x in (-0.034, 0.034)
            ),
            *(
                Part("capsule", (0.011, 0.012), (x, -0.010, -0.044), RED, (30, 0, 0))
                for x in (-0.018, 0.018)
            ),
        ],
        lies=True,
    )


TOYS = {toy.name: toy for toy in (_cubes(), _car(), _dog(), _ball(), _bear())}
"""The toys by name."""


def toy_model(toy: Toy) -> str:
    """The toy over a table, in MJCF. The table is in geom group 1, the toy's parts in group 0."""
    parts = "".join(
        f'<geom type="{p.shape}" size="{_numbers(p.size)}" pos="{_numbers(p.place)}" '
        f'euler="{_numbers(p.turn)}" rgba="{_numbers(p.colour)} 1"/>'
        for p in toy.parts
    )
    return f"""
<mujoco model="{toy.name}">
  <option timestep="0.004" integrator="implicitfast"/>
  <default>
    <geom density="400" friction="0.6 0.01 0.002" condim="6" solref="0.01 1" group="0"/>
  </default>
  <worldbody>
    <geom name="table" type="plane" size="1 1 0.1" group="1"/>
    <body name="{toy.name}"><freejoint/>{parts}</body>
  </worldbody>
</mujoco>"""


def _numbers(values: Sequence[float]) -> str:
    return " ".join(f"{value:.6g}" for value in values)
