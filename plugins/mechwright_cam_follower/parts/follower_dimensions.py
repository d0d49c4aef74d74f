"""Dimensions of followers and rails that follow from the design.

Of a slide, rails stand beside the bar, clear of everything the cam reaches; the bar is so long that both
rails hold it over their whole length at every lift.
"""

import cmath
from dataclasses import dataclass
from typing import Any

import numpy as np

from mechwright.contracts.design_table import number
from mechwright_cam_follower.kinematics.extremes import face_ends, outermost
from mechwright_cam_follower.kinematics.mechanism import Mechanism
from mechwright_cam_follower.parts.slide_dimensions import FREE, bar_width, pin_place

CORNER = 1.0
"""Radius of the corners of plain plates, mm; smaller where there is less room."""


@dataclass(frozen=True)
class Rails:
    """Both rails of a slide.

    Parameters
    ----------
    width, length
        Of one, mm.
    places
        Lower left corners of both, mm.
    """

    width: float
    length: float
    places: tuple[complex, complex]


def studs_of(m: Mechanism) -> tuple[complex, ...]:
    """Centres of the rollers in the follower's frame, mm, of one design."""
    if m.slides:
        return (0j, -1j * m.apart)[: len(m.cams)]
    arm = complex(m.arm)
    return (arm, arm * cmath.exp(1j * m.apart))[: len(m.cams)]


def slide_sides(m: Mechanism) -> tuple[Any, Any]:
    """Left and right side of a slide in its frame, mm."""
    if not m.flat:
        return -bar_width(m) / 2, bar_width(m) / 2
    low, high = face_ends(m)
    margin = m.value("face_margin")
    if m.given.linear_guide is None:
        return low - margin, high + margin
    half = bar_width(m) / 2
    return number(np.minimum(low - margin, -half)), number(np.maximum(high + margin, half))


def slide_height(m: Mechanism) -> Any:
    """From the origin of a slide to its top, mm, where its sides end."""
    if m.given.linear_guide is not None:
        return pin_place(m) + (bar_width(m) / 2 if m.flat else 0.0)
    return _rail_foot(m) + m.given.guide_length - m.start


def _rail_foot(m: Mechanism) -> Any:
    """Height over the cam's axis where rails begin, mm."""
    if m.flat:
        return number(np.maximum(outermost(m).value, m.start + m.stroke)) + FREE
    return m.start + m.stroke + bar_width(m) / 2 + FREE


def rails_of(m: Mechanism) -> Rails:
    """The rails of a slide, of one design."""
    width = 2 * (m.given.guide_screw + m.given.least_wall)
    low, high = slide_sides(m)
    foot = _rail_foot(m)
    left = complex(m.offset + low - m.given.guide_clearance - width, foot)
    right = complex(m.offset + high + m.given.guide_clearance, foot)
    return Rails(width, m.given.guide_length, (left, right))


def follower_foot(m: Mechanism) -> float:
    """Height of the underside of bar, lever and rails, mm."""
    return 0.0 if m.flat else m.given.thickness + m.given.axial_gap


def follower_depth(m: Mechanism) -> float:
    """Thickness of bar, lever and rails, mm."""
    return m.given.thickness if m.flat else m.given.follower_thickness
