"""Sizes of followers and rails that follow from the design.

Of a slide, rails stand beside the bar, clear of everything the cam reaches; the bar is so long that both
rails hold it over their whole length at every lift.
"""

import cmath
import math
from dataclasses import dataclass

from mechwright_cam_follower.extremes import extremes_of, face_of
from mechwright_cam_follower.geometry import geometry_of
from mechwright_cam_follower.params import CamParams

FREE = 1.0
"""mm between parts that pass each other in one plane, and about the shaft in its slot."""

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


def shaft_room(params: CamParams) -> float:
    """Half the width of the slot in which the shaft of conjugate cams passes through the follower, mm."""
    return params.bore / 2 + FREE


def bar_width(params: CamParams) -> float:
    """Width of a slide's bar, mm: that of a pair has room for the shaft's slot."""
    if not params.conjugate:
        return params.follower_width
    return max(
        params.follower_width, 2 * (shaft_room(params) + params.least_wall + abs(params.value("offset")))
    )


def studs_of(params: CamParams) -> tuple[complex, ...]:
    """Centres of the rollers in the follower's frame, mm."""
    apart = geometry_of(params).apart
    if params.translating:
        return (0j, -1j * apart) if params.conjugate else (0j,)
    arm = complex(params.value("arm_length"))
    return (arm, arm * cmath.exp(1j * apart)) if params.conjugate else (arm,)


def slide_sides(params: CamParams) -> tuple[float, float]:
    """Left and right side of a slide in its frame, mm."""
    if params.contact == "roller":
        return -bar_width(params) / 2, bar_width(params) / 2
    low, high = face_of(params)
    margin = params.value("face_margin")
    return low - margin, high + margin


def slide_height(params: CamParams) -> float:
    """From the origin of a slide to its top, mm, where its sides end."""
    return _rail_foot(params) + params.guide_length - geometry_of(params).start


def _rail_foot(params: CamParams) -> float:
    """Height over the cam's axis where rails begin, mm."""
    if params.contact == "flat":
        return max(extremes_of(params).outermost.value, geometry_of(params).start + params.stroke) + FREE
    return geometry_of(params).start + params.stroke + bar_width(params) / 2 + FREE


def rails_of(params: CamParams) -> Rails:
    """The rails of a slide."""
    width = 2 * (params.guide_screw + params.least_wall)
    low, high = slide_sides(params)
    middle = params.value("offset") if params.contact == "roller" else 0.0
    foot = _rail_foot(params)
    left = complex(middle + low - params.guide_clearance - width, foot)
    right = complex(middle + high + params.guide_clearance, foot)
    return Rails(width, params.guide_length, (left, right))


def swing(params: CamParams) -> tuple[float, float]:
    """First and last angle of the shaft about the axis of a pair's lever, in its frame, rad."""
    start = geometry_of(params).start
    return start, start + math.radians(params.stroke)
