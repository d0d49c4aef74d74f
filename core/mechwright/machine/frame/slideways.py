"""Linear guides on the lower bearing plate: rail, carriage and their screws."""

from collections.abc import Iterator, Sequence
from dataclasses import replace

import shapely

from mechwright.contracts.fitting_marks import FittingMark
from mechwright.contracts.holes import threaded
from mechwright.contracts.on_plates import Slideway
from mechwright.contracts.surroundings import Place, turned
from mechwright.errors import DesignError
from mechwright.machine.frame.fixing import fixing, put_fixing
from mechwright.machine.frame.kit import Kit
from mechwright.machine.frame.pillars import put_screw
from mechwright.machine.frame.plates import Hole
from mechwright.machine.frame.seats import LEAST_WALL
from mechwright.machine.frame.standing import Disc
from mechwright.standards.screws import least_engaged, screw

BALLS = (
    "Push the carriage from the plastic bar on which it comes straight onto its rail, and never let it off: "
    "its balls fall out. Tighten the screws of the rail from its middle on, while the carriage runs freely."
)

DEPTH = 6.5
"""Of the holes under a rail, mm: deeper than its screws go, as deep as the mill of an M3 thread reaches."""


def floor_of(ways: Sequence[Slideway], needed: float) -> float:
    """Height of the plate on which rails lie, mm; raises DesignError where the plate has to be lower."""
    low = min(way.low for way in ways)
    if low > needed:
        way = ways[0]
        raise DesignError(
            f"{way.key}: the rail of {way.guide.name} lies at z = {low:g} mm, and the bearing plate has to "
            f"be at {needed:g} mm or below; take a larger guide, or a thinner cam"
        )
    return low


def region_of(way: Slideway) -> shapely.Geometry:
    """What rail and carriage take, seen from above."""
    half = way.guide.width / 2
    corners = ((0.0, -half), (way.guide.length, -half), (way.guide.length, half), (0.0, half))
    return shapely.Polygon([way.at(*corner) for corner in corners])


def rail_discs(way: Slideway) -> Iterator[Disc]:
    """What the plate has to hold of a rail: its holes and both ends."""
    for along in (0.0, *way.guide.holes, way.guide.length):
        yield Disc(way.at(along), way.guide.thread / 2 + LEAST_WALL)


def rail_holes(way: Slideway) -> list[Hole]:
    """Blind ones of the plate under a rail, which get threads."""
    return [
        Hole(_name(k), way.at(along), ((way.guide.thread, 0.0, DEPTH),))
        for k, along in enumerate(way.guide.holes, start=1)
    ]


def add_slideway(kit: Kit, way: Slideway, material: str) -> None:
    """Rail and carriage with their screws; the part ``lower-plate`` gets the threads of the rail."""
    guide, size = way.guide, way.guide.thread
    kit.places["guide-rail"] = Place((*way.start, 0.0), turned(way.angle))
    kit.bought("guide-rail", guide.rail, "guide-rail", way.low)
    kit.places["guide-carriage"] = Place((*way.carriage, 0.0), turned(way.angle), way.body)
    kit.bought("guide-carriage", guide.carriage, "guide-carriage", way.low)
    kit.parts["guide-carriage"] = replace(kit.parts["guide-carriage"], marks=(FittingMark(BALLS),))
    found = screw(size, guide.seat + least_engaged(material) * size)
    for k, along in enumerate(guide.holes, start=1):
        kit.parts["lower-plate"] = threaded(kit.parts["lower-plate"], _name(k), f"M{size:g}")
        kit.places[f"{_name(k)}-screw"] = Place((*way.at(along), 0.0))
        put_screw(kit, found, f"{_name(k)}-screw", way.low + guide.seat)
    held = fixing(size, way.grip, guide.depth)
    for k, place in enumerate(guide.carriage_holes, start=1):
        body = f"carriage-screw-{k}"
        kit.places[body] = Place((*_turned(way, place), 0.0), on=way.body)
        put_fixing(kit, held, body, way.low + guide.high + way.grip)


def _turned(way: Slideway, place: tuple[float, float]) -> tuple[float, float]:
    """A place of the carriage in the body's coordinates, mm; the body does not turn."""
    x, y = way.at(*place)
    return x - way.start[0] + way.carriage[0], y - way.start[1] + way.carriage[1]


def _name(number: int) -> str:
    return f"rail-{number}"
