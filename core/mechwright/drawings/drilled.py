"""Round holes of a drawing: bores, fits and threads."""

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from typing import cast

from mechwright.contracts.details import Thread
from mechwright.contracts.fits import HoleClass, hole_fit
from mechwright.contracts.holes import CLEARANCE, PLAY
from mechwright.contracts.part import Bore
from mechwright.contracts.threads import named
from mechwright.drawings.asked import Asked
from mechwright.drawings.contours import Contour, rounded
from mechwright.drawings.fault import Told, at
from mechwright.drawings.meaning import Meaning, meaning
from mechwright.drawings.strokes import Stroke
from mechwright.errors import DesignError, GeometryError
from mechwright.geometry import Arc
from mechwright.geometry.segments import Point
from mechwright.tolerances import TOLERANCES

CHORDS = 0.02
"""Corners of a hole that was drawn as a polygon stand so near to a circle, mm."""
COAXIAL = 0.01
"""Circles whose centres are nearer than this, mm, are of one hole."""
DRAWN = 2e-6
"""Two diameters that differ by less, mm, are one: the rounding of six decimals."""
SIXTY_FOURTH = 25.4 / 64
"""Sizes of inch drills, mm."""


@dataclass(frozen=True)
class Hole:
    """A round hole as a drawing has it."""

    centre: Point
    diameter: float
    meant: Meaning
    name: str
    bored: float | None = None
    """How deep the bore of a thread is, where that is drawn as well, mm."""


def circles(meant: Meaning, contours: Sequence[Contour], told: Told) -> list[Hole]:
    """The holes on layers of holes; a fault for what is not round."""
    found = []
    for one in contours:
        arc = one.circle
        if arc is None:
            arc = _polygon(one, told)
        if arc is None:
            told.fault(
                "feature",
                f"the contour of {one.name} is no circle, and {meant.text} are round",
                "draw a circle, or give it a layer of openings or pockets",
            )
        else:
            found.append(Hole(arc.centre, 2 * arc.radius, meant, one.name))
    return found


def _polygon(contour: Contour, told: Told) -> Arc | None:
    loop = rounded(contour.loop, CHORDS)
    arc = loop.segments[0]
    if not (loop.is_circle and isinstance(arc, Arc)):
        return None
    told.note(
        f"the contour of {contour.name} is a polygon round {2 * arc.radius:.4g} mm; it is taken as the circle"
    )
    return arc


def threads(meant: Meaning, strokes: Sequence[Stroke], told: Told) -> list[Hole]:
    """The circles, or parts of circles, on a layer of threads; several about one axis are one thread."""
    found: list[Hole] = []
    for stroke in strokes:
        arcs = [segment for segment in stroke.segments if isinstance(segment, Arc)]
        if len(arcs) != len(stroke.segments) or any(
            math.dist(a.centre, arcs[0].centre) > COAXIAL for a in arcs
        ):
            told.fault(
                "feature",
                f"{stroke.name} at {at(stroke.segments[0].start)} is no circle, and {meant.text} are round",
                "draw the thread as a circle",
            )
            continue
        hole = Hole(arcs[0].centre, 2 * arcs[0].radius, meant, stroke.name)
        twin = next((k for k, one in enumerate(found) if coaxial(one, hole.centre)), None)
        if twin is None:
            found.append(hole)
        elif hole.diameter < found[twin].diameter:
            found[twin] = hole  # the core, where core and nominal circle are drawn
    return found


def coaxial(hole: Hole, centre: Point) -> bool:
    """Whether a hole stands about a point."""
    return math.dist(hole.centre, centre) <= COAXIAL


def by_size(asked: Asked, told: Told) -> Mapping[float, Meaning]:
    """What circles of a diameter mean, as the design says it."""
    found: dict[float, Meaning] = {}
    for diameter, text in asked.holes:
        try:
            meant = meaning(text, 1.0)
        except DesignError as error:
            told.fault("feature", f"holes, {diameter:g}: {error}", 'say a fit, a thread or "bore 5"', "holes")
            continue
        if meant is None or meant.kind not in {"bore", "thread", "screw", "ignore"}:
            told.fault(
                "feature",
                f"holes, {diameter:g}: {text!r} says nothing of a hole",
                'say "H7", "M5", "bore 5", "screw M6" or "ignore"',
                "holes",
            )
        else:
            found[diameter] = meant
    return found


