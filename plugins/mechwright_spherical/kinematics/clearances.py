"""How near links and pins come to each other sideways, within one shell.

Every link is an arc with a disc at each end. Distances are angles on the sphere; what is needed between two
of them is the sum of the angles that their half widths take at the inner radius of the shell.
"""

import math
from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from mechwright import Array
from mechwright_spherical.kinematics.linkage import Linkage
from mechwright_spherical.kinematics.vectors import cross, dot, norm
from mechwright_spherical.parameters import SphericalParams
from mechwright_spherical.parts.shells import Shells

SAMPLES = 361
"""Input angles per phase: bodies move by less than a tenth of a millimetre between two on a sphere of 10
mm."""


@dataclass(frozen=True, slots=True)
class Approach:
    """Where two bodies come nearest.

    Parameters
    ----------
    bodies
        Their names.
    phase
        Its number.
    angle
        Input angle, rad.
    room
        Air between them there, mm; negative if they overlap.
    """

    bodies: tuple[str, str]
    phase: int
    angle: float
    room: float


def approaches(params: SphericalParams, linkage: Linkage, shells: Shells) -> Iterator[Approach]:
    """The nearest approach of every pair that shares a shell, for every phase."""
    hardware = params.hardware
    arc_half, disc_half = hardware.link_width / 2, hardware.boss_diameter / 2
    pin_half = hardware.pin_diameter / 2
    for phase in linkage.phases:
        state = phase.state(SAMPLES)
        angles = phase.sweep(SAMPLES)
        a, b, c = state.a[0], state.b[0], state.c[0]
        a0 = np.broadcast_to(phase.loop.a0[:, None], a.shape)
        b0 = np.broadcast_to(phase.loop.b0[:, None], a.shape)
        crank, rocker = (a0, a), (b, c)
        pairs = [
            ("crank", "rocker", links_apart(crank, rocker, arc_half, disc_half, shells.links["crank"][0]))
        ]
        if linkage.five_bar is not None:
            radius = shells.links["arm"][0]
            pairs.append(("shaft-a0", "arm", pin_apart(a0, (b0, b), pin_half, arc_half, disc_half, radius)))
        for one, two, room in pairs:
            low = int(np.argmin(room))
            yield Approach((one, two), phase.number, float(angles[low]), float(room[low]))


Link = tuple[Array, Array]
"""Both ends of an arc (3, n)."""


def links_apart(one: Link, two: Link, arc_half: float, disc_half: float, radius: float) -> Array:
    """Air (n,), mm at ``radius``, between two links; negative where they overlap."""
    arc_angle, disc_angle = math.atan2(arc_half, radius), math.atan2(disc_half, radius)
    gaps = [arcs_apart(one, two) - 2 * arc_angle]
    for ends, other in ((one, two), (two, one)):
        for end in ends:
            gaps.append(point_to_arc(end, other) - arc_angle - disc_angle)
            gaps += [_angle(end, far) - 2 * disc_angle for far in other]
    return np.asarray(radius * np.min(gaps, axis=0))


def pin_apart(
    pin: Array, link: Link, pin_half: float, arc_half: float, disc_half: float, radius: float
) -> Array:
    """Air (n,), mm at ``radius``, between a radial pin and a link."""
    arc_angle, disc_angle, own = (math.atan2(x, radius) for x in (arc_half, disc_half, pin_half))
    gaps = [point_to_arc(pin, link) - own - arc_angle]
    gaps += [_angle(pin, end) - own - disc_angle for end in link]
    return np.asarray(radius * np.min(gaps, axis=0))


def arcs_apart(one: Link, two: Link) -> Array:
    """Least angle (n,) between two arcs, from an end of one to the other; 0 where they cross.

    The distance to a great circle has no least value but where it is 0.
    """
    ends = [point_to_arc(end, other) for link, other in ((one, two), (two, one)) for end in link]
    return np.where(_cross_each_other(one, two), 0.0, np.min(ends, axis=0))


def point_to_arc(point: Array, link: Link) -> Array:
    """Angle (n,) from points (3, n) to arcs: to their great circle, or to an end.

    An arc without length is its end.
    """
    start, end = link
    normal = cross(start, end)
    length = norm(normal)
    normal = normal / np.where(length > 0, length, 1.0)
    ahead, behind = cross(normal, start), cross(end, normal)
    beside = np.arcsin(np.clip(np.abs(dot(normal, point)), 0.0, 1.0))
    # The foot lies on the arc where it is ahead of the start and behind the end.
    on = (dot(ahead, point) > 0) & (dot(behind, point) > 0)
    ends = np.minimum(_angle(point, start), _angle(point, end))
    return np.asarray(np.where(on, beside, ends))


def _cross_each_other(one: Link, two: Link) -> NDArray[np.bool_]:
    first, second = cross(*one), cross(*two)
    line = cross(first, second)
    crossing = np.zeros(line.shape[1:], dtype=bool)
    for sign in (1.0, -1.0):
        on_both = np.logical_and(_on_arc(sign * line, one, first), _on_arc(sign * line, two, second))
        crossing = np.logical_or(crossing, on_both)
    return crossing


def _on_arc(point: Array, link: Link, normal: Array) -> NDArray[np.bool_]:
    start, end = link
    return np.asarray((dot(cross(normal, start), point) > 0) & (dot(cross(end, normal), point) > 0))


def _angle(a: Array, b: Array) -> Array:
    return np.asarray(np.arctan2(norm(cross(a, b)), dot(a, b)))
