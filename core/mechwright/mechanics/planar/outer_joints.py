"""What the outer joints of a dyad are on the links that stand already: pins and lines."""

from collections.abc import Mapping
from typing import Any

import numpy as np

from mechwright.mechanics.planar.dyads import Slide, turned
from mechwright.mechanics.planar.machine import Prismatic, Revolute
from mechwright.mechanics.planar.rigid import BodyMotion, PointMotion


def outer_pin(joint: Revolute, link: str, bodies: Mapping[str, BodyMotion], rates: int = 3) -> PointMotion:
    """How an outer pin of a link moves."""
    stands = neighbour(joint, link)
    return bodies[stands].point(joint.place(stands), rates)


def neighbour(joint: Revolute | Prismatic, link: str) -> str:
    """The other link of a joint."""
    one, two = joint.links
    return one if two == link else two


def guide_line(joint: Prismatic, body: BodyMotion, link: str, rates: int = 3) -> Slide:
    """The line of a slide as the link that stands has it: through its own point of the joint."""
    return Slide(body.point(joint.place(link), rates), turned(body.turning, joint.direction(link)))


def offset_from_line(joint: Prismatic, link: str, place: Any) -> Any:
    """How far a place of the link that slides is to the left of the line."""
    lever = np.asarray(place, complex) - joint.place(link)
    return (lever * np.exp(-1j * np.asarray(joint.direction(link)))).imag


def offset_across(joint: Prismatic, one: Any, two: Any, first: str) -> Any:
    """How far the second outer pin is to the left of the first along the slide between two bars."""
    second = joint.block if first == joint.guide else joint.guide
    return offset_from_line(joint, second, two) - offset_from_line(joint, first, one)
