"""Details of a plate that its shape does not show: broken edges, threads, engraved marks.

They are cut into the top face when the shape is made. Solids show chamfers as they are, engravings as curves
and threads as circles on the top face; drawings show lines and a note. Depths are measured downwards from the
top face.
"""

import math
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING, Literal

from mechwright.errors import GeometryError
from mechwright.geometry import Loop
from mechwright.geometry.parallel import MITRE, Parallel
from mechwright.geometry.segments import Point
from mechwright.tolerances import TOLERANCES

if TYPE_CHECKING:
    import shapely


CORE_PLAY = 0.25
"""By how much, in pitches, a hole may miss the core diameter of its thread: ISO 965's tolerance, roughly."""


@dataclass(frozen=True)
class Chamfer:
    """A top edge broken at 45 degrees; a few tenths of ``width`` deburr it.

    ``side`` says where the cutter runs, as for a Profile: outside of a part's rim, inside of an opening.
    """

    name: str
    loop: Loop
    side: Literal["outside", "inside"]
    width: float

    def __post_init__(self) -> None:
        if not self.width > 0:
            raise GeometryError(f"chamfer {self.name} needs a width above 0 mm, not {self.width}")


@dataclass(frozen=True)
class Thread:
    """An internal thread with a profile of 60° in a Bore of its core diameter, from the top face on.

    ``diameter`` is the nominal one (M6: 6), ``depth`` that of the last full turn. A ``left`` one turns to the
    left. ``inch`` names a unified one, such as ``"1/4-20 UNC"``; empty for a metric one.
    """

    name: str
    centre: Point
    diameter: float
    pitch: float
    depth: float
    left: bool = False
    inch: str = ""

    def __post_init__(self) -> None:
        if not 0 < self.pitch < self.diameter / 2:
            raise GeometryError(
                f"thread {self.name}: the pitch is {self.pitch} mm, not 0 to {self.diameter / 2:g}"
            )

    @property
    def designation(self) -> str:
        """Nominal diameter and pitch as ISO 261 writes them, or as a unified thread is called.

        >>> Thread("t", (0, 0), 6.0, 1.0, 8.0).designation
        'M6x1'
        >>> Thread("t", (0, 0), 6.35, 1.27, 8.0, left=True, inch="1/4-20 UNC").designation
        '1/4-20 UNC LH'
        """
        return (self.inch or f"M{self.diameter:g}x{self.pitch:g}") + (" LH" if self.left else "")

    @property
    def core(self) -> float:
        """Diameter of the hole to be threaded, mm: D - 1.0825 P (ISO 724, D1; ASME B1.1 alike)."""
        return self.diameter - 1.0825 * self.pitch


@dataclass(frozen=True)
class Engraving:
    """Lines engraved ``depth`` mm deep, at most ``width`` mm wide at the top; strokes are polylines."""

    name: str
    strokes: tuple[tuple[Point, ...], ...]
    depth: float
    width: float = 0.6

    def __post_init__(self) -> None:
        if not (self.depth > 0 and self.width > 0):
            raise GeometryError(f"engraving {self.name} needs a depth and a width above 0 mm")
        if not self.strokes or any(len(stroke) < 2 for stroke in self.strokes):
            raise GeometryError(f"engraving {self.name} needs strokes of two points or more")


Detail = Chamfer | Thread | Engraving


def moved(detail: Detail, x: float, y: float, angle: float = 0.0) -> Detail:
    """The detail turned about the origin, rad, then shifted, mm."""
    c, s = math.cos(angle), math.sin(angle)

    def at(point: Point) -> Point:
        return c * point[0] - s * point[1] + x, s * point[0] + c * point[1] + y

    match detail:
        case Chamfer():
            return Chamfer(detail.name, detail.loop.moved(x, y, angle), detail.side, detail.width)
        case Thread():
            return replace(detail, centre=at(detail.centre))
        case Engraving():
            strokes = tuple(tuple(at(point) for point in stroke) for stroke in detail.strokes)
            return Engraving(detail.name, strokes, detail.depth, detail.width)


def band_of(chamfer: Chamfer, depth: float, tolerance: float) -> "shapely.Geometry":
    """What a chamfer takes ``depth`` mm below the top face, seen from above: a band with mitred corners, mm.

    The depth is 0 to the chamfer's width, ``tolerance`` the chord error of the loop, mm; neighbours of the
    edge are not asked.

    >>> square = Loop.polygon([(0, 0), (10, 0), (10, 10), (0, 10)])
    >>> band_of(Chamfer("rim", square, "outside", 1.0), 0.0, 0.001).area  # 100 - 8 x 8
    36.0
    """
    import shapely

    region = shapely.Polygon(chamfer.loop.flatten(tolerance))
    width = max(chamfer.width - depth, 0.0)
    sign = -1 if chamfer.side == "outside" else 1
    moved = shapely.buffer(region, sign * width, join_style="mitre", mitre_limit=MITRE)
    return shapely.symmetric_difference(region, moved)


def chamfer_lines(chamfer: Chamfer) -> tuple[Loop, ...]:
    """Where a chamfer ends on the top face: one loop, segment by segment, as long as none of them vanishes.

    Where one does, loops of straight lines within the tolerance of polygons.

    Examples
    --------
    >>> square = Loop.polygon([(0, 0), (10, 0), (10, 10), (0, 10)])
    >>> (line,) = chamfer_lines(Chamfer("rim", square, "outside", 1.0))
    >>> round(line.area, 6)
    64.0
    """
    import shapely

    outside = chamfer.side == "outside"
    left = (chamfer.loop.area > 0) == outside
    try:
        return (Parallel(chamfer.loop, 1 if left else -1).at(chamfer.width),)
    except GeometryError:
        region = shapely.Polygon(chamfer.loop.flatten())
        taken = band_of(chamfer, 0.0, TOLERANCES.flatten)
        moved = shapely.difference(region, taken) if outside else shapely.union(region, taken)
        rings = shapely.get_rings(shapely.get_parts(shapely.simplify(moved, TOLERANCES.flatten)))
        return tuple(Loop.polygon(list(ring.coords)[:-1]) for ring in rings)


def detail_note(detail: Detail, thickness: float) -> str:
    """What a drawing says of a detail, as DXF writes degrees.

    >>> detail_note(Thread("hole", (0, 0), 6.0, 1.0, 8.0), 8.0)
    'hole: M6x1 through'
    """
    match detail:
        case Chamfer():
            return f"{detail.name}: {detail.width:g} x 45%%d"
        case Thread():
            deep = "through" if detail.depth >= thickness else f"{detail.depth:g} mm deep"
            return f"{detail.name}: {detail.designation} {deep}"
        case Engraving():
            return f"{detail.name}: engraved {detail.depth:g} mm deep, line {detail.width:g} mm"
