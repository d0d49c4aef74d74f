"""Holes of a plate made to a fit, or threaded: the same hole in the outline, the features and the details."""

import math
import re
from dataclasses import replace

from mechwright.contracts.details import Thread
from mechwright.contracts.fits import HoleClass, hole_fit
from mechwright.contracts.part import Bore, Part, is_outside
from mechwright.contracts.sections import plan_view
from mechwright.errors import GeometryError
from mechwright.geometry import Arc, Loop, Outline, circle
from mechwright.tolerances import TOLERANCES

COARSE = {
    1.6: 0.35, 2: 0.4, 2.5: 0.45, 3: 0.5, 3.5: 0.6, 4: 0.7, 5: 0.8, 6: 1, 7: 1, 8: 1.25, 10: 1.5, 12: 1.75,
    14: 2, 16: 2, 18: 2.5, 20: 2.5, 22: 2.5, 24: 3, 27: 3, 30: 3.5, 33: 3.5, 36: 4, 39: 4, 42: 4.5, 45: 4.5,
    48: 5, 52: 5, 56: 5.5, 60: 5.5, 64: 6,
}  # fmt: skip
"""Nominal diameter to coarse pitch, mm (ISO 261)."""

_THREAD = re.compile(r"M(\d+(?:\.\d+)?)(?:\s*[x×]\s*(\d+(?:\.\d+)?))?")
CLEARANCE = 1.2
"""A clearance hole is at most so many times as wide as its screw (ISO 273, medium: 2.4 mm for M2)."""
PLAY = 0.25
"""A hole may be drawn narrower than the core of its thread by so many pitches: as a tapping drill is."""


def metric(designation: str) -> tuple[float, float]:
    """Nominal diameter and pitch of a thread, mm; the coarse pitch if none is said.

    Raises GeometryError for what is no such designation, has no coarse pitch, or too coarse a one.

    >>> metric("M6"), metric("M8x1")
    ((6.0, 1.0), (8.0, 1.0))
    """
    found = _THREAD.fullmatch(designation.strip())
    if found is None:
        raise GeometryError(f"{designation!r} is no metric thread; write M6, or M6x0.75 for a fine pitch")
    diameter = float(found[1])
    if found[2] is None and diameter not in COARSE:
        raise GeometryError(f"{designation} has no coarse pitch in ISO 261; say which, as M{diameter:g}x1")
    pitch = float(found[2] or COARSE[diameter])
    Thread("thread", (0.0, 0.0), diameter, pitch, 1.0)  # says what is wrong with the pitch
    return diameter, float(pitch)


def hole(part: Part, name: str) -> Bore:
    """The round hole of this name; raises GeometryError that lists those there are."""
    bores = [feature for feature in part.features if isinstance(feature, Bore)]
    for bore in bores:
        if bore.name == name:
            return bore
    known = ", ".join(f"{bore.name} ({bore.diameter:g} mm)" for bore in bores)
    raise GeometryError(f"part {part.name} has no round hole {name!r}; it has: {known or 'none'}")


def fitted(part: Part, name: str, fit: HoleClass) -> Part:
    """The part with a hole made to the middle of a tolerance class of its own size.

    Raises GeometryError where there is no such hole, or it is larger than the tables of fits.
    """
    bore = hole(part, name)
    limits = hole_fit(bore.diameter if bore.fit is None else bore.fit.size, fit)
    return _with(part, bore, replace(bore, diameter=limits.middle, fit=limits))


