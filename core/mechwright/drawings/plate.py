"""A plate part of what a drawing shows."""

import math
from collections.abc import Sequence
from dataclasses import dataclass, replace

import shapely

from mechwright.contracts.details import Detail, Thread, moved
from mechwright.contracts.part import Bore, Feature, Instance, Part, Pocket, Profile
from mechwright.contracts.threads import named
from mechwright.drawings.asked import Asked
from mechwright.drawings.contours import Contour
from mechwright.drawings.drilled import Hole, bore, circles, coaxial, sized, threads
from mechwright.drawings.edged import chamfers, engraving
from mechwright.drawings.fault import at
from mechwright.drawings.meaning import Meaning
from mechwright.drawings.nesting import lies_in, openings_of, outline_of
from mechwright.drawings.reading import Drawn
from mechwright.drawings.recessed import Recess, recesses, stacked
from mechwright.drawings.strokes import FITTED
from mechwright.errors import GeometryError
from mechwright.geometry import Loop, Outline, circle
from mechwright.geometry.segments import Point
from mechwright.standards.screw_holes import seated
from mechwright.tolerances import TOLERANCES

SAME_RIM = 0.3
"""A thread's circle that is no more than this narrower than an island is that of its rim, mm."""


@dataclass(frozen=True)
class Cut:
    """How a plate is to be cut of its drawing."""

    name: str
    thickness: float
    material: str
    instances: tuple[Instance, ...] = ()


def part_of(drawn: Drawn, asked: Asked, cut: Cut) -> Part | None:
    """The part; None where the drawing has faults, which say why."""
    told = drawn.told
    if told.faults:
        return None
    maker = _Maker(drawn, asked, cut)
    try:
        part = maker.part()
    except GeometryError as error:
        told.fault("feature", f"the plate cannot be made: {error}", "change the drawing there")
        return None
    return None if told.faults else part


