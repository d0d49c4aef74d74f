"""The frame's foot: the ground link goes on to a post, which stands on the base plate."""

import math

import numpy as np

from mechwright import Arc, Array, Line, Loop, Outline, Segment, circle
from mechwright_spherical.kinematics.chain import orientation
from mechwright_spherical.kinematics.linkage import Linkage
from mechwright_spherical.kinematics.vectors import vector
from mechwright_spherical.parts.hardware import StandTable
from mechwright_spherical.parts.shells import Shells

FLANGE_SCREWS = ((-0.2, -0.2), (-0.2, 0.2), (0.2, -0.2), (0.2, 0.2))
"""Where screws hold the post's flange, in sides of the base plate from its middle: the flange fits in between
the mounting holes."""

MOUNTING_SCREWS = ((-0.4, -0.4), (-0.4, 0.4), (0.4, -0.4), (0.4, 0.4))
"""Where screws hold the base plate, in its sides: a tenth of a side is left to the edges."""


def flange_diameter(stand: StandTable) -> float:
    """Diameter of the post's flange, mm: a screw's diameter of material around the screw holes."""
    return 2 * (math.hypot(*FLANGE_SCREWS[0]) * stand.plate + 1.5 * stand.screw)


def post_direction(stand: StandTable) -> Array:
    """Direction of the post in the ground link's frame: x the input axis, the other one towards y."""
    angle = math.radians(stand.arc)
    return np.array([math.cos(angle), -math.sin(angle), 0.0])


def base_outline(stand: StandTable, hole: float) -> Outline:
    """The base plate, seen against the post: a square with rounded corners and eight holes of a diameter."""
    half, round_ = stand.plate / 2, 0.1 * stand.plate
    flat = half - round_
    segments: list[Segment] = []
    for quarter in range(4):
        turn = quarter * math.pi / 2
        side: list[Segment] = [
            Line((half, -flat), (half, flat), "side"),
            Arc((flat, flat), round_, 0.0, math.pi / 2, "corner"),
        ]
        segments += [segment.moved(0.0, 0.0, turn) for segment in side]
    holes = tuple(
        Loop((circle((stand.plate * x, stand.plate * y), hole / 2, clockwise=True, tag="screw"),))
        for x, y in (*FLANGE_SCREWS, *MOUNTING_SCREWS)
    )
    return Outline(Loop(tuple(segments)), holes)


def base_pose(linkage: Linkage, shells: Shells, stand: StandTable) -> tuple[Array, Array]:
    """Position (3,), mm, and rotation (3, 3) of the base plate: its z axis is the post's, outwards."""
    loop = linkage.shown.loop
    ground = orientation(loop.a0, loop.b0)
    z = ground @ post_direction(stand)
    x = vector(ground @ np.array([0.0, 0.0, 1.0]))
    rotation = np.stack([x, np.cross(z, x), z], axis=1)
    return (shells.outside + stand.height) * z, rotation
