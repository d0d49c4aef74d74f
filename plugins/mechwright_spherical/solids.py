"""Solids of links and pins on concentric shells. Imports the CAD kernel.

Directions are unit vectors (3,), radii in mm from the centre of the sphere.
"""

import math
from collections.abc import Sequence
from dataclasses import dataclass

import cadquery as cq
import numpy as np

from mechwright.errors import GeometryError
from mechwright.motion import Array
from mechwright_spherical.shells import Span
from mechwright_spherical.vectors import arc, azimuth, cross, vector

NO_SWEEP = 1e-6
"""rad. A slot shorter than this is a bore: a ten-thousandth of a millimetre."""


def arc_body(u: Array, v: Array, span: Span, width: float, *, start: float = 0.0) -> cq.Solid:
    """The arc of a link: a rectangle, ``span`` by ``width``, revolved about m = u x v from u to v.

    ``start`` lets it begin at that angle from u instead, rad, negative for before it. Its volume is
    width (Ro² - Ri²)/2 times the angle.
    """
    m = vector(cross(u, v))
    first = math.cos(start) * u + math.sin(start) * cross(m, u)
    return _revolved(_rectangle(first, m, span, width), m, float(arc(u, v)) - start)


def wedge(axis: Array, start: Array, sweep: float, span: Span, width: float) -> cq.Solid:
    """What the middle plane of a radial pin of that width sweeps about an axis, rad of either sign.

    A rectangle in the meridian of axis and pin, revolved: volume width (r1² - r0²)/2 sin(arc) times the
    sweep.
    """
    across = vector(cross(cross(axis, start), start))
    return _revolved(_rectangle(start, across, span, width), axis if sweep > 0 else -axis, abs(sweep))


def cylinder(direction: Array, span: Span, diameter: float) -> cq.Solid:
    """A radial pin or boss."""
    low, high = span
    return cq.Solid.makeCylinder(diameter / 2, high - low, _point(low * direction), _point(direction))


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

    def swept(self, span: Span, diameter: float) -> list[cq.Solid]:
        """What a pin of that diameter sweeps on its way, with the pin at both ends."""
        found = [cylinder(self.start, span, diameter)]
        if float(arc(self.start, self.end)) > NO_SWEEP:
            found.append(cylinder(self.end, span, diameter))
        if abs(self.sweep) > NO_SWEEP:
            found.append(wedge(self.axis, self.start, self.sweep, span, diameter))
        return found


def fused(bodies: Sequence[cq.Solid], holes: Sequence[cq.Solid] = ()) -> cq.Solid:
    """One solid of all bodies, less all holes.

    Raises
    ------
    GeometryError
        They do not hang together.
    """
    whole: cq.Shape = bodies[0].fuse(*bodies[1:]) if len(bodies) > 1 else bodies[0]
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
