"""A locating and a free bearing: the lower one holds its shaft both ways, the upper one slides in its seat.

Glossary
--------
locating bearing
    Both of its rings are held both ways. Its outer ring is clamped between the shoulder of its seat and a
    retainer, its inner ring lies between the shoulder of the shaft and a circlip.
free bearing
    Its inner ring is held the same way. Its outer ring slides in a seat that is deeper than the bearing.
retainer
    A ring of plate over the locating bearing, screwed to the bearing plate. The bearing stands proud of the
    plate, so that the retainer bears on its outer ring and never on the plate.
"""

import math
from dataclasses import replace

from mechwright.contracts.holes import threaded
from mechwright.contracts.materials import material
from mechwright.contracts.part import Bore, Feature, Part, Profile
from mechwright.contracts.surroundings import Place
from mechwright.contracts.turned import Groove, Length, Turned
from mechwright.errors import DesignError
from mechwright.geometry import Loop, Outline, circle
from mechwright.geometry.segments import Point
from mechwright.machine.frame.kit import PLATE, Kit
from mechwright.machine.frame.shim_rings import add_shim
from mechwright.standards.bearings import Bearing
from mechwright.standards.circlips import Circlip, shaft_circlip
from mechwright.standards.screws import least_engaged, screw, screw_size
from mechwright.standards.shims import Shim, shim_on

RETAINER = 3.0
"""Thickness of a retainer, mm: the least plate that is sold in all materials."""

SCREW, SCREWS = 3.0, 3
"""Thread of its screws, mm, and their number."""

BESIDE, RIM = 1.5, 1.0
"""Wall between a bearing's seat and the threads beside it, and of a retainer beside its heads, mm."""

RETAINER_THREAD = 7.0
"""Depth of the holes for these screws in the plate, mm; their thread ends a pitch before."""

APART = 1.0
"""Between retainers of neighbouring shafts, mm."""

PROUD = 0.05
"""By how much the narrowest bearing in the middle of its seat's depth stands out of the plate, mm: the seat
may be 0.025 mm deeper."""

FREE = 1.3
"""Between an outer ring that slides and either end of its seat, mm."""

LEAST_WAY, WARMER = 0.5, 40.0
"""What is left of it at the worst, mm, and by how much a shaft may be warmer than its frame, K."""

WALL = (0.0, 0.1)
"""Limit deviations of a length to the loaded wall of a groove, mm."""

BELOW, ABOVE = "shoulder to the lower loaded wall", "shoulder to the upper loaded wall"
"""Names of the lengths from the shoulders of a shaft to the grooves beyond its bearings."""

BACKED = 0.1
"""Least play of an inner ring under its circlip before rings are put in, mm."""

DRAWN_RING = 0.1
"""Thickness of the shim ring under the circlip of a locating bearing for which a frame is drawn, mm."""

LAND = 1.7
"""By how much a shaft goes on beyond a groove at its end at least, mm: its chamfer leaves a wall."""

TURNS_FREE = 0.5
"""Between a circlip that turns with its shaft and the hole that it turns in, mm."""


def proud(bearing: Bearing) -> float:
    """By how much a bearing of nominal width stands out of its seat, mm."""
    return round(bearing.narrower + PROUD, 6)


def bolt_circle(bearing: Bearing) -> float:
    """Diameter on which the screws of a retainer stand, mm."""
    return bearing.outside + SCREW + 2 * BESIDE


def retainer_diameter(bearing: Bearing) -> float:
    """Outside of a retainer, mm.

    >>> from mechwright.standards.bearings import bearing
    >>> bolt_circle(bearing("6000")), retainer_diameter(bearing("6000"))
    (32.0, 39.5)
    """
    return bolt_circle(bearing) + screw_size(SCREW).head + 2 * RIM


def height_over(bearings: list[Bearing]) -> float:
    """Of retainers with the heads of their screws over the plate, mm."""
    return RETAINER + screw_size(SCREW).head_height + max(proud(one) for one in bearings)


def circlip_of(bearing: Bearing) -> Circlip:
    """The circlip behind the inner ring of a bearing; raises DesignError where there is none."""
    return shaft_circlip(bearing.bore)


def has_room(bearing: Bearing) -> bool:
    """Whether a circlip on a bearing's shaft turns freely in the hole through the shoulder of its seat."""
    try:
        return circlip_of(bearing).room + 2 * TURNS_FREE <= bearing.abutment
    except DesignError:
        return False


def inner_shim(bearing: Bearing) -> Shim | None:
    """The ring between an inner ring and its circlip, clear of the outer ring; None where none is sold."""
    return shim_on(bearing.bore, (bearing.bore + bearing.outside) / 2)


