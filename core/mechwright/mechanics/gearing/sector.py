"""Toothed sectors: teeth over a part of the turn, and the blank that holds them.

Two sectors roll on each other while the driver swings over its travel. They have all the teeth whose middles
lie on it or at most three quarters of a pitch beyond one of its ends, so that at each of its ends there is a
flank on either side within half a pitch of the pitch point, as in the middle of a gear. Behind its last teeth
a sector has half a space, and from there its blank is drawn taut around the hub: by two straight sides that
touch the hub, or by one where the sector reaches so far round that it stays clear of the hub.

Glossary
--------
travel
    What the pitch point goes along the pitch curve while the driver swings one way.
ghost
    A flank beyond the ends: both half spaces have one of their two. It is computed as all others
    are and stands nowhere.
"""

import math
from dataclasses import dataclass
from functools import cached_property

import numpy as np

from mechwright.arrays import Array
from mechwright.geometry.outline import Loop
from mechwright.geometry.segments import Arc, BSpline, Line, Point, Segment
from mechwright.mechanics.gearing.contour import fillets, flanks, offsets, share
from mechwright.mechanics.gearing.pitch_curve import Frame, PitchCurve
from mechwright.mechanics.gearing.rack import Rack
from mechwright.mechanics.gearing.teeth import Teeth
from mechwright.tolerances import TOLERANCES

BEYOND = 0.75
"""Pitches from an end of the travel to the middle of the last tooth, at most."""

_SLACK = 1e-9
"""Pitches by which a place on a limit may be off."""

_EXTENT_SAMPLES = 361
"""Points of the pitch curve along which its direction is followed, and its least root is sought."""


@dataclass(frozen=True)
class SectorTeeth(Teeth):
    """Teeth of a sector.

    Tooth 0 is a ghost: its space is the half space before the first tooth. ``count`` is one more than there
    are teeth, and ``offset`` says where tooth 0 would stand.

    Parameters
    ----------
    wheel_teeth
        Pitches of the travel.
    low, high
        Limits of the middles of teeth, pitches of arc.
    hub
        Radius of the hub, mm.
    """

    wheel_teeth: int
    low: float
    high: float
    hub: float

    @classmethod
    def over(
        cls, curve: PitchCurve, rack: Rack, wheel: int, travel: tuple[float, float], phase: float, hub: float
    ) -> "SectorTeeth":
        """All teeth over a travel between two arcs, pitches, that stand at whole numbers and a ``phase``.

        >>> from mechwright.mechanics.gearing.round import Round
        >>> rack = Rack(2.0, 0.35, 2.0, 2.5, 0.5, 0.0)
        >>> teeth = SectorTeeth.over(Round(20.0), rack, 5, (-5.0, 0.0), 0.5, 6.0)
        >>> ((teeth.tooth_arcs / rack.pitch)[1:]).round(9).tolist()
        [-5.5, -4.5, -3.5, -2.5, -1.5, -0.5, 0.5]
        """
        low, high = min(travel) - BEYOND, max(travel) + BEYOND
        first, last = math.ceil(low - phase - _SLACK), math.floor(high - phase + _SLACK)
        return cls(curve, rack, last - first + 2, first - 1 + phase, wheel, low, high, hub)

    @property
    def wheel(self) -> int:
        """Pitches of the travel."""
        return self.wheel_teeth

    @cached_property
    def meeting_arcs(self) -> Array:
        """NaN of ghosts, and of flanks whose mate would stand beyond the ends."""
        middle = np.arange(self.count, dtype=np.float64) + self.offset
        arcs = self.flank_arcs.copy()
        # Side -1 of a space belongs to the tooth before it, side +1 to the one behind; the tooth of the mate
        # that it meets stands half a pitch on, in the middle of the space.
        for side, tooth in ((0, middle), (1, middle + 1)):
            for place in (tooth, middle + 0.5):
                arcs[(place < self.low - _SLACK) | (place > self.high + _SLACK), side] = np.nan
        return arcs

    @cached_property
    def tip_lands(self) -> tuple[Array, Array]:
        """Of the teeth that stand (z - 1,)."""
        below = self.tip_trim[1]
        return below[:-1, 1], below[1:, 0]

    @cached_property
    def least_regularity(self) -> Array:
        """1 of ghosts."""
        return _standing(super().least_regularity)

    @cached_property
    def least_tip_regularity(self) -> Array:
        """1 of ghosts."""
        return _standing(super().least_tip_regularity)

    @cached_property
    def ends(self) -> Array:
        """Parameters (2,), rad, in the middle of both half spaces."""
        return self.curve.parameter(self.space_arcs[[0, -1]])

    @cached_property
    def _along(self) -> Frame:
        begin, end = self.ends.tolist()
        return self.curve.frame(np.linspace(begin, end, _EXTENT_SAMPLES))

    @cached_property
    def extent(self) -> float:
        """Angle, rad, about the axis from one end of the sector to the other."""
        frame = self._along
        turned = np.unwrap(frame.polar_angle)
        return float(turned[-1] - turned[0])

    @cached_property
    def least_root(self) -> float:
        """Least distance, mm, of its roots from the axis."""
        return float(np.hypot(*self._along.offset(-self.rack.dedendum).T).min())


