"""The moment of inertia of a lever's own parts."""

import numpy as np

from mechwright.contracts.mass import mass_moments
from mechwright_cam_follower.kinematics.mechanism import Mechanism
from mechwright_cam_follower.kinematics.motion import FOLLOWER, ROLLERS
from mechwright_cam_follower.parts.follower_dimensions import studs_of
from mechwright_cam_follower.parts.parts import parts_of
from mechwright_cam_follower.parts.spring_parts import SPRING_PIN, spring_place


def own_inertia(m: Mechanism) -> float:
    """Of lever, rollers and spring pin of one design about the lever's axis, kg m²."""
    places = {FOLLOWER: 0j, **dict(zip(ROLLERS, studs_of(m) if not m.flat else (), strict=False))}
    spring = spring_place(m)
    if spring is not None:
        places[SPRING_PIN] = spring.on_follower
    total = 0.0
    for part in parts_of(m.given):
        for instance in part.instances:
            if instance.body in places:
                shift, at = np.eye(4), places[instance.body]
                shift[:2, 3] = at.real, at.imag
                moved = shift @ mass_moments(part) @ shift.T
                total += float(moved[0, 0] + moved[1, 1])
    return total / 1e6
