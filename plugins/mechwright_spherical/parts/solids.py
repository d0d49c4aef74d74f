"""Solids of links and pins on concentric shells. Imports the CAD kernel.

Directions are unit vectors (3,), radii in mm from the centre of the sphere.
"""

import math
from collections.abc import Sequence
from dataclasses import dataclass

import cadquery as cq
import numpy as np

from mechwright import Array, GeometryError
from mechwright_spherical.kinematics.vectors import (
    arc,
    azimuth,
    cross,
    dot,
    norm,
    perpendicular,
    rotate,
    vector,
)
from mechwright_spherical.parts.shells import Span

NO_SWEEP = 1e-6
"""rad. A slot shorter than this is a bore: a ten-thousandth of a millimetre."""


def arc_body(u: Array, v: Array, span: Span, width: float, *, start: float = 0.0) -> cq.Solid:
    """The arc of a link: a rectangle, ``span`` by ``width``, revolved about m = u x v from u to v.

    ``start`` lets it begin at that angle from u instead, rad, negative for before it. Its volume is
    width (Ro² - Ri²)/2 times the angle.
    """
    m, first = _beginning(u, v, start)
    return _revolved(_rectangle(first, m, span, width), m, float(arc(u, v)) - start)


def shell_strip(u: Array, v: Array, span: Span, width: float, *, start: float = 0.0) -> cq.Solid:
    """The same as a true strip of a spherical shell, ``width`` across in the middle of its thickness.

    With δ = asin(width / (Ri + Ro)), a piece of a ring between the cones ±δ, revolved: its volume is
    2 sin δ (Ro³ - Ri³)/3 times the angle.
    """
    m, first = _beginning(u, v, start)
    low, high = span
    sine = width / (low + high)
    cosine = math.sqrt(1 - sine**2)
    left, right = (cosine * first + side * sine * m for side in (-1, 1))
    edges = [
        cq.Edge.makeLine(_point(low * left), _point(high * left)),
        cq.Edge.makeThreePointArc(_point(high * left), _point(high * first), _point(high * right)),
        cq.Edge.makeLine(_point(high * right), _point(low * right)),
        cq.Edge.makeThreePointArc(_point(low * right), _point(low * first), _point(low * left)),
    ]
    return _revolved(cq.Wire.assembleEdges(edges), m, float(arc(u, v)) - start)


def _beginning(u: Array, v: Array, start: float) -> tuple[Array, Array]:
    """Normal of an arc, and the direction at the angle ``start`` from u."""
    m = vector(cross(u, v))
    return m, math.cos(start) * u + math.sin(start) * cross(m, u)


def wedge(axis: Array, start: Array, sweep: float, span: Span, width: float) -> cq.Solid:
    """What the middle plane of a radial pin of that width sweeps about an axis, rad of either sign.

    A rectangle in the meridian of axis and pin, revolved: volume width (r1² - r0²)/2 sin(arc) times the
    sweep.
    """
    across = vector(cross(cross(axis, start), start))
    return _revolved(_rectangle(start, across, span, width), axis if sweep > 0 else -axis, abs(sweep))


def stroke(axis: Array, at: Array, span: Span, across: Span, width: float) -> cq.Solid:
    """What cuts a line of a scale: radially over ``span``, away from the axis over ``across`` from ``at``.

    ``width`` is that of the line along the circle about the axis, mm.
    """
    side = vector(at - axis * float(dot(axis, at)))
    outwards = vector(side - at * float(dot(at, side)))
    angle = width / (span[1] * float(norm(cross(axis, at))))
    first = rotate(axis, -angle / 2, at)
    away = rotate(axis, -angle / 2, outwards)
    corners = [
        radius * first + out * away
        for radius, out in (
            (span[0], across[0]),
            (span[1], across[0]),
            (span[1], across[1]),
            (span[0], across[1]),
        )
    ]
    wire = cq.Wire.makePolygon([_point(corner) for corner in corners], close=True)
    return _revolved(wire, axis, angle)


def cylinder(direction: Array, span: Span, diameter: float) -> cq.Solid:
    """A radial pin or boss."""
    low, high = span
    return cq.Solid.makeCylinder(diameter / 2, high - low, _point(low * direction), _point(direction))


