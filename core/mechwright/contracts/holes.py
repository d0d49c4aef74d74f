"""Holes of a plate made to a fit, or threaded: the same hole in the outline, the features and the details."""

import math
from dataclasses import replace

from mechwright.contracts.details import Thread
from mechwright.contracts.fits import HoleClass, hole_fit
from mechwright.contracts.part import Bore, Part, Profile, is_outside
from mechwright.contracts.sections import plan_view
from mechwright.contracts.threads import COARSE, UNIFIED, named
from mechwright.errors import GeometryError
from mechwright.geometry import Arc, Line, Loop, Outline, circle
from mechwright.geometry.segments import Point, Segment
from mechwright.tolerances import TOLERANCES

CLEARANCE = 1.2
"""A clearance hole is at most so many times as wide as its screw (ISO 273, medium: 2.4 mm for M2)."""
PLAY = 0.25
"""A hole may be drawn narrower than the core of its thread by so many pitches: as a tapping drill is."""


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
    return exchanged(part, bore, replace(bore, diameter=limits.middle, fit=limits))


def threaded(part: Part, name: str, designation: str, depth: float | None = None) -> Part:
    """The part with a hole threaded from the top face on; the hole gets the core diameter.

    The ``designation`` is such as ``"M6"``, ``"M6x0.75"`` or ``"1/4-20 UNC"``, with LH behind it for a
    left-hand one, the ``depth`` that of the last full turn, mm;
    left out it is all through, or one pitch less than a blind hole. Raises GeometryError where there is no
    hole of this name at the top face; it is much wider than the thread, or narrower; it is less deep; or less
    than one pitch of the plate would stay round the thread.
    """
    bore = hole(part, name)
    said = named(designation)
    nominal, pitch = said.diameter, said.pitch
    through = bore.depth > part.thickness - TOLERANCES.closure
    if depth is None:
        depth = part.thickness if through else bore.depth - pitch
    thread = Thread(f"thread-{name}", bore.centre, nominal, pitch, depth, said.left, said.inch)
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
            name for name, d, p in _known(thread) if d - (1.0825 + PLAY) * p <= bore.diameter <= CLEARANCE * d
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
    wall = wall_beside(part, bore) - nominal / 2
    if wall < pitch:
        raise GeometryError(
            f"{thread.designation} in {name} of part {part.name} leaves a wall of {max(wall, 0):.2f} mm; it "
            f"needs one pitch, {pitch:g} mm: take a smaller thread"
        )
    # Nine digits: the last of a binary fraction would stand in drawings.
    made = exchanged(part, bore, replace(bore, diameter=round(thread.core, 6), fit=None))
    return replace(made, details=(*made.details, thread))


def _known(like: Thread) -> list[tuple[str, float, float]]:
    """Name, diameter and pitch of usual threads, unified ones where the wished one is."""
    if not like.inch:
        return [(f"M{d:g}", float(d), float(p)) for d, p in COARSE.items()]
    names = [f"{size}-{count} {series}" for series, sizes in UNIFIED.items() for size, count in sizes.items()]
    return [(name, named(name).diameter, named(name).pitch) for name in names]


def joined(part: Part) -> Part:
    """The part with its holes as wide as what is pressed or screwed into them; others stay as they are.

    A pin in a hole of class N7 or P7, and a screw in its thread, stand in the part by their design.
    """
    if part.turned is not None and part.turned.threads:
        return replace(part, build=part.turned.screwed)
    if part.free_form is not None:
        return replace(part, free_form=part.free_form.joined)
    for bore in [feature for feature in part.features if isinstance(feature, Bore)]:
        nominal = [
            detail.diameter
            for detail in part.details
            if isinstance(detail, Thread) and math.dist(detail.centre, bore.centre) < TOLERANCES.closure
        ]
        wide = max([bore.diameter, *nominal, *([bore.fit.size] if bore.fit else [])])
        if wide > bore.diameter:
            part = exchanged(part, bore, replace(bore, diameter=wide))
    return part


def exchanged(part: Part, old: Bore, new: Bore) -> Part:
    """The part with one hole for another, in its features and, if it goes through, in its outline."""
    assert part.outline is not None  # noqa: S101 - only plates have features
    features = tuple(
        new
        if feature is old
        else replace(feature, loop=_widened(feature.loop, old, new))
        if isinstance(feature, Profile) and feature.side == "inside"
        else feature
        for feature in part.features
    )
    loops = tuple(_widened(loop, old, new) for loop in part.outline.inner)
    return replace(
        part, outline=Outline(part.outline.outer, loops, part.outline.deviation), machined=features
    )


def _widened(loop: Loop, old: Bore, new: Bore) -> Loop:
    """The loop with the wall of a hole moved; what adjoins it, as a keyway does, ends at the new wall."""
    if not any(_is_wall(segment, old) for segment in loop.segments):
        return loop
    if loop.is_circle:
        tag = loop.segments[0].tag
        return Loop((circle(new.centre, new.diameter / 2, clockwise=loop.area < 0, tag=tag),))
    count = len(loop.segments)
    found: list[Segment] = []
    for k, segment in enumerate(loop.segments):
        before, after = loop.segments[k - 1], loop.segments[(k + 1) % count]
        if isinstance(segment, Arc) and _is_wall(segment, old):
            found.append(_wall(segment, _met(before, segment.start, new), _met(after, segment.end, new), new))
        elif isinstance(segment, Line):
            start = _met(segment, segment.start, new) if _is_wall(before, old) else segment.start
            end = _met(segment, segment.end, new) if _is_wall(after, old) else segment.end
            found.append(replace(segment, start=start, end=end))
        else:
            found.append(segment)
    return Loop(tuple(found))


def _is_wall(segment: Segment, bore: Bore) -> bool:
    """Whether a segment is a piece of the wall of a hole."""
    return (
        isinstance(segment, Arc)
        and math.dist(segment.centre, bore.centre) <= TOLERANCES.closure
        and abs(2 * segment.radius - bore.diameter) <= TOLERANCES.closure
    )


def _met(beside: Segment, at: Point, bore: Bore) -> Point:
    """Where a segment that adjoined the wall of a hole at a point meets the wall of ``bore``."""
    (cx, cy), radius = bore.centre, bore.diameter / 2
    x, y = at[0] - cx, at[1] - cy
    if not isinstance(beside, Line):
        far = math.hypot(x, y)
        return cx + x * radius / far, cy + y * radius / far
    length = math.dist(beside.start, beside.end)
    u, v = ((b - a) / length for a, b in zip(beside.start, beside.end, strict=True))
    along, across = x * u + y * v, x * v - y * u
    reach = math.copysign(math.sqrt(radius**2 - across**2), along)
    return at[0] + (reach - along) * u, at[1] + (reach - along) * v


def _wall(arc: Arc, start: Point, end: Point, bore: Bore) -> Arc:
    """The piece of the wall of a hole between two points, in the sense of an arc."""
    first, last = (math.atan2(y - bore.centre[1], x - bore.centre[0]) for x, y in (start, end))
    sweep = (last - first) % math.tau if arc.sweep > 0 else -((first - last) % math.tau)
    return Arc(bore.centre, bore.diameter / 2, first, sweep, arc.tag)


def wall_beside(part: Part, bore: Bore) -> float:
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
