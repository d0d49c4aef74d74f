"""A rack and its pinion as drawn, as cut and as made."""

import math
from collections.abc import Mapping, Sequence

import numpy as np

from mechwright import AsMade, Instance, MadePart, Part
from mechwright.arrays import Array
from mechwright.mechanics.gearing import MeshProof, Rack
from mechwright.mechanics.gearing.gauging import SHARE
from mechwright.mechanics.gearing.rack_as_made import RackMesh, rack_as_made
from mechwright.mechanics.gearing.rack_mesh import RackRun
from mechwright_spur_gears.gear_table import GearTable

COLOUR = (0.80, 0.68, 0.42)

END_POSITIONS = 48
"""Of half a pitch at either end of the travel, which the mesh proof looks at beside a pitch in the middle."""

POSITIONS_PER_TOOTH = 8
"""Over the whole travel, of racks as cut and as made."""


def run_of(m: GearTable) -> RackRun:
    """How the rack goes past the pinion."""
    pair = m.rack_pair
    return RackRun(
        float(pair.operating(0)), float(pair.distance), float(pair.angle), float(pair.pitch), m.pinion_start
    )


def cutter_of(m: GearTable) -> Rack:
    """The rack that cuts both, mm."""
    pair, size = m.rack_pair, float(m.pair.module)
    heights = size * float(pair.addendum[0]), size * float(pair.dedendum)
    return Rack(size, float(pair.angle), *heights, size * float(pair.tip_radius), float(pair.backlash))


def way_over(m: GearTable, per_pitch: int) -> Array:
    """Places (n,), mm, of the rack all over the travel, both ends included."""
    travel = float(m.dimensions.travel)
    count = int(np.ceil(per_pitch * travel / float(m.rack_pair.pitch))) + 2
    return np.linspace(-travel / 2, travel / 2, count)


def proof_way(m: GearTable, positions: int) -> Array:
    """Places (n,), mm: of a pitch in the middle, all of which are alike, and of half a pitch at both ends."""
    half, pitch = float(m.dimensions.travel) / 2, float(m.rack_pair.pitch)
    if 2 * half <= 2 * pitch:
        return np.linspace(-half, half, positions + 2 * END_POSITIONS)
    end = np.linspace(half - pitch / 2, half, END_POSITIONS)
    return np.concatenate((-end[::-1], pitch * np.arange(positions) / positions - pitch / 2, end))


def rack_proof(m: GearTable, way: Array, pinion: Array, rack: Array, allowance: float) -> MeshProof:
    """Run outlines (n, 2) and (m, 2), mm, against each other."""
    return run_of(m).prove(rack, pinion, way, float(m.pair.backlash), allowance)


def rack_part(m: GearTable) -> Part:
    """The rack, with its size over a pin."""
    given, plate = m.given, m.rack_plate
    outline = plate.outline()
    return Part(
        "rack",
        outline,
        given.thickness,
        given.material,
        instances=(Instance("rack", 0.0, COLOUR),),
        machined=tuple(plate.features(outline, given.thickness)),
        measures=plate.measures(SHARE * float(m.pair.backlash)),
        data=_data(m),
    )


def _data(m: GearTable) -> tuple[tuple[str, str], ...]:
    """Names and values of the rack's table of teeth."""
    pair = m.rack_pair
    return (
        ("number of teeth", f"{int(m.dimensions.rack_teeth)}"),
        ("module", f"{float(pair.module):.4g}"),
        ("pressure angle", f"{math.degrees(float(pair.angle)):.4g}°"),
        ("pitch", f"{float(pair.pitch):.6g}"),
        ("tooth on the pitch line", f"{float(pair.thickness(1)):.4g}"),
    )


def made_of(m: GearTable, made: Mapping[str, Sequence[MadePart]], least: tuple[float, str]) -> AsMade:
    """Judge rack and pinion as made; ``least`` is the backlash, mm, that they need, and its rule."""
    return rack_as_made(made, float(m.given.bore), designed(m), least)


def designed(m: GearTable) -> RackMesh:
    """What rack and pinion as made are held against."""
    plate, pair = m.rack_plate, m.rack_pair
    half = float(pair.thickness(1)) / 2
    crossings = np.array(plate.tooth_places)[:, None] + half * np.array([-1.0, 1.0])
    way = way_over(m, POSITIONS_PER_TOOTH)
    recess, approach = (float(path) for path in pair.paths)
    return RackMesh(run_of(m), cutter_of(m), crossings, (recess, approach), way, float(plate.back))
