"""Dimensions of a slide's bar and of its linear guide, which follow from the design without its loads.

The rail begins beyond all that roller and cam reach. The carriage stands on it as near to the cam as it comes
when the slide is lowest, and the pin of the spring stands in the bar behind the carriage.
"""

from typing import Any

import numpy as np

from mechwright.contracts.design_table import number
from mechwright.standards.screws import screw_size
from mechwright_cam_follower.kinematics.mechanism import Mechanism

FREE = 1.0
"""mm between parts that pass each other in one plane, and about the shaft in its slot."""

BESIDE_GUIDE = 2.0
"""Between a carriage and the end of its rail, and between the rail and what moves before it, mm."""

BEARING = 22.0
"""From a cam's shaft to where a rail may begin beside the bearing of that, mm."""

PIN_ROOM = 8.0
"""From a carriage to the axis of the spring's pin, mm."""


def shaft_room(m: Mechanism) -> Any:
    """Half the width of the slot in which the shaft of conjugate cams passes through the follower, mm."""
    return m.given.bore / 2 + FREE


def bar_width(m: Mechanism) -> Any:
    """Width of a slide's bar, mm: of a pair with room for the shaft's slot, on a carriage for its screws."""
    guide = m.given.linear_guide
    if guide is not None:
        screwed = guide.across + screw_size(guide.thread).clearance() + 2 * m.given.least_wall
        return number(np.maximum(m.given.follower_width, screwed))
    if not m.given.conjugate:
        return m.given.follower_width
    room = 2 * (shaft_room(m) + m.given.least_wall + np.abs(m.offset))
    return number(np.maximum(m.given.follower_width, room))


def rail_start(m: Mechanism) -> Any:
    """From the cam's axis to the rail of a linear guide, mm: clear of roller, cam and shaft."""
    if m.flat:
        return number(np.maximum(m.start, m.given.bore / 2 + BEARING)) + BESIDE_GUIDE
    high = m.start + m.stroke
    # The outermost place of the cam is one roller's radius within the farthest of the pitch curve.
    cam, follower = np.hypot(high, m.offset) - m.roller, high + m.roller
    return number(np.maximum(cam, follower)) + BESIDE_GUIDE


def carriage_place(m: Mechanism) -> Any:
    """From the origin of a slide to the middle of its carriage, mm."""
    return rail_start(m) + BESIDE_GUIDE + _carriage_length(m) / 2 - m.start


def pin_place(m: Mechanism) -> Any:
    """From the origin of a slide to its spring's pin, mm: behind the carriage."""
    return carriage_place(m) + _carriage_length(m) / 2 + PIN_ROOM


def _carriage_length(m: Mechanism) -> float:
    guide = m.given.linear_guide
    return 0.0 if guide is None else guide.length