def shell(span: Span, towards: Array) -> cq.Solid:
    """A whole spherical shell, its seam on the side away from ``towards``."""
    place = cq.Location(cq.Plane((0, 0, 0), tuple(-towards), tuple(perpendicular(towards))))
    inner, outer = (cq.Solid.makeSphere(radius, angleDegrees1=-90, angleDegrees2=90) for radius in span)
    found = outer.cut(inner).Solids()[0].located(place)
    if not isinstance(found, cq.Solid):
        raise GeometryError("the CAD kernel made no solid of a shell; change its sizes a little")
    return found


def frustum(axis: Array, half_angle: float, span: Span, play: float) -> cq.Solid:
    """A pitch cone between two distances from its tip along the cone, mm, drawn ``play`` mm thinner."""
    low, high = span
    sine, cosine = math.sin(half_angle), math.cos(half_angle)
    return cq.Solid.makeCone(
        low * sine - play,
        high * sine - play,
        (high - low) * cosine,
        _point(low * cosine * axis),
        _point(axis),
    )


@dataclass(frozen=True)
class Slot:
    """A circular slot for a radial pin: about ``axis`` from ``start`` by ``sweep`` rad to ``end``.

    ``end`` is given besides the sweep, since the pins of two phases may lie on slightly different circles.
    """

    axis: Array
    start: Array
    end: Array

    @property
    def sweep(self) -> float:
        """From start to end, rad."""
        return float(azimuth(self.axis, self.start, self.end))

    @property
    def has_length(self) -> bool:
        """Whether the pin moves at all in it."""
        return float(arc(self.start, self.end)) > NO_SWEEP and abs(self.sweep) > NO_SWEEP

    def surroundings(self, span: Span, width: float) -> cq.Solid:
        """Material around the slot, square at its ends, half a width beyond the pin's places; or a boss."""
        if not self.has_length:
            return cylinder(self.start, span, width)
        # Measured where a chord is shortest, on the inside.
        beyond = math.asin(min(1.0, width / 2 / (span[0] * float(norm(cross(self.axis, self.start))))))
        sense = math.copysign(1.0, self.sweep)
        start = rotate(self.axis, -sense * beyond, self.start)
        return wedge(self.axis, start, self.sweep + 2 * sense * beyond, span, width)

    def swept(self, span: Span, diameter: float) -> list[cq.Solid]:
        """What a pin of that diameter sweeps on its way, with the pin at both ends."""
        if not self.has_length:
            return [cylinder(self.start, span, diameter)]
        ends = [cylinder(end, span, diameter) for end in (self.start, self.end)]
        return [wedge(self.axis, self.start, self.sweep, span, diameter), *ends]


def fused(
    bodies: Sequence[cq.Solid], holes: Sequence[cq.Solid] = (), *, within: cq.Solid | None = None
) -> cq.Solid:
    """One solid of all bodies, as far as they lie ``within`` another one, less all holes.

    Raises
    ------
    GeometryError
        They do not hang together.
    """
    whole: cq.Shape = bodies[0].fuse(*bodies[1:]) if len(bodies) > 1 else bodies[0]
    if not whole.isValid():
        # Arcs of one radius that cross at a small angle are too much at a time for the kernel.
        whole = bodies[0]
        for body in bodies[1:]:
            whole = whole.fuse(body)
    if within is not None:
        whole = whole.intersect(within)
    if holes:
        whole = whole.cut(*holes)
    solids = whole.Solids()
    if len(solids) != 1:
        raise GeometryError(
            f"the link falls into {len(solids)} pieces; make it wider than its pins, or its bosses larger"
        )
    solid = solids[0]
    if not isinstance(solid, cq.Solid):
        raise GeometryError("the CAD kernel made no solid of the link; change its sizes a little")
    return solid


def _rectangle(along: Array, across: Array, span: Span, width: float) -> cq.Wire:
    corners = [
        radius * along + side * width / 2 * across
        for radius, side in ((span[0], -1), (span[1], -1), (span[1], 1), (span[0], 1))
    ]
    return cq.Wire.makePolygon([_point(corner) for corner in corners], close=True)


def _revolved(wire: cq.Wire, axis: Array, angle: float) -> cq.Solid:
    solid = cq.Solid.revolve(wire, [], math.degrees(angle), cq.Vector(0, 0, 0), _point(axis))
    if not isinstance(solid, cq.Solid):
        raise GeometryError("the CAD kernel made no solid of an arc; change its sizes a little")
    return solid


def _point(values: Array) -> cq.Vector:
    return cq.Vector(*np.asarray(values, dtype=float).tolist())
