"""A straight rack as a plate: its teeth, its back, and the holes by which it is screwed on.

The body frame has its origin on the reference line, in the middle of the length; x goes along the rack, and
the teeth point to +y. The spaces are those of the basic rack: straight flanks and round fillets. Half a space
lies beyond each of the outer teeth, so that all teeth are complete.
"""

import math
from dataclasses import dataclass
from typing import Any

import numpy as np

from mechwright.contracts.design_table import Rowwise
from mechwright.contracts.measure import Measure
from mechwright.contracts.part import Bore, Feature, Profile
from mechwright.geometry import Loop, Outline, circle
from mechwright.geometry.segments import Arc, Line, Point, Segment
from mechwright.mechanics.gearing.contour import tip_sites
from mechwright.mechanics.gearing.over_pins import gauge_pin
from mechwright.mechanics.gearing.rim_rules import rim_for, rim_rules
from mechwright.tolerances import TOLERANCES

HOLES = 2
"""Holes of a rack where the design names none and there is room."""


@dataclass(frozen=True)
class RackPlate(Rowwise):
    """A rack, mm and rad; numbers, or columns (n, 1).

    Parameters
    ----------
    module, angle
        Pitch over π, and pressure angle.
    count
        Number of teeth.
    thickness
        Of a tooth on the reference line.
    tip, root
        Height of a tooth over the reference line, and depth of a space below it.
    fillet
        Radius of the fillets of a space.
    body
        Height of the body below the roots.
    holes, hole
        Number and diameter of the holes in the middle of the body.
    """

    module: Any
    angle: Any
    count: Any
    thickness: Any
    tip: Any
    root: Any
    fillet: Any
    body: Any
    holes: Any
    hole: Any

    @property
    def pitch(self) -> Any:
        """Distance of the teeth."""
        return math.pi * self.module

    @property
    def length(self) -> Any:
        """From end to end."""
        return self.count * self.pitch

    @property
    def back(self) -> Any:
        """Depth of the back below the reference line."""
        return self.root + self.body

    @property
    def wall(self) -> Any:
        """What stays of the body on both sides of a hole together; all of it where there are none."""
        return self.body - np.where(np.asarray(self.holes) > 0, self.hole, 0.0)

    @property
    def depth(self) -> Any:
        """Of the teeth, from tip to root."""
        return self.tip + self.root

    def size_for(self, rim: float) -> int:
        """Height of the body, in whole mm, of one rack with a rim so wide."""
        return math.ceil(rim)

    @property
    def most_holes(self) -> int:
        """Holes of one rack between which a module stays."""
        return math.floor(float(self.length / (self.hole + self.module)))

    @property
    def bridge(self) -> Any:
        """What stays between two holes, or from a hole to both ends together; infinite without holes."""
        count = np.maximum(np.asarray(self.holes, dtype=float), 1)
        return np.where(np.asarray(self.holes) > 0, self.length / count - self.hole, np.inf)

    @property
    def half_land(self) -> float:
        """From the middle of a space to the centres of its fillets, of one rack."""
        deep = self.root - self.fillet * (1 - math.sin(self.angle))
        half = (self.pitch - self.thickness) / 2 - deep * math.tan(self.angle)
        return float(half - self.fillet * math.cos(self.angle))

    @property
    def tooth_places(self) -> tuple[float, ...]:
        """Middles of the teeth of one rack along x, in order."""
        count, pitch = int(self.count), float(self.pitch)
        return tuple(pitch * (k - (count - 1) / 2) for k in range(count))

    @property
    def centres(self) -> tuple[Point, ...]:
        """Of the holes of one rack, from left to right."""
        count, y = int(self.holes), -float(self.root + self.body / 2)
        return tuple((float(self.length) * ((k + 0.5) / count - 0.5), y) for k in range(count))

    def outside(self) -> Loop:
        """All round one rack, counter-clockwise from the left end of its back."""
        end, back, root = float(self.length) / 2, -float(self.back), -float(self.root)
        segments: list[Segment] = [
            Line((-end, back), (end, back), "back"),
            Line((end, back), (end, root), "end"),
        ]
        for middle in reversed(self.tooth_places):
            segments += self._tooth(middle, segments[-1].end)
        segments += _line(segments[-1].end, (-end, root), "root")
        return Loop((*segments, Line((-end, root), (-end, back), "end")))

    def _tooth(self, middle: float, start: Point) -> list[Segment]:
        """From a point of the roots at the right over a tooth to its left fillet."""
        alpha, radius, pitch = float(self.angle), float(self.fillet), float(self.pitch)
        half, tip, root = float(self.thickness) / 2, float(self.tip), float(self.root)
        top = half - tip * math.tan(alpha)
        deep = root - radius * (1 - math.sin(alpha))
        foot = half + deep * math.tan(alpha)
        centre = pitch / 2 - self.half_land
        right, left = (middle + foot, -deep), (middle - foot, -deep)
        rising: list[Segment] = []
        if radius > 0:
            turn = math.pi / 2 - alpha
            arc = Arc((middle + centre, radius - root), radius, -math.pi / 2, -turn, "fillet")
            rising = [*_line(start, arc.start, "root"), arc]
            right = arc.end
            fall = Arc((middle - centre, radius - root), radius, -alpha, -turn, "fillet")
            left, falling = fall.start, [fall]
        else:
            rising, falling = _line(start, right, "root"), []
        peaks = (middle + top, tip), (middle - top, tip)
        return [
            *rising,
            Line(right, peaks[0], "flank"),
            Line(*peaks, "tip"),
            Line(peaks[1], left, "flank"),
            *falling,
        ]

    def outline(self) -> Outline:
        """One rack with its holes."""
        holes = (Loop((circle(centre, float(self.hole) / 2),)).reversed() for centre in self.centres)
        return Outline(self.outside(), tuple(holes))

    def features(self, outline: Outline, thickness: float) -> list[Feature]:
        """Holes and outside of such an outline, which tabs may hold at the tips."""
        size, tabs = float(self.hole), tip_sites(outline.outer)
        bores = (
            Bore(f"hole-{k}", centre, size, 0, thickness) for k, centre in enumerate(self.centres, start=1)
        )
        return [*bores, Profile("outside", outline.outer, "outside", 0, thickness, tabs)]

    def measures(self, play: float) -> tuple[Measure, ...]:
        """From the back over a pin in a space; teeth may be thicker or thinner by ``play``, mm.

        A pin of diameter D touches both flanks with its centre D/(2 sin α) - w/(2 tan α) above the reference
        line, w being the width of the space there.
        """
        pin, alpha = gauge_pin(float(self.module)), float(self.angle)
        sine, tangent = math.sin(alpha), math.tan(alpha)
        depth = self.root - self.fillet * (1 - sine)

        def over(change: float) -> float | None:
            centre = pin / (2 * sine) - (self.pitch - self.thickness - change) / (2 * tangent)
            touches = -depth <= centre - pin / 2 * sine <= self.tip
            return float(self.back + centre + pin / 2) if touches else None

        sizes = [over(change) for change in (0.0, -play, play)]
        if (nominal := sizes[0]) is None:
            return ()
        found = [one for one in sizes if one is not None]
        what = f"from the back over a pin ⌀{pin:g}"
        if play <= 0 or len(found) < 3:
            return (Measure(what, nominal),)
        return (Measure(what, nominal, min(found), max(found), "backlash"),)


def _line(start: Point, end: Point, tag: str) -> list[Segment]:
    """A segment, or none between points that are one."""
    return [] if math.dist(start, end) <= TOLERANCES.closure else [Line(start, end, tag)]


def holes_for(length: Any, room: Any) -> Any:
    """Number of holes of a rack that names none; each takes a ``room``, mm, of the length.

    >>> int(holes_for(100.0, 7.5)), int(holes_for(10.0, 7.5))
    (2, 1)
    """
    return np.minimum(np.floor(length / room + TOLERANCES.slack), HOLES)


def body_for(hole: Any, depth: Any) -> Any:
    """Height, mm, of the body of a rack that names none: whole millimetres, with a full rim."""
    return np.ceil(rim_for(hole, depth))


RACK_RULES = rim_rules("rack", "rack_height", "below", lambda m: m.rack_plate)
"""Of tables with a ``rack_plate``: enough stays below the teeth, at the holes and between them."""
