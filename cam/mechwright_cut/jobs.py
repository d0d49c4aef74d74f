"""What is cut out of one sheet: copies of parts that are alike in process, material and thickness.

A part is cut as its outline, but for holes that are made larger afterwards, or drilled.
"""

import math
from dataclasses import dataclass
from functools import cached_property

import shapely

from mechwright.contracts.details import Chamfer, Engraving, Thread
from mechwright.contracts.part import Bore, Part, Pocket, Profile
from mechwright.geometry import Arc, Loop, Outline, circle
from mechwright.geometry.segments import Point
from mechwright.tolerances import TOLERANCES
from mechwright_cut.settings.cut_settings import CutSettings
from mechwright_cut.settings.figures import Kerf, Process, heat_of

PIERCE = 1.5
"""A pierce stays so many kerfs off every wall: it is wider than the cut."""
BESIDE = 1.5
"""The start hole of a wire keeps so far off the contour, mm: it is drilled, and may be off its place."""
LEAST_LEAD = 1.0
"""Least radius of a lead by default, mm."""
MARK = 1.0
"""Half the length of the strokes of a cross that marks a hole, mm."""


@dataclass(frozen=True)
class CutPart:
    """A part as it is cut through.

    Parameters
    ----------
    part
        As drawn.
    outline
        As it is cut.
    finishing
        What is done afterwards, each in a few words.
    spots
        Centres of holes that are marked and drilled, mm.
    """

    part: Part
    outline: Outline
    finishing: tuple[str, ...] = ()
    spots: tuple[Point, ...] = ()

    @property
    def strokes(self) -> list[tuple[Point, ...]]:
        """Polylines that are engraved: marks, and crosses of holes to drill."""
        found = [s for d in self.part.details if isinstance(d, Engraving) for s in d.strokes]
        for x, y in self.spots:
            found += [((x - MARK, y), (x + MARK, y)), ((x, y - MARK), (x, y + MARK))]
        return found


@dataclass(frozen=True)
class CutPiece:
    """One copy on the sheet: turned by ``angle``, rad, then moved, mm."""

    cut: CutPart
    label: str
    x: float
    y: float
    angle: float

    @cached_property
    def outline(self) -> Outline:
        """Where it lies on the sheet."""
        return self.cut.outline.moved(self.x, self.y, self.angle)

    @cached_property
    def strokes(self) -> list[list[Point]]:
        """What is engraved on it, where it lies on the sheet."""
        c, s = math.cos(self.angle), math.sin(self.angle)
        return [
            [(c * x - s * y + self.x, s * x + c * y + self.y) for x, y in stroke]
            for stroke in self.cut.strokes
        ]


@dataclass(frozen=True)
class CommonLine:
    """An edge that two pieces share: their numbers, and how far it is the edge of each, mm.

    Both stretches lie on the middle of the kerf; the line is the longer one, which has the other in it.
    """

    pieces: tuple[int, int]
    stretches: tuple[tuple[Point, Point], tuple[Point, Point]]

    @property
    def whole(self) -> tuple[Point, Point]:
        """The ends of the line."""
        return max(self.stretches, key=lambda ends: round(math.dist(*ends), 6))

    def of(self, piece: int) -> tuple[Point, Point]:
        """The stretch of one of the two pieces."""
        return self.stretches[self.pieces.index(piece)]


@dataclass(frozen=True)
class CutJob:
    """One sheet."""

    name: str
    process: Process
    material: str
    thickness: float
    kerf: Kerf
    settings: CutSettings
    pieces: tuple[CutPiece, ...]
    common: tuple[CommonLine, ...] = ()

    @property
    def size(self) -> tuple[float, float]:
        """Of the sheet, mm; its lower left corner is X0 Y0."""
        return self.settings.sheet.length, self.settings.sheet.width


def fitted_bores(part: Part) -> dict[int, Bore]:
    """Number of an opening of the outline to the bore with a fit that it is."""
    found: dict[int, Bore] = {}
    for number, loop in enumerate(part.outline.inner if part.outline else ()):
        arc = loop.segments[0]
        if loop.is_circle and isinstance(arc, Arc):
            for bore in part.features:
                if isinstance(bore, Bore) and math.dist(bore.centre, arc.centre) <= TOLERANCES.closure:
                    found |= {number: bore} if bore.fit else {}
    return found