def drawn_ring(bearing: Bearing) -> float:
    """Thickness of the shim ring that is drawn behind the inner ring of a locating bearing, mm."""
    return DRAWN_RING if inner_shim(bearing) is not None else 0.0


def loaded_wall(bearing: Bearing, ring: float) -> float:
    """From the shoulder that an inner ring leans on to the loaded wall of its circlip's groove, mm."""
    return bearing.width + ring + circlip_of(bearing).thickness + BACKED


def overhang(bearing: Bearing, ring: float) -> float:
    """By how much a journal goes on beyond its bearing for the circlip and its edge, mm."""
    return loaded_wall(bearing, ring) - bearing.width + max(circlip_of(bearing).edge, LAND)


def circlip_heights(bearing: Bearing, shoulders: tuple[float, float]) -> tuple[float, float]:
    """Of the undersides of both circlips of a shaft, mm, by the heights of its shoulders."""
    low, high = shoulders
    return low - loaded_wall(bearing, drawn_ring(bearing)) + BACKED, high + bearing.width


def with_bearing_circlips(
    kit: Kit, shaft: Turned, bearing: Bearing, body: str, shoulders: tuple[float, float], foot: float
) -> Turned:
    """The shaft with grooves beyond both bearings; their rings go into the kit.

    ``shoulders`` are the heights of both shoulders, ``foot`` that of the lower end, mm.
    """
    ring, shim, (low, high) = circlip_of(bearing), inner_shim(bearing), shoulders
    drawn = drawn_ring(bearing)
    walls = low - loaded_wall(bearing, drawn), high + loaded_wall(bearing, 0.0)
    for at in circlip_heights(bearing, shoulders):
        kit.bought(ring.part_name, ring.bought, body, at)
    if shim is not None:
        add_shim(kit, shim, drawn, body, low - bearing.width - drawn, on_shaft=True)
    starts = walls[0] - foot, walls[1] - ring.width - foot
    return replace(
        shaft,
        grooves=(
            *shaft.grooves,
            *(Groove(start, ring.width, ring.groove, ring.tolerance) for start in starts),
        ),
        lengths=(
            *shaft.lengths,
            Length(BELOW, walls[0] - foot, low - foot, *WALL),
            Length(ABOVE, high - foot, walls[1] - foot, *WALL),
        ),
    )


def thermal_way(height: float) -> float:
    """By how much a shaft of steel grows between two bearings so far apart when it warms up, mm.

    >>> round(thermal_way(100.0), 3)
    0.046
    """
    return material("steel").expansion * 1e-6 * height * WARMER


def retainer_places(bearing: Bearing) -> list[Point]:
    """Where the screws of a retainer stand about its axis, mm."""
    radius, turns = bolt_circle(bearing) / 2, (math.pi / 2 + math.tau * k / SCREWS for k in range(SCREWS))
    return [(round(radius * math.cos(turn), 6), round(radius * math.sin(turn), 6)) for turn in turns]


def add_retainer(kit: Kit, bearing: Bearing, spindle: str, centre: Point, level: float, plate: str) -> None:
    """The retainer on a bearing that stands out of a plate whose face is at ``level``, mm, and its screws."""
    size, low = screw_size(SCREW), level + proud(bearing)
    holes = [
        Bore(f"screw-{k}", place, size.clearance(), 0.0, RETAINER)
        for k, place in enumerate(retainer_places(bearing), start=1)
    ]
    middle = Bore("opening", (0.0, 0.0), bearing.abutment, 0.0, RETAINER)
    rim = Loop((circle((0.0, 0.0), retainer_diameter(bearing) / 2),))
    inner = [Loop((circle(one.centre, one.diameter / 2, clockwise=True),)) for one in (middle, *holes)]
    outline = Outline(rim, tuple(inner))
    cut: tuple[Feature, ...] = (middle, *holes, Profile("outside", rim, "outside", 0.0, RETAINER))
    name, body = f"retainer-{bearing.outside:g}", f"retainer-{spindle}"
    kit.places[body] = Place((*centre, 0.0))
    of = kit.parts[plate].material
    gap = proud(bearing)
    kit.put(Part(name, outline, RETAINER, of, colour=PLATE, machined=cut, play=gap), body, low)
    found = screw(SCREW, RETAINER + proud(bearing) + least_engaged(of) * SCREW)
    for k, hole in enumerate(holes, start=1):
        kit.parts[plate] = threaded(kit.parts[plate], f"retainer-{spindle}-{k}", f"M{SCREW:g}")
        at = f"{body}-screw-{k}"
        kit.places[at] = Place((centre[0] + hole.centre[0], centre[1] + hole.centre[1], 0.0))
        kit.bought(f"screw-m{SCREW:g}x{found.length:g}", found.bought, at, low + RETAINER)
