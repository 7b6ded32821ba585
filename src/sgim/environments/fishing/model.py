"""The arm, the rod and the line as a MuJoCo model, written as MJCF text.

With all angles 0 the arm and the rod lie along y, 15 cm above the water at z = 0, and the line
hangs down from the rod's tip.
"""

from __future__ import annotations

from dataclasses import dataclass

HOME_DEGREES = (0.0, 110.0, -110.0, 0.0, 35.0, 0.0)
"""Angles of the six joints at home: the rod points forward and up."""

JOINTS = ("base", "shoulder", "elbow", "forearm", "wrist", "grip")
"""Names of the arm's joints, from the base outward."""

_BASE_HEIGHT = 0.15
_LINKS = (0.20, 0.15, 0.08)
_LINK_MASSES = (0.5, 0.3, 0.1)
# In which link each joint is, and the axis it turns about: yaw, two pitches, roll, pitch, roll.
_LINK_JOINTS = (
    (("base", "0 0 1"), ("shoulder", "1 0 0")),
    (("elbow", "1 0 0"),),
    (("forearm", "0 1 0"), ("wrist", "1 0 0"), ("grip", "0 1 0")),
)
_STIFFNESS_OF_CONTROL = dict(zip(JOINTS, (60, 60, 40, 15, 15, 8), strict=True))
_ROD_LENGTH = 0.47
_ROD_MASSES = (0.012, 0.009, 0.006, 0.003)
_ROD_STIFFNESSES = (2.0, 1.8, 1.6)
_LINE_LENGTH = 0.60
_LINE_MASS = 0.006
_FLOAT_MASS = 0.020
# Only floor and ball touch; they slide, spin and roll with friction.
_TOUCH = 'contype="1" conaffinity="1" condim="6" friction="0.8 0.005 0.002"'


@dataclass(frozen=True)
class Variant:
    """How finely the world is simulated.

    Attributes:
        name: Its name.
        segments: Rigid segments of the line.
        step: Time step in s; the integrator is Runge-Kutta of order 4.
        armature: Rotor inertia of the line's hinges in kg·m², without which they are stiff.
        floor: Height in m of a floor that the ball at the end of the line can lie on; None for
            water, which nothing meets.
    """

    name: str
    segments: int
    step: float
    armature: float
    floor: float | None = None


FULL = Variant("full", segments=30, step=0.006, armature=1e-5)
FAST = Variant("fast", segments=8, step=0.010, armature=2.5e-5)
FLOOR = Variant("floor", segments=8, step=0.005, armature=2.5e-5, floor=-0.35)

BALL_RADIUS = 0.01
"""Of the float, which is a ball where there is a floor, in m."""


def rod_model(variant: Variant, *, settling: bool = False) -> str:
    """The model as MJCF text.

    Shapes that cannot touch only give their bodies masses, and are discarded. The one sensor is
    the float's position.

    Args:
        variant: How finely it is simulated.
        settling: Whether to make the model that is used once, to let the line come to rest:
            an implicit integrator, short steps and strong damping.
    """
    integrator, step = ("implicitfast", 0.002) if settling else ("RK4", variant.step)
    damping = 1e-2 if settling else 1e-4
    bodies = _arm(_rod(_line(variant, damping)))
    actuators = "".join(
        f'<position name="{joint}" joint="{joint}" kp="{kp}" dampratio="1" timeconst="0.1" '
        'forcerange="-30 30"/>'
        for joint, kp in _STIFFNESS_OF_CONTROL.items()
    )
    free = variant.floor is None or settling
    floor = "" if free else f'<geom type="plane" size="5 5 1" pos="0 0 {variant.floor}" {_TOUCH}/>'
    touching = "disable" if free else "enable"
    return (
        '<mujoco model="fishing rod"><compiler angle="radian" discardvisual="true"/>'
        '<default><geom contype="0" conaffinity="0"/></default>'
        f'<option timestep="{step}" integrator="{integrator}">'
        f'<flag contact="{touching}" constraint="{touching}" autoreset="disable"/></option>'
        f"<worldbody>{floor}{bodies}</worldbody><actuator>{actuators}</actuator>"
        '<sensor><framepos objtype="xbody" objname="float"/></sensor></mujoco>'
    )


def _arm(held: str) -> str:
    """The three links of the arm, with what the last of them holds."""
    inner = held
    for number in reversed(range(len(_LINKS))):
        joints = "".join(
            f'<joint name="{name}" axis="{axis}" armature="0.02" damping="0.5"/>'
            for name, axis in _LINK_JOINTS[number]
        )
        place = f"0 {_LINKS[number - 1]} 0" if number else f"0 0 {_BASE_HEIGHT}"
        inner = (
            f'<body name="link{number}" pos="{place}" gravcomp="1">{joints}'
            f"{_capsule('y', _LINKS[number], 0.02, _LINK_MASSES[number])}{inner}</body>"
        )
    return inner


def _rod(held: str) -> str:
    """The rod: a segment that is fixed in the hand, and three on sprung two-axis hinges."""
    count = len(_ROD_MASSES)
    length = _ROD_LENGTH / count
    inner = held
    for number in reversed(range(count)):
        hinges = ""
        if number:
            stiffness = _ROD_STIFFNESSES[number - 1]
            hinges = "".join(
                f'<joint axis="{axis}" stiffness="{stiffness}" damping="0.01" armature="1e-4"/>'
                for axis in ("1 0 0", "0 0 1")
            )
        place = f"0 {length if number else _LINKS[-1]} 0"
        inner = (
            f'<body name="rod{number}" pos="{place}">{hinges}'
            f"{_capsule('y', length, 0.004, _ROD_MASSES[number])}{inner}</body>"
        )
    return inner


def _line(variant: Variant, damping: float) -> str:
    """The line from the rod's tip, on hinges about x and y in turn, and the float at its end."""
    length = _LINE_LENGTH / variant.segments
    mass = _LINE_MASS / variant.segments
    inner = (
        f'<body name="float" pos="0 0 {-length}">'
        f'<geom type="sphere" size="{BALL_RADIUS}" mass="{_FLOAT_MASS}" {_TOUCH}/></body>'
    )
    for number in reversed(range(variant.segments)):
        place = f"0 0 {-length}" if number else f"0 {_ROD_LENGTH / len(_ROD_MASSES)} 0"
        axis = "0 1 0" if number % 2 else "1 0 0"
        inner = (
            f'<body name="line{number}" pos="{place}">'
            f'<joint axis="{axis}" armature="{variant.armature}" damping="{damping}"/>'
            f"{_capsule('-z', length, 0.002, mass)}{inner}</body>"
        )
    return inner


def _capsule(along: str, length: float, radius: float, mass: float) -> str:
    end = {"y": f"0 {length} 0", "-z": f"0 0 {-length}"}[along]
    return f'<geom type="capsule" fromto="0 0 0 {end}" size="{radius}" mass="{mass}"/>'