def threaded(part: Part, name: str, designation: str, depth: float | None = None) -> Part:
    """The part with a hole threaded from the top face on; the hole gets the core diameter.

    The ``designation`` is such as ``"M6"`` or ``"M6x0.75"``, the ``depth`` that of the last full turn, mm;
    left out it is all through, or one pitch less than a blind hole. Raises GeometryError where there is no
    hole of this name at the top face; it is much wider than the thread, or narrower; it is less deep; or less
    than one pitch of the plate would stay round the thread.
    """
    bore = hole(part, name)
    nominal, pitch = metric(designation)
    through = bore.depth > part.thickness - TOLERANCES.closure
    if depth is None:
        depth = part.thickness if through else bore.depth - pitch
    thread = Thread(f"thread-{name}", bore.centre, nominal, pitch, depth)
    if any(
        isinstance(d, Thread) and math.dist(d.centre, bore.centre) < TOLERANCES.closure for d in part.details
    ):
        raise GeometryError(f"{name} of part {part.name} has a thread already")
    if bore.top > TOLERANCES.closure:
        raise GeometryError(
            f"{name} of part {part.name} starts {bore.top:g} mm below the top face; threads start at it"
        )
    if not thread.core - PLAY * pitch <= bore.diameter <= CLEARANCE * nominal:
        able = [
            f"M{d:g}" for d, p in COARSE.items() if d - (1.0825 + PLAY) * p <= bore.diameter <= CLEARANCE * d
        ]
        raise GeometryError(
            f"{thread.designation} is no thread for {name} of part {part.name}, a hole of "
            f"{bore.diameter:g} mm; for that there is {', '.join(able) or 'none'}"
        )
    if not 0 < depth <= min(bore.depth, part.thickness) + TOLERANCES.closure:
        raise GeometryError(
            f"{name} of part {part.name} is {min(bore.depth, part.thickness):g} mm deep; no thread of "
            f"{max(depth, 0):g} mm goes into it"
        )
    wall = _wall(part, bore) - nominal / 2
    if wall < pitch:
        raise GeometryError(
            f"{thread.designation} in {name} of part {part.name} leaves a wall of {max(wall, 0):.2f} mm; it "
            f"needs one pitch, {pitch:g} mm: take a smaller thread"
        )
    # Nine digits: the last of a binary fraction would stand in drawings.
    made = _with(part, bore, replace(bore, diameter=round(thread.core, 6), fit=None))
    return replace(made, details=(*made.details, thread))


def joined(part: Part) -> Part:
    """The part with its holes as wide as what is pressed or screwed into them; others stay as they are.

    A pin in a hole of class N7 or P7, and a screw in its thread, stand in the part by their design.
    """
    if part.turned is not None and part.turned.threads:
        return replace(part, build=part.turned.screwed.solid)
    for bore in [feature for feature in part.features if isinstance(feature, Bore)]:
        nominal = [
            detail.diameter
            for detail in part.details
            if isinstance(detail, Thread) and math.dist(detail.centre, bore.centre) < TOLERANCES.closure
        ]
        wide = max([bore.diameter, *nominal, *([bore.fit.size] if bore.fit else [])])
        if wide > bore.diameter:
            part = _with(part, bore, replace(bore, diameter=wide))
    return part


def _with(part: Part, old: Bore, new: Bore) -> Part:
    """The part with one hole for another, in its features and, if it goes through, in its outline."""
    assert part.outline is not None  # noqa: S101 - only plates have features
    features = tuple(new if feature is old else feature for feature in part.features)
    loops = tuple(_widened(loop, old, new) for loop in part.outline.inner)
    return replace(
        part, outline=Outline(part.outline.outer, loops, part.outline.deviation), machined=features
    )


def _widened(loop: Loop, old: Bore, new: Bore) -> Loop:
    arc = loop.segments[0]
    if not (loop.is_circle and isinstance(arc, Arc)):
        return loop
    if (
        math.dist(arc.centre, old.centre) > TOLERANCES.closure
        or abs(2 * arc.radius - old.diameter) > TOLERANCES.closure
    ):
        return loop
    return Loop((circle(new.centre, new.diameter / 2, clockwise=loop.area < 0, tag=arc.tag),))


def _wall(part: Part, bore: Bore) -> float:
    """Distance of a hole's axis from the nearest wall that is not its own, mm."""
    import shapely

    assert part.outline is not None  # noqa: S101 - only plates have features
    axis = shapely.Point(bore.centre)
    walls = [shapely.boundary(shapely.Polygon(part.outline.outer.flatten()))]
    for feature in part.features:
        coaxial = isinstance(feature, Bore) and math.dist(feature.centre, bore.centre) < TOLERANCES.closure
        if not is_outside(feature) and not coaxial:
            walls.append(shapely.boundary(plan_view(feature)))
    return float(min(shapely.distance(axis, wall) for wall in walls))
