"""Rules of one part: recesses, material, thickness, openings that overlap, holes, webs, corners, fits."""

from collections.abc import Iterator
from itertools import combinations, groupby

import shapely

from mechwright.contracts.finding import Change, Finding, Stage
from mechwright.contracts.materials import material
from mechwright.contracts.part import Part
from mechwright.errors import GeometryError
from mechwright.geometry import Arc
from mechwright.geometry.segments import Point
from mechwright.tolerances import TOLERANCES, falls_short
from mechwright_cut.jobs import CutPart, fitted_bores, keeps_limits, recesses
from mechwright_cut.rules.slots import slot_findings
from mechwright_cut.settings.cut_settings import CutSettings
from mechwright_cut.settings.figures import Process, able, greatest_thickness, heat_of, refusal

FELT = 0.05
"""A corner that keeps less than this, mm, is not worth a word."""
WHOLE = 0.9
"""What fills more than this share of an opening is no corner of it."""


def refused(part: Part, process: Process, settings: CutSettings, *, service: bool = False) -> str | None:
    """Why a process cannot make a plate at all, in a clause; None where it can.

    How thick a ``service`` cuts is on its own list.
    """
    if names := recesses(part):
        verb = "does" if len(names) == 1 else "do"
        return f"{', '.join(names[:3])} {verb} not go through, and {process.words} cuts through"
    why = refusal(process.name, part.material)
    if why is not None and not (why.unless and getattr(settings, why.unless)):
        lifted = f" (cut.{why.unless} = true lifts this)" if why.unless else ""
        return f"{process.words} must not cut {part.material}: {why.why}{lifted}"
    most = greatest_thickness(process, part.material)
    if most is None:
        others = ", ".join(able(part.material, part.thickness)) or "none"
        return f"nothing is known of {part.material} by {process.words}; known: {others}"
    if part.thickness > most and not service:
        return (
            f"{process.words} cuts {part.material} up to {most:g} mm, and it is {part.thickness:g} mm thick"
        )
    return overlaps(part)


def overlaps(part: Part) -> str | None:
    """Whether closed shapes of the outline overlap, in a clause; None where none do."""
    assert part.outline is not None  # noqa: S101 - plates alone are asked
    outer = shapely.Polygon(part.outline.outer.flatten())
    holes = [shapely.Polygon(loop.flatten()) for loop in part.outline.inner]
    for number, hole in enumerate(holes, start=1):
        if not shapely.contains(outer, hole):
            return f"opening {number} crosses the outside; closed shapes must not overlap"
    for (one, a), (two, b) in combinations(enumerate(holes, start=1), 2):
        if shapely.intersects(a, b):
            return f"openings {one} and {two} overlap; closed shapes must not"
    try:
        part.outline.polygon()
    except GeometryError as error:
        return str(error)
    return None


def loses(cut: CutPart, process: Process, kerf: float) -> Iterator[str]:
    """What a plate has less of than as drawn."""
    opened = [
        (bore, bore.fit)
        for bore in fitted_bores(cut.part).values()
        if bore.fit is not None and not keeps_limits(process, bore)
    ]
    for fit, bores in groupby(opened, key=lambda one: one[1].short):
        yield f"{fit} of {', '.join(bore.name for bore, _ in bores)}: ± {process.holes:g} mm"
    if drilled := sum(one.startswith("drill ") for one in cut.finishing):
        yield f"{_count(drilled)} drilled afterwards"
    yield f"lengths ± {process.size:g} mm"
    if (deep := _sharpest(cut, process, kerf)) > FELT:
        yield f"inside corners keep up to {deep:.2f} mm"
    if process.taper >= FELT:
        yield f"taper up to {process.taper:g} mm between the faces"


def part_findings(cut: CutPart, process: Process, kerf: float, settings: CutSettings) -> Iterator[Finding]:
    """What there is to say of a part that the process can make."""
    yield from _holes(cut, process)
    yield from _webs(cut, process)
    narrow = [*slot_findings(cut, process, kerf, settings)]
    yield from narrow or _corners(cut, process, kerf)
    yield from _fits(cut.part, process, settings)
    if heat := heat_of(process.name, cut.part.material, cut.finishing):
        yield Finding.note("cut.heat", f"{cut.part.name}: {heat.why}: {heat.step}")


def _error(
    code: str, key: str, message: str, value: float, limit: float, remedy: str, change: Change
) -> Finding:
    return Finding.error(code, key, message, value, limit, "mm", remedy, Stage.MACHINING, (change,))