def keeps_limits(process: Process, bore: Bore) -> bool:
    """Whether a process keeps the limits of a hole's fit."""
    return bore.fit is not None and bore.fit.upper - bore.fit.lower >= 2 * process.holes - TOLERANCES.slack


def cut_part(part: Part, process: Process, settings: CutSettings, *, marks: bool | None = None) -> CutPart:
    """The part as a process cuts it, with what is done afterwards.

    ``marks`` says whether marks are cut; by default whether the process can.
    """
    assert part.outline is not None  # noqa: S101 - plates alone are cut
    marks = process.engraves if marks is None else marks
    fits, inner, spots, after = fitted_bores(part), [], [], list[str]()
    for number, loop in enumerate(part.outline.inner):
        arc = loop.segments[0]
        if not (loop.is_circle and isinstance(arc, Arc)):
            inner.append(loop)
            continue
        bore = fits.get(number)
        diameter, finish = _cut_diameter(2 * arc.radius, bore, process, settings)
        name = "a hole" if bore is None else bore.name
        if diameter < process.least_hole(part.thickness) and settings.small_holes == "spot":
            cross = ", where a cross marks it" if marks else ""
            drilled = f"drill {name} of {diameter:g} mm at {_place(arc.centre)}{cross}"
            after.append(f"{drilled}, and {finish}" if finish else drilled)
            spots += [arc.centre] if marks else []
            continue
        if finish:
            after.append(f"{finish}: {name} at {_place(arc.centre)}")
        if diameter != 2 * arc.radius:
            loop = Loop((circle(arc.centre, diameter / 2, clockwise=True),))
        inner.append(loop)
    for detail in part.details:
        if isinstance(detail, Thread):
            after.append(f"tap {detail.designation} at {_place(detail.centre)}")
        elif isinstance(detail, Chamfer):
            after.append(f"break the edge {detail.name}: {detail.width:g} mm x 45°")
        elif not marks:
            after.append(f"mark {detail.name} by hand")
    outline = Outline(part.outline.outer, tuple(inner), part.outline.deviation)
    heat = heat_of(process.name, part.material, after)
    steps = after if heat is None else [heat.step, *after]
    return CutPart(part, outline, tuple(steps), tuple(spots))


def _cut_diameter(
    diameter: float, bore: Bore | None, process: Process, settings: CutSettings
) -> tuple[float, str]:
    """How wide a round hole is cut, mm, and what makes its fit afterwards; empty where nothing has to."""
    if bore is None or bore.fit is None or keeps_limits(process, bore):
        return diameter, ""
    if settings.fits == "bush":
        wide = round(bore.fit.size + 2 * settings.bush, 3)
        return wide, f"bond a bush of {wide:g} x {bore.fit.text}"
    return round(bore.diameter - process.pilot, 3), f"ream to {bore.fit.text}"


def _place(point: Point) -> str:
    """A place on the part, mm.

    >>> _place((-0.0001, 7.638))
    '(0, 7.638)'
    """
    x, y = (round(value, 3) + 0.0 for value in point)
    return f"({x:g}, {y:g})"


def recesses(part: Part) -> list[str]:
    """Names of what does not go through the plate: no beam makes it."""
    return [
        one.name
        for one in part.features
        if (isinstance(one, Pocket) or one.top > TOLERANCES.closure or one.depth < part.thickness - 1e-6)
        and isinstance(one, Pocket | Bore | Profile)
    ]


def lead_radius(settings: CutSettings, kerf: float) -> float:
    """Radius of leads, mm."""
    return settings.lead or max(2 * kerf, LEAST_LEAD)


def gap_of(settings: CutSettings, kerf: Kerf, process: Process, thickness: float) -> float:
    """Least distance between two parts, mm: a web between the kerfs, or room for a pierce."""
    if settings.sheet.gap is not None:
        return settings.sheet.gap
    if process.name == "wire":
        return round(settings.start_hole + 2 * BESIDE + 1, 2)
    lead = lead_radius(settings, kerf.width) + PIERCE * kerf.width + kerf.width
    return round(max(process.least_web(thickness) + 2 * kerf.width, 2 * lead), 2)


def target(piece: CutPiece) -> shapely.Polygon:
    """The piece as a polygon on the sheet, within the flattening tolerance."""
    return piece.outline.polygon()