class _Maker:
    def __init__(self, drawn: Drawn, asked: Asked, cut: Cut) -> None:
        self.drawn, self.asked, self.cut, self.told = drawn, asked, cut, drawn.told

    def _of(self, *kinds: str) -> list[tuple[Meaning, list[Contour]]]:
        return [(meant, some) for meant, some in self.drawn.contours.items() if meant.kind in kinds]

    def part(self) -> Part | None:
        """The part as far as no fault is found."""
        outline = [one for _, some in self._of("outline") for one in some]
        through = [one for _, some in self._of("through") for one in some]
        plate = outline_of(outline, through, self.told)
        if plate is None or self.told.faults:
            return None
        rest = [one for one in (*outline, *through) if one is not plate]
        holes, openings = self._holes(rest)
        found = [one for meant, some in self._of("pocket") for one in recesses(meant, some, self.told)]
        stacked(found, self.cut.thickness, plate, self.told)
        if self.told.faults:
            return None
        return self._made(plate, holes, openings, found)

    def _holes(self, rest: Sequence[Contour]) -> tuple[list[Hole], list[Contour]]:
        """Round holes, and the openings that are not round."""
        told = self.told
        plain = Meaning("bore")
        said = [
            hole
            for kind in ("bore", "screw")
            for meant, some in self._of(kind)
            for hole in circles(meant, some, told)
        ]
        cut = [hole for meant, some in self.drawn.strokes.items() if meant.kind == "thread"
               for hole in threads(meant, some, told)]  # fmt: skip
        round_ = [
            Hole(one.circle.centre, 2 * one.circle.radius, plain, one.name) for one in rest if one.circle
        ]
        holes = sized(self._once([*round_, *said, *cut]), self.asked, told)
        openings = [one for one in rest if not one.circle]
        return holes, openings

    def _once(self, holes: Sequence[Hole]) -> list[Hole]:
        """One hole about each axis: what is drawn as a bore and as a thread, or a fit, is that."""
        found: list[Hole] = []
        for hole in holes:
            twin = next((k for k, one in enumerate(found) if coaxial(one, hole.centre)), None)
            if twin is None:
                found.append(hole)
                continue
            other = found[twin]
            same = abs(hole.diameter - other.diameter) <= 2 * TOLERANCES.outline
            if hole.meant.kind == "thread" and not other.meant.thread and not other.meant.fit:
                # The narrower circle is the core, the other the thread's nominal one.
                size = min(hole.diameter, other.diameter)
                bored = math.inf if other.meant.depth is None else other.meant.depth
                found[twin] = Hole(hole.centre, size, _deep(hole.meant, other.meant), hole.name, bored)
            elif hole.meant.kind == "screw" and hole.meant == other.meant:
                found[twin] = min(hole, other, key=lambda one: one.diameter)  # shank and head are one hole
            elif _stepped(hole, other):
                found.append(hole)
            elif same and (not other.meant.fit or other.meant == hole.meant):
                found[twin] = hole
            else:
                self.told.fault(
                    "feature",
                    f"the circles of {hole.name} and {other.name} are of two holes about one axis",
                    "draw the wider one as a pocket, on a layer such as POCKET_3",
                )
        return found

    def _made(
        self, plate: Contour, holes: Sequence[Hole], openings: Sequence[Contour], found: Sequence[Recess]
    ) -> Part | None:
        told, deep = self.told, self.cut.thickness
        features: list[Feature] = []
        details: list[Detail] = []
        inner: list[Loop] = []
        rim = plate.shape
        shapes = [(one, one.shape) for one in found]
        placed = sorted(holes, key=lambda hole: (round(hole.centre[0], 3), round(hole.centre[1], 3)))
        for number, hole in enumerate(placed, start=1):
            disc = shapely.Point(hole.centre).buffer(hole.diameter / 2, quad_segs=64)
            if not lies_in(disc, rim):
                told.fault("contour", f"the hole of {hole.name} reaches out of the plate", "draw an opening")
            self._inside(hole, found)
            made = bore(hole, f"bore-{number}", deep, told)
            if made is None:
                continue
            drilled, thread = made
            drilled = self._sunk(
                drilled,
                thread,
                [
                    *self._floors(hole, holes),
                    *(one.depth for one, shape in shapes if not one.meant.top and lies_in(disc, shape)),
                ],
            )
            features.append(drilled)
            if thread is not None:
                details.append(thread)
            if drilled.top + drilled.depth >= deep - TOLERANCES.closure:
                inner.append(Loop((circle(drilled.centre, drilled.diameter / 2, clockwise=True),)))
        through = [Contour(loop.reversed(), plate.stroke) for loop in inner]
        openings_of([*openings, *through], told)
        for number, opening in enumerate(_sorted(openings), start=1):
            loop = opening.loop.reversed()
            inner.append(loop)
            features.append(Profile(f"opening-{number}", loop, "inside", 0.0, deep))
        features += self._recesses(found)
        features.append(Profile("outside", plate.loop, "outside", 0.0, deep))
        if told.faults:
            return None
        rounded = any(
            stroke.kind in {"ELLIPSE", "SPLINE"}
            for some in self.drawn.contours.values()
            for stroke in (one.stroke for one in some)
        )
        outline = Outline(plate.loop, tuple(inner), FITTED if rounded else 0.0)
        part = Part(
            self.cut.name, outline, deep, self.cut.material, self.cut.instances, machined=tuple(features)
        )
        details += self._details(part, plate)
        whole = self._placed(outline, features, details)
        for number, hole in enumerate(placed, start=1):
            if hole.meant.kind == "screw":
                whole = self._seated(whole, f"bore-{number}", hole)
        return None if told.faults else whole

    def _seated(self, part: Part, name: str, hole: Hole) -> Part:
        try:
            return seated(part, name, hole.meant.screw)
        except GeometryError as error:
            self.told.fault(
                "feature",
                f"the hole of {hole.name} at {at(hole.centre)}: {error}",
                "say another screw, or a bore",
            )
            return part

    def _sunk(self, drilled: Bore, thread: Thread | None, floors: Sequence[float]) -> Bore:
        """The bore, from the floor of the recess that it stands in on."""
        if not floors or drilled.top:
            return drilled
        top = max(floors)
        bottom = drilled.top + drilled.depth
        if bottom <= top:
            self.told.fault(
                "feature",
                f"the bore at {at(drilled.centre)} is {bottom:g} mm deep, in a recess of {top:g} mm",
                "depths count from the top face; make it deeper",
            )
            return drilled
        if thread is not None:
            self.told.fault(
                "feature",
                f"the thread at {at(drilled.centre)} stands in a recess; threads start at the top face",
                "thread it by hand, and draw a bore",
            )
        return replace(drilled, top=top, depth=bottom - top)

    def _inside(self, hole: Hole, found: Sequence[Recess]) -> None:
        """A fault for the thread of a boss: its circle is the rim of an island."""
        islands = [one.circle for recess in found for one in recess.islands]
        rims = [arc for arc in islands if arc is not None and coaxial(hole, arc.centre)]
        if hole.meant.kind == "thread" and any(hole.diameter >= 2 * arc.radius - SAME_RIM for arc in rims):
            self.told.fault(
                "feature",
                f"{hole.meant.thread} at {at(hole.centre)} is drawn round an island, an external thread; "
                "plates have threads in holes only",
                "screw a stud into a threaded hole, or cut it with a die and give its layer no thread",
            )

    def _floors(self, hole: Hole, holes: Sequence[Hole]) -> list[float]:
        """Depths of the wider blind bores about the axis of a hole."""
        return [
            one.meant.depth
            for one in holes
            if coaxial(one, hole.centre)
            and one.diameter > hole.diameter
            and one.meant.depth
            and not one.meant.top
        ]

    def _recesses(self, found: Sequence[Recess]) -> list[Feature]:
        made: list[Feature] = []
        order = sorted(found, key=lambda one: (one.top, *_corner(one.outer)))
        for number, one in enumerate(order, start=1):
            depth = round(one.depth - one.top, 9)
            arc = one.outer.circle
            if arc is not None and not one.islands and not one.meant.floor_radius:
                made.append(Bore(f"recess-{number}", arc.centre, 2 * arc.radius, one.top, depth))
                continue
            islands = tuple(island.loop.reversed() for island in one.islands)
            made.append(
                Pocket(f"pocket-{number}", one.outer.loop, islands, one.top, depth, one.meant.floor_radius)
            )
        return made

    def _details(self, part: Part, plate: Contour) -> list[Detail]:
        made: list[Detail] = []
        for meant, some in self._of("chamfer"):
            made += chamfers(part, meant, some, self.told)
        lines = [(meant, some) for meant, some in self.drawn.strokes.items() if meant.kind == "engrave"]
        for number, (meant, strokes) in enumerate(lines, start=1):
            name = f"engraving-{number}"
            done = engraving(name, meant, strokes, plate, self.cut.thickness, self.told)
            if done is not None:
                made.append(done)
        return made

    def _placed(self, outline: Outline, features: Sequence[Feature], details: Sequence[Detail]) -> Part:
        """The part with its origin where it is asked for."""
        x, y = self._shift(outline)
        return Part(
            self.cut.name,
            outline.moved(x, y),
            self.cut.thickness,
            self.cut.material,
            self.cut.instances,
            machined=tuple(_moved(feature, x, y) for feature in features),
            details=tuple(moved(detail, x, y) for detail in details),
        )

    def _shift(self, outline: Outline) -> Point:
        x0, y0, x1, y1 = outline.bounds
        match self.asked.origin:
            case "corner":
                return -x0, -y0
            case "centre":
                return -(x0 + x1) / 2, -(y0 + y1) / 2
        return 0.0, 0.0