def _holes(cut: CutPart, process: Process) -> Iterator[Finding]:
    least = process.least_hole(cut.part.thickness)
    small: dict[float, list[Point]] = {}
    for loop in cut.outline.inner:
        first = loop.segments[0]
        if loop.is_circle and isinstance(first, Arc) and falls_short(2 * first.radius, least):
            small.setdefault(round(2 * first.radius, 4), []).append(first.centre)
    for diameter, centres in small.items():
        x, y = centres[0]
        yield _error(
            "cut.hole",
            "cut.small_holes",
            f"{cut.part.name}: {_count(len(centres))} of {diameter:g} mm, one at ({x:.2f}, {y:.2f}), "
            f"below the least of {process.words}, {least:g} mm in {cut.part.thickness:g} mm",
            diameter,
            least,
            'set cut.small_holes = "spot": they are marked with a cross, and drilled',
            {"cut.small_holes": "spot"},
        )


def _count(number: int) -> str:
    return "one hole" if number == 1 else f"{number} holes"


def _webs(cut: CutPart, process: Process) -> Iterator[Finding]:
    least = process.least_web(cut.part.thickness)
    rings = [shapely.LinearRing(loop.flatten()) for loop in cut.outline.loops]
    webs = [(float(shapely.distance(one, two)), one, two) for one, two in combinations(rings, 2)]
    thin = [web for web in webs if web[0] < least - TOLERANCES.outline]
    if thin:
        off, one, two = min(thin, key=lambda web: web[0])
        x, y = shapely.shortest_line(one, two).coords[0]
        yield Finding.warning(
            "cut.web",
            "",
            f"{cut.part.name}: {off:.2f} mm stay between two cuts at ({x:.2f}, {y:.2f}); {process.words} "
            f"wants {least:g} mm in {cut.part.thickness:g} mm",
            off,
            least,
            "mm",
            "move the opening, or take a thinner sheet",
            Stage.MACHINING,
        )


def _sharpest(cut: CutPart, process: Process, kerf: float) -> float:
    """The most that stays in an inside corner, mm: R(1/sin(a/2) - 1) of one of the angle a; 0 below FELT."""
    radius = max(process.corner, kerf / 2)
    shape = cut.outline.polygon()
    closed = shapely.buffer(shapely.buffer(shape, radius, quad_segs=32), -radius, quad_segs=32)
    parts = shapely.get_parts(shapely.difference(closed, shape))
    # A corner that keeps d has an area above d²; the rest is rounding along arcs.
    rest = [one for one in parts[shapely.area(parts) > FELT**2 / 2] if not _is_opening(one, shape)]
    if not rest:
        return 0.0
    ends = shapely.points(shapely.get_coordinates(rest))
    return float(shapely.distance(ends, shapely.boundary(closed)).max())


def _is_opening(rest: shapely.Polygon, shape: shapely.Polygon) -> bool:
    """Whether it is all of an opening: one that is too small for the beam is a matter of least holes."""
    inside = shapely.Polygon(rest.exterior).representative_point()
    holes = [shapely.Polygon(ring) for ring in shape.interiors]
    return any(shapely.covers(one, inside) and rest.area > WHOLE * one.area for one in holes)


def _corners(cut: CutPart, process: Process, kerf: float) -> Iterator[Finding]:
    radius, deep = max(process.corner, kerf / 2), _sharpest(cut, process, kerf)
    if deep > FELT:
        yield Finding.warning(
            "cut.corner",
            "",
            f"{cut.part.name}: inside corners keep a radius of {radius:g} mm by {process.words}; the "
            f"sharpest keeps {deep:.2f} mm",
            deep,
            FELT,
            "mm",
            "file the corner, or draw it round",
            Stage.MACHINING,
        )


def _fits(part: Part, process: Process, settings: CutSettings) -> Iterator[Finding]:
    soft = material(part.material).soft
    for bore in fitted_bores(part).values():
        if keeps_limits(process, bore) or bore.fit is None:
            continue
        width = bore.fit.upper - bore.fit.lower
        said = (
            f"{part.name}: {bore.name} is {bore.fit.text}, and {process.words} holds ± {process.holes:g} mm"
        )
        if settings.fits == "refuse":
            yield _error(
                "cut.fit",
                "cut.fits",
                said,
                width,
                2 * process.holes,
                'set cut.fits = "ream"',
                {"cut.fits": "ream"},
            )
        elif soft and bore.fit.upper <= 0 and settings.fits == "ream":
            yield _error(
                "cut.press-fit",
                "cut.fits",
                f"{part.name}: {bore.name} is {bore.fit.text}; a pin pressed into {part.material} cracks it",
                bore.fit.upper,
                0.0,
                'set cut.fits = "bush"',
                {"cut.fits": "bush"},
            )
        else:
            how = "is cut for a bush" if settings.fits == "bush" else "is cut small and reamed"
            yield Finding.note("cut.fit", f"{said}; it {how}", width, "mm")