def _standing(values: Array) -> Array:
    found = values.copy()
    found[0, 0] = found[-1, 1] = 1.0
    return found


def sector_loop(teeth: SectorTeeth) -> tuple[Loop, float]:
    """Fit the outside of a sector.

    Returns
    -------
    loop
        Counter-clockwise from the middle of the half space before the first tooth: its root, fillet and
        flank, per tooth its tip, flank, fillet and root, and so on to the other half space; then the blank,
        tagged ``"side"`` and ``"hub"``. Body frame.
    deviation
        Measured distance from the exact curves, mm.

    Raises
    ------
    GeometryError
        The curves do not meet, or are not smooth.
    """
    count = teeth.count
    tips, at_tips = offsets(teeth, *teeth.tip_lands, teeth.rack.addendum)
    down, up, at_flanks = flanks(teeth)
    fall, rise, at_fillets = fillets(teeth)
    share(tips, [one[-1][-1] for one in up[:-1]], [one[0][0] for one in down[1:]])
    share(fall, [one[-1][-1] for one in down], None)
    share(rise, None, [one[0][0] for one in up])
    begin, end = teeth.curve.parameter(teeth.arc_centres).T
    begin[0], end[-1] = teeth.ends
    roots, at_roots = offsets(teeth, begin, end, -teeth.rack.dedendum)
    fallen, risen = np.array([one[-1][-1] for one in fall]), np.array([one[0][0] for one in rise])
    if teeth.half_land > TOLERANCES.closure:
        share(roots[1:], list(fallen[1:]), None)
        share(roots[:-1], None, list(risen[:-1]))
    else:
        # A rack with a full radius leaves no land.
        roots = [[] for _ in roots]
        share(rise[1:-1], list(fallen[1:-1]), None)
    segments: list[Segment] = []
    for j in range(count):
        chains = [(roots[j], "root"), (rise[j], "fillet"), (up[j], "flank")]
        if j:
            chains[:0] = [(tips[j - 1], "tip"), (down[j], "flank"), (fall[j], "fillet")]
        if j == count - 1:
            chains = chains[:4]
        segments += [BSpline.bezier(net, tag) for nets, tag in chains for net in nets]
    segments += blank(segments[-1].end, segments[0].start, teeth.hub)
    return Loop(tuple(segments)), max(at_tips, at_flanks, at_fillets, at_roots)


def blank(end: Point, start: Point, hub: float) -> list[Segment]:
    """From the last end of a sector counter-clockwise to its first, drawn taut around a hub, mm.

    >>> [type(one).__name__ for one in blank((0.0, 10.0), (0.0, -10.0), 5.0)]
    ['Line', 'Arc', 'Line']
    >>> [type(one).__name__ for one in blank((10.0, -1.0), (10.0, 1.0), 5.0)]
    ['Line']
    """
    (one, far), (two, near) = (
        (math.atan2(y, x), math.acos(min(1.0, hub / math.hypot(x, y)))) for x, y in (end, start)
    )
    gap = (two - one) % math.tau
    turn = gap - far - near
    if turn <= TOLERANCES.closure:
        return [Line(end, start, "side")]
    arc = Arc((0.0, 0.0), hub, one + far, turn, "hub")
    return [Line(end, arc.start, "side"), arc, Line(arc.end, start, "side")]
