"""Teeth, outlines, and the pair on its operating pitch circles, of one design."""

import math

import numpy as np

from mechwright import Array, Outline
from mechwright.contracts.fits import Fit, hole_fit
from mechwright.geometry import Loop, circle
from mechwright.mechanics.gearing import (
    MeshProof,
    Rack,
    Round,
    RoundPair,
    Shaper,
    Teeth,
    exact_fit,
    gear_loop,
    lever_fit,
    prove_mesh,
)
from mechwright.mechanics.gearing.involute import InvolutePair
from mechwright.mechanics.gearing.rack_pair import RackPair
from mechwright.tolerances import TOLERANCES
from mechwright_spur_gears.gear_table import GearTable
from mechwright_spur_gears.parts.rack import POSITIONS_PER_TOOTH, proof_way, rack_proof, way_over

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


def rolling_pair(pair: InvolutePair) -> RoundPair:
    """Both operating pitch circles: tooth 0 of the driver stands on +x and runs into a space of the mate."""
    count = float(pair.teeth[1])
    start = (0.0 if count < 0 else math.pi) - math.pi / count
    return RoundPair.of(float(pair.operating(0)), float(pair.operating(1)), start)


def operating_rack(pair: InvolutePair, gear: int) -> Rack:
    """The rack that touches the flanks of a gear on its operating pitch circle; of a ring a round cutter."""
    angle, rolled = float(pair.operating_angle), float(pair.operating(gear))
    module = 2 * rolled / float(pair.teeth[gear])
    heights = float(pair.tip(gear)) - rolled, rolled - float(pair.root(gear))
    arc = pair.tip_radius if rolled > 0 else pair.cutter_radius
    sizes = module, angle, *heights, float(arc * pair.module), float(pair.backlash)
    return Rack(*sizes) if rolled > 0 else Shaper(*sizes, float(pair.operating(0)))


def operating_teeth(pair: InvolutePair, gear: int) -> Teeth:
    """The flanks of a gear on its operating pitch circle; fillets are not those of the rack."""
    rolled = float(pair.operating(gear))
    thick, count = float(pair.thickness_at(gear, rolled)), abs(int(pair.teeth[gear]))
    return Teeth(Round(rolled), operating_rack(pair, gear), count, 0.0, fit=_fit(pair), thickness=thick)


def _fit(pair: InvolutePair) -> float:
    """Deviation of outlines, mm."""
    if isinstance(pair, RackPair):
        return FINER * lever_fit(float(pair.base(0)))
    return FINER * exact_fit(rolling_pair(pair), int(pair.teeth[0]), float(pair.operating_angle))


def teeth_of(m: GearTable) -> tuple[Teeth, ...]:
    """The teeth of all round gears as their cutters make them: a rack on the reference circles."""

    def found() -> tuple[Teeth, ...]:
        own = [one for one in m.flanks if not one.again and not (m.straight and one.gear)]
        return tuple(_teeth(m.meshes[one.mesh], one.gear) for one in own)

    return m.once("teeth", found)


def _teeth(pair: InvolutePair, gear: int) -> Teeth:
    if pair.teeth[gear] < 0:
        return operating_teeth(pair, gear)
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
    return Teeth(circle, rack, int(pair.teeth[gear]), 0.0, fit=_fit(pair), thickness=thick)


def loops_of(m: GearTable) -> tuple[tuple[Loop, float], ...]:
    """The toothed loops of all gears, each with its deviation, mm; of a rack all round, which is exact."""

    def found() -> tuple[tuple[Loop, float], ...]:
        rack = ((m.rack_plate.outside(), 0.0),) if m.straight else ()
        return (*map(gear_loop, teeth_of(m)), *rack)

    return m.once("loops", found)


def outlines_of(m: GearTable) -> tuple[Outline, ...]:
    """Outlines of all gears, each about its axis; keyways point along +x."""
    shaft = () if m.opening is None else (m.opening.loop(),)
    holes = (
        {"planet": (Loop((circle((0.0, 0.0), pin_hole(m).middle / 2),)).reversed(),)} if m.planetary else {}
    )
    return tuple(
        _outline(m, name, loop, holes.get(name, shaft))
        for name, loop in zip(m.names, loops_of(m), strict=True)
    )


def _outline(m: GearTable, name: str, loop: tuple[Loop, float], holes: tuple[Loop, ...]) -> Outline:
    if name == "rack":
        return m.rack_plate.outline()
    return m.ring_plate.outline(*loop) if name == "ring" else Outline(loop[0], holes, loop[1])


def pin_hole(m: GearTable) -> Fit:
    """Of planets, which run on pins."""
    return hole_fit(m.dimensions.pin_diameter, "F7")


def prove(m: GearTable, mesh: int = 0) -> MeshProof:
    """Run the outlines of a pair against each other over a pitch."""

    def found() -> MeshProof:
        tolerance = min(FLATTEN * float(m.distance) / 2, TOLERANCES.flatten)
        (one, off), (two, more) = loops_of(m)[mesh : mesh + 2]
        pair = m.meshes[mesh]
        two = two.reversed() if pair.teeth[1] < 0 else two
        polygons = one.flatten(tolerance), two.flatten(tolerance)
        if m.straight:
            return rack_proof(m, proof_way(m, PITCH_POSITIONS), *polygons, off + more + 2 * tolerance)
        whole = rolling_pair(pair)
        over = OnePitch(whole.driver, whole.driven, whole.distance, whole.start)
        return _proof(pair, over, polygons, off + more + 2 * tolerance)

    return m.once(("mesh proof", mesh), found)


def prove_outlines(m: GearTable, mesh: int, one: Array, two: Array, allowance: float) -> MeshProof:
    """Run outlines (n, 2) and (m, 2), mm, material on the left, each about its axis, against each other."""
    if m.straight:
        return rack_proof(m, way_over(m, POSITIONS_PER_TOOTH), one, two, allowance)
    pair = m.meshes[mesh]
    return _proof(pair, rolling_pair(pair), (one, two), allowance)


def _proof(pair: InvolutePair, over: RoundPair, outlines: tuple[Array, Array], allowance: float) -> MeshProof:
    return prove_mesh(over, operating_rack(pair, 0), int(pair.teeth[0]), outlines, allowance, stop=True)
