"""The measures of a vocal tract: what a tract is made of, whoever's it is.

Lengths are in cm, x toward the lips and y up, from the centre of the polar grid, which lies inside
the tongue. What ``by`` a command does is per unit of it.
"""

from __future__ import annotations

from dataclasses import dataclass

ARTICULATORS = (
    "jaw",
    "tongue body",
    "tongue height",
    "tongue tip",
    "lip height",
    "lip protrusion",
    "larynx height",
)
"""What shapes the tract. Positive: closed, to the front, up, up, open, protruded, up."""

Pair = tuple[float, float]


@dataclass(frozen=True)
class Anatomy:
    """The measures of a tract, after Mermelstein (1973) and Maeda (1990).

    Attributes:
        tongue_radius: Of the circle that is the tongue's body.
        tongue_rest: Its centre in the neutral position.
        tongue_by_jaw: How jaw, body and height move the centre.
        tongue_by_body: See ``tongue_by_jaw``.
        tongue_by_height: See ``tongue_by_jaw``.
        root_depth: How far behind the origin the tongue's root is at the larynx.
        blade_angle: Where on the circle the blade begins, in degrees from x.
        incisor_height: Height of the lower incisors, where the blade ends.
        incisor_by_jaw: How the jaw raises them.
        tip_by_tip: How the tip raises the blade at its most.
        tip_place: Where that is, as a share of ``teeth_place``.
        tip_width: How far the rise extends: where it is 1/e of its most.
        pharynx_wall: How far behind the origin the pharynx wall is.
        velum_wall: How far from the origin the velum is, at 135°.
        palate_wall: How high above the origin the hard palate begins.
        dome_height: Height of the palate's dome.
        ridge_height: Height of the alveolar ridge.
        teeth_height: Height of the upper incisors.
        teeth_place: x of the incisors.
        larynx_depth: y of the larynx in the neutral position, below 0.
        larynx_by_larynx: How the command raises it.
        larynx_area: Area of the larynx tube in cm².
        larynx_length: Its length.
        area_factors: Factor of eq. A = factor · distance^exponent in the pharynx, at the velum, in
            the mouth and behind the teeth.
        area_exponents: Exponent in the pharynx and in the mouth.
        lip_opening: Height of the opening of the lips in the neutral position.
        lip_by_height: How lip height opens them.
        lip_by_jaw: How the jaw closes them.
        lip_width: Width of the opening when its height is 0.
        lip_width_by_opening: How its height widens it.
        lip_width_by_protrusion: How protrusion narrows it.
        lip_length: Length of the lip tube.
        lip_length_by_protrusion: How protrusion lengthens it.
    """

    tongue_radius: float = 2.09
    tongue_rest: Pair = (0.2324, -0.1115)
    tongue_by_jaw: Pair = (0.0432, 0.1829)
    tongue_by_body: Pair = (0.4215, 0.0630)
    tongue_by_height: Pair = (-0.0568, 0.3578)
    root_depth: float = 1.998
    blade_angle: float = 50.0
    incisor_height: float = 1.013
    incisor_by_jaw: float = 0.1925
    tip_by_tip: float = 0.4371
    tip_place: float = 0.8675
    tip_width: float = 0.6712
    pharynx_wall: float = 3.239
    velum_wall: float = 2.741
    palate_wall: float = 2.585
    dome_height: float = 3.062
    ridge_height: float = 1.742
    teeth_height: float = 1.748
    teeth_place: float = 4.067
    larynx_depth: float = -6.303
    larynx_by_larynx: float = 0.2309
    larynx_area: float = 0.6091
    larynx_length: float = 1.6
    area_factors: tuple[float, float, float, float] = (1.553, 1.832, 1.587, 1.618)
    area_exponents: Pair = (1.2, 1.5)
    lip_opening: float = 0.5441
    lip_by_height: float = 0.3167
    lip_by_jaw: float = 0.1431
    lip_width: float = 1.6
    lip_width_by_opening: float = 0.7
    lip_width_by_protrusion: float = 0.282
    lip_length: float = 1.073
    lip_length_by_protrusion: float = 0.2786


ADULT = Anatomy()
"""An adult man's: fitted so that its vowels are those of Peterson and Barney (1952)."""