def _deep(meant: Meaning, bore: Meaning) -> Meaning:
    """A thread in a bore that is drawn: as deep as it says, or one pitch less than a blind bore."""
    if meant.depth is not None or bore.depth is None:
        return meant
    return replace(meant, depth=bore.depth - named(meant.thread).pitch)


def _stepped(one: Hole, two: Hole) -> bool:
    """Whether two holes about one axis are a stepped bore: the wider one is less deep."""
    wide, narrow = (one, two) if one.diameter > two.diameter else (two, one)
    deep = math.inf if narrow.meant.depth is None else narrow.meant.depth
    if wide.meant.top:  # from below
        return wide.diameter > narrow.diameter
    return wide.diameter > narrow.diameter and wide.meant.depth is not None and wide.meant.depth < deep


def _corner(contour: Contour) -> Point:
    x0, y0, _, _ = contour.loop.bounds
    return round(x0, 3), round(y0, 3)


def _sorted(contours: Sequence[Contour]) -> list[Contour]:
    return sorted(contours, key=_corner)


def _moved(feature: Feature, x: float, y: float) -> Feature:
    match feature:
        case Bore():
            return replace(feature, centre=(feature.centre[0] + x, feature.centre[1] + y))
        case Profile():
            return replace(feature, loop=feature.loop.moved(x, y))
        case _:
            islands = tuple(island.moved(x, y) for island in feature.islands)
            return replace(feature, boundary=feature.boundary.moved(x, y), islands=islands)