def sized(holes: Sequence[Hole], asked: Asked, told: Told) -> list[Hole]:
    """The holes, with what the design says of their diameters; a fault for a size that no circle has."""
    sizes = by_size(asked, told)
    found, used = [], set()
    for hole in holes:
        size = next((one for one in sizes if abs(one - hole.diameter) <= SAME_SIZE), None)
        if size is None:
            found.append(hole)
            continue
        used.add(size)
        if sizes[size].kind != "ignore":
            found.append(replace(hole, meant=sizes[size]))
    has = ", ".join(f"{size:g}" for size in sorted({round(hole.diameter, 3) for hole in holes})) or "none"
    for size in sizes:
        if size not in used:
            told.fault(
                "feature",
                f"holes: no circle has {size:g} mm; there are: {has}",
                "correct the diameter",
                "holes",
            )
    return found


SAME_SIZE = 0.005
"""A diameter in the design names circles within so much, mm."""


def nominal(diameter: float, name: HoleClass) -> float:
    """The basic size of a hole that is to get a fit: as it is drawn.

    Where it is drawn in the middle of its tolerance, as our own drawings have it, that tolerance's size.

    >>> nominal(6.0, "H7"), nominal(6.006, "H7"), nominal(7.9375, "H7")
    (6.0, 6.0, 7.9375)
    """
    if _stepped(diameter, 0.05) or _stepped(diameter, SIXTY_FOURTH):
        return round(diameter, 6)
    middle = hole_fit(diameter, name)
    size = round((diameter - (middle.middle - middle.size)) / 0.05) * 0.05
    size = round(size, 6)
    if size > 0 and abs(hole_fit(size, name).middle - diameter) <= DRAWN:
        return size
    return round(diameter, 6)


def _stepped(value: float, step: float) -> bool:
    return abs(value - round(value / step) * step) <= DRAWN


def bore(hole: Hole, name: str, thickness: float, told: Told) -> tuple[Bore, Thread | None] | None:
    """The bore of a hole from the top face on, and its thread; None, and a fault, where it cannot be had."""
    meant = hole.meant
    top = meant.top or 0.0
    deep = thickness if meant.depth is None else meant.depth
    if deep > thickness + TOLERANCES.closure:
        told.fault(
            "feature",
            f"the hole of {hole.name} is {deep:g} mm deep, in a plate of {thickness:g} mm",
            "leave the depth out where it goes through, or make the plate thicker",
            "thickness",
        )
        return None
    if deep <= top:
        said = f"the hole of {hole.name} begins {top:g} mm deep and ends {deep:g} mm deep"
        told.fault("layer", said, "let it end deeper", "layers")
        return None
    if meant.kind == "thread":
        return _threaded(hole, name, thickness, told)
    if not meant.fit:
        return Bore(name, hole.centre, hole.diameter, top, deep - top), None
    fit_name = cast("HoleClass", meant.fit)  # a class of the table: the layer's words matched its pattern
    try:
        limits = hole_fit(nominal(hole.diameter, fit_name), fit_name)
    except GeometryError as error:
        told.fault("feature", f"the hole of {hole.name}: {error}", "leave the fit out", "layers")
        return None
    return Bore(name, hole.centre, limits.middle, top, deep - top, limits), None


def _threaded(hole: Hole, name: str, thickness: float, told: Told) -> tuple[Bore, Thread] | None:
    said = named(hole.meant.thread)
    size, pitch = said.diameter, said.pitch
    depth = hole.meant.depth
    full = thickness if depth is None else depth
    thread = Thread(f"thread-{name}", hole.centre, size, pitch, full, said.left, said.inch)
    if not thread.core - PLAY * pitch <= hole.diameter <= CLEARANCE * size:
        told.fault(
            "feature",
            f"the circle of {hole.name} has {hole.diameter:g} mm; {hole.meant.thread} is drawn from its "
            f"core, {thread.core:.4g} mm, to {CLEARANCE * size:g} mm",
            "draw the circle of the thread, or say another thread",
        )
        return None
    # One pitch below the last full turn, as everywhere; what comes out below goes through.
    deep = thickness if depth is None or depth + pitch >= thickness else depth + pitch
    if hole.bored is not None:
        deep = min(hole.bored, thickness)
    return Bore(name, hole.centre, round(thread.core, 6), 0.0, deep), thread
