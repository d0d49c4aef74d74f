"""The form of a part that is no plate, as plain numbers: what is turned about z, and upright prisms.

A shape can be compared, kept and sent to another process; the CAD kernel is imported when its solid is made.
"""

import math
from dataclasses import dataclass
from typing import TYPE_CHECKING

from mechwright.errors import GeometryError
from mechwright.geometry.segments import Point

if TYPE_CHECKING:
    import cadquery as cq


@dataclass(frozen=True)
class Revolve:
    """A closed profile with corners (r, z), mm, r at least 0, turned about an upright ``axis`` (x, y).

    The ``sweep`` is in degrees, from the direction of x on.
    """

    profile: tuple[Point, ...]
    axis: Point = (0.0, 0.0)
    sweep: float = 360.0

    def solid(self) -> "cq.Solid":
        """By the CAD kernel."""
        import cadquery as cq

        x, y = self.axis
        wire = cq.Wire.makePolygon([cq.Vector(x + r, y, z) for r, z in self.profile], close=True)
        return cq.Solid.revolve(wire, [], self.sweep, cq.Vector(x, y, 0), cq.Vector(x, y, 1))


@dataclass(frozen=True)
class Prism:
    """A polygon with corners (x, y), mm, between two heights."""

    corners: tuple[Point, ...]
    low: float
    high: float

    def solid(self) -> "cq.Solid":
        """By the CAD kernel."""
        import cadquery as cq

        wire = cq.Wire.makePolygon([cq.Vector(x, y, self.low) for x, y in self.corners], close=True)
        return cq.Solid.extrudeLinear(wire, [], cq.Vector(0, 0, self.high - self.low))


@dataclass(frozen=True)
class Slot(Prism):
    """An upright box whose lower and upper end may be half circles across y, as an end mill leaves them.

    The corners are those of the box; ``round_ends`` says which of both ends is round.
    """

    round_ends: tuple[bool, bool] = (True, True)

    def solid(self) -> "cq.Solid":
        """By the CAD kernel."""
        import cadquery as cq

        xs, ys = zip(*self.corners, strict=True)
        x, middle, half = min(xs), (min(ys) + max(ys)) / 2, (max(ys) - min(ys)) / 2
        low, high = (
            end + inwards * half * is_round
            for end, inwards, is_round in zip((self.low, self.high), (1, -1), self.round_ends, strict=True)
        )

        def at(y: float, z: float) -> "cq.Vector":
            return cq.Vector(x, middle + y, z)

        def end(first: float, straight: float, tip: float) -> "cq.Edge":
            if straight == tip:
                return cq.Edge.makeLine(at(first, straight), at(-first, straight))
            return cq.Edge.makeThreePointArc(at(first, straight), at(0.0, tip), at(-first, straight))

        edges = [
            end(-half, low, self.low),
            cq.Edge.makeLine(at(half, low), at(half, high)),
            end(half, high, self.high),
            cq.Edge.makeLine(at(-half, high), at(-half, low)),
        ]
        return cq.Solid.extrudeLinear(cq.Wire.assembleEdges(edges), [], cq.Vector(max(xs) - x, 0, 0))


@dataclass(frozen=True)
class Shape:
    """Pieces put together, less others.

    Raises
    ------
    GeometryError
        By :meth:`solid`: the pieces do not hang together, or the others leave nothing of them.

    >>> round(Shape((ring(2, 6, 1),)).solid().Volume() / math.pi, 9)
    8.0
    """

    pieces: tuple[Revolve | Prism, ...]
    less: tuple[Revolve | Prism, ...] = ()

    def __call__(self) -> "cq.Solid":
        """The same as :meth:`solid`: a shape is what builds a part."""
        return self.solid()

    def turned_over(self) -> "Shape":
        """The same upside down: what pointed up points down."""

        def over(piece: Revolve | Prism) -> Revolve | Prism:
            if isinstance(piece, Slot):
                lower, upper = piece.round_ends
                return Slot(piece.corners, -piece.high, -piece.low, (upper, lower))
            if isinstance(piece, Prism):
                return Prism(piece.corners, -piece.high, -piece.low)
            return Revolve(tuple((r, -z) for r, z in piece.profile[::-1]), piece.axis, piece.sweep)

        return Shape(tuple(map(over, self.pieces)), tuple(map(over, self.less)))

    def solid(self) -> "cq.Solid":
        """One solid."""
        import cadquery as cq

        first, *others = (piece.solid() for piece in self.pieces)
        whole: cq.Shape = first.fuse(*others) if others else first
        if self.less:
            whole = whole.cut(*(piece.solid() for piece in self.less))
        found = whole.Solids()
        if len(found) != 1 or not isinstance(found[0], cq.Solid):
            raise GeometryError(f"a shape falls into {len(found)} pieces; it has to be one")
        return found[0]


def ring(inner: float, outer: float, height: float, low: float = 0.0, chamfer: float = 0.0) -> Revolve:
    """A ring between two diameters, or a disc where ``inner`` is 0, its edges chamfered, mm."""
    r, big, high, c = inner / 2, outer / 2, low + height, chamfer
    if c <= 0:
        return Revolve(((r, low), (big, low), (big, high), (r, high)))
    outside = ((big - c, low), (big, low + c), (big, high - c), (big - c, high))
    if r == 0:
        return Revolve(((0.0, low), *outside, (0.0, high)))
    return Revolve(((r + c, low), *outside, (r + c, high), (r, high - c), (r, low + c)))


def hexagon(across: float, low: float, high: float) -> Prism:
    """A hexagon of this width across its flats, mm."""
    radius = across / math.sqrt(3)
    corners = (k * math.pi / 3 for k in range(6))
    return Prism(tuple((radius * math.cos(a), radius * math.sin(a)) for a in corners), low, high)


def box(x: tuple[float, float], y: tuple[float, float], z: tuple[float, float]) -> Prism:
    """A box between two values of each coordinate, mm."""
    return Prism(((x[0], y[0]), (x[1], y[0]), (x[1], y[1]), (x[0], y[1])), *z)


def slot(
    x: tuple[float, float], width: float, z: tuple[float, float], round_ends: tuple[bool, bool] = (True, True)
) -> Slot:
    """A slot about y = 0 between two values of x and of z, mm; see :class:`Slot`.

    >>> round(slot((0, 1), 4, (0, 10)).solid().Volume() - 4 * 6 - math.pi * 4, 9)
    0.0
    """
    half = width / 2
    return Slot(box(x, (-half, half), z).corners, *z, round_ends)
