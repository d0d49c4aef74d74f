"""Teeth, outlines, and the pair on its operating pitch circles, of one design."""

import math

import numpy as np

from mechwright import Array, Outline
from mechwright.geometry import Loop
from mechwright.mechanics.gearing import (
    MeshProof,
    Rack,
    Round,
    RoundPair,
    Shaper,
    Teeth,
    exact_fit,
    gear_loop,
    prove_mesh,
)
from mechwright.mechanics.gearing.involute import InvolutePair
from mechwright.tolerances import TOLERANCES
from mechwright_spur_gears.gear_table import GearTable

FINER = 0.75
"""Of the deviation with which outlines turn the mate exactly enough: polygons of the proof take the rest."""

FLATTEN = 2.5e-6
"""Chord error of the polygons of the mesh proof, in half centre distances."""


PITCH_POSITIONS = 96
"""Of one pitch: all teeth are alike, so that the next pitches say the same."""


class OnePitch(RoundPair):
    """A pair that is looked at over one pitch."""

    def run(self, teeth: int, positions: int | None = None) -> Array:
        """Arcs (n,), mm, of the driver's pitch point over a pitch."""
        count = PITCH_POSITIONS if positions is None else positions
        return np.asarray(self.pitch(teeth) * np.arange(count) / count)


def rolling_pair(m: GearTable) -> RoundPair:
    """Both operating pitch circles: tooth 0 of the driver stands on +x and runs into a space of the mate."""
    pair = m.pair
    start = (0.0 if m.ring else math.pi) - math.pi / float(pair.teeth[1])
    return RoundPair.of(float(pair.operating(0)), float(pair.operating(1)), start)


def operating_rack(m: GearTable, gear: int) -> Rack:
    """The rack that touches the flanks of a gear on its operating pitch circle; of a ring a round cutter."""
    pair = m.pair
    angle, rolled = float(pair.operating_angle), float(pair.operating(gear))
    module = 2 * rolled / float(pair.teeth[gear])
    heights = float(pair.tip(gear)) - rolled, rolled - float(pair.root(gear))
    arc = pair.tip_radius if rolled > 0 else pair.cutter_radius
    sizes = module, angle, *heights, float(arc * pair.module), float(pair.backlash)
    return Rack(*sizes) if rolled > 0 else Shaper(*sizes, float(pair.operating(0)))


def operating_teeth(m: GearTable, gear: int) -> Teeth:
    """The flanks of a gear on its operating pitch circle; fillets are not those of the rack."""
    pair, rolled = m.pair, float(m.pair.operating(gear))
    thick, count = float(pair.thickness_at(gear, rolled)), abs(int(pair.teeth[gear]))
    return Teeth(Round(rolled), operating_rack(m, gear), count, 0.0, fit=_fit(m), thickness=thick)


def _fit(m: GearTable) -> float:
    """Deviation of outlines, mm."""
    return FINER * exact_fit(rolling_pair(m), int(m.pair.teeth[0]), float(m.pair.operating_angle))


def teeth_of(m: GearTable) -> tuple[Teeth, Teeth]:
    """The teeth of both gears as their cutters make them: a rack on the reference circles."""
    mate = operating_teeth if m.ring else _teeth
    return m.once("teeth", lambda: (_teeth(m, 0), mate(m, 1)))


def _teeth(m: GearTable, gear: int) -> Teeth:
    pair: InvolutePair = m.pair
    size, shift = float(pair.module), float(pair.shifts[gear])
    rack = Rack(
        size,
        float(pair.angle),
        size * float(pair.addendum[gear] + shift - pair.shortening),
        size * float(pair.dedendum - shift),
        size * float(pair.tip_radius),
        float(pair.backlash),
    )
    circle, thick = Round(float(pair.reference(gear))), float(pair.thickness(gear))
    return Teeth(circle, rack, int(pair.teeth[gear]), 0.0, fit=_fit(m), thickness=thick)


def loops_of(m: GearTable) -> tuple[tuple[Loop, float], tuple[Loop, float]]:
    """The toothed loops of both gears, each with its deviation, mm."""
    one, two = teeth_of(m)
    return m.once("loops", lambda: (gear_loop(one), gear_loop(two)))


def outlines_of(m: GearTable) -> tuple[Outline, Outline]:
    """Outlines of both gears, each about its axis; keyways point along +x."""
    holes = () if m.opening is None else (m.opening.loop(),)
    (one, off), (two, more) = loops_of(m)
    return Outline(one, holes, off), m.ring_plate.outline(two, more) if m.ring else Outline(two, holes, more)


def prove(m: GearTable) -> MeshProof:
    """Run both outlines against each other over a pitch."""

    def found() -> MeshProof:
        tolerance = min(FLATTEN * float(m.distance) / 2, TOLERANCES.flatten)
        (one, off), (two, more) = loops_of(m)
        two = two.reversed() if m.ring else two
        polygons = one.flatten(tolerance), two.flatten(tolerance)
        whole = rolling_pair(m)
        pair = OnePitch(whole.driver, whole.driven, whole.distance, whole.start)
        return _proof(m, pair, polygons, off + more + 2 * tolerance)

    return m.once("mesh proof", found)


def prove_outlines(m: GearTable, one: Array, two: Array, allowance: float) -> MeshProof:
    """Run outlines (n, 2) and (m, 2), mm, material on the left, each about its axis, against each other."""
    return _proof(m, rolling_pair(m), (one, two), allowance)


def _proof(m: GearTable, pair: RoundPair, outlines: tuple[Array, Array], allowance: float) -> MeshProof:
    return prove_mesh(pair, operating_rack(m, 0), int(m.pair.teeth[0]), outlines, allowance)
