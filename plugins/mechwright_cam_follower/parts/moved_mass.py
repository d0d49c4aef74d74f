"""The mass of a slide's own parts, and the moment of inertia of a lever's."""

from collections.abc import Iterator

import numpy as np

from mechwright import Array
from mechwright.contracts.mass import mass_moments
from mechwright_cam_follower.kinematics.mechanism import Mechanism
from mechwright_cam_follower.kinematics.motion import FOLLOWER, ROLLERS
from mechwright_cam_follower.parts.follower_dimensions import studs_of
from mechwright_cam_follower.parts.parts import parts_of
from mechwright_cam_follower.parts.spring_parts import SPRING_PIN, spring_place

CARRIAGE_SCREW = 1.2
"""Mass of a screw of a carriage with its washers, g: M3, 12 to 16 mm long."""


def own_inertia(m: Mechanism) -> float:
    """Of lever, rollers and spring pin of one design about the lever's axis, kg m²."""
    return sum(float(one[0, 0] + one[1, 1]) for one in _moments(m)) / 1e6


def own_mass(m: Mechanism) -> float:
    """Of slide, rollers, spring pin, and of a carriage with its screws, kg."""
    guide = m.given.linear_guide
    carriage = 0.0 if guide is None else guide.mass + len(guide.carriage_holes) * CARRIAGE_SCREW
    return sum(float(one[3, 3]) for one in _moments(m)) + carriage / 1000


def _moments(m: Mechanism) -> Iterator[Array]:
    """Moments (4, 4) of the parts in the follower's frame, kg and mm."""
    places = {FOLLOWER: 0j, **dict(zip(ROLLERS, studs_of(m) if not m.flat else (), strict=False))}
    spring = spring_place(m)
    if spring is not None:
        places[SPRING_PIN] = spring.on_follower
    for part in parts_of(m.given):
        for instance in part.instances:
            if instance.body in places:
                shift, at = np.eye(4), places[instance.body]
                shift[:2, 3] = at.real, at.imag
                yield shift @ mass_moments(part) @ shift.T
