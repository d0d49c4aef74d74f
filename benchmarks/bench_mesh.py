"""The mesh proof of elliptic gears held against polygons: overlap, depth and gap of random pairs.

Every pair is drawn at random: sound ones, some grown or shrunk along their normals, some as a round cutter
leaves them, some in the wrong phase, some with addenda that are too long. In each position shapely says what
the outlines have in common and how far apart they are; it shares no line with the proof.

Run:  python benchmarks/bench_mesh.py [PAIRS [SEED]]
"""

import sys
import time

import numpy as np
import shapely

from mechwright.contracts.finding import errors
from mechwright.errors import MechwrightError
from mechwright.mechanics.gearing import mesh
from mechwright.mechanics.gearing.mesh import EDGES_PER_PITCH
from mechwright_elliptic_gears.parameters import EllipticGearParams
from mechwright_elliptic_gears.parts.gear import outline_of, pair_of, teeth_of
from mechwright_elliptic_gears.parts.tooth_offset import offsets_that_mesh
from mechwright_elliptic_gears.rules.teeth import OUTLINE
from mechwright_elliptic_gears.table import table_of

POSITIONS = 8
ALLOWANCE = 2e-4
"""mm: what fitting and flattening put on two outlines of 0.1 µm each."""


def random_pair(rng: np.random.Generator) -> tuple[EllipticGearParams, np.ndarray, bool] | None:
    """Draw a design and its outline (n, 2), mm, and say whether flanks are nearest; None for no gear."""
    teeth = int(rng.integers(18, 70))
    kind = rng.choice(["sound", "sound", "grown", "cut", "phase", "addendum"])
    params = EllipticGearParams(
        eccentricity=float(rng.uniform(0, 0.7)),
        teeth=teeth,
        module=float(rng.uniform(0.5, 4)),
        backlash=float(rng.choice([0.0, rng.uniform(0, 0.15)])),
        addendum=float(rng.uniform(1.1, 1.25)) if kind == "addendum" else 1.0,
        tooth_offset=(offsets_that_mesh(teeth)[0] + float(rng.uniform(0, 0.5))) % 1
        if kind == "phase"
        else None,
        bore=0.0,
    )
    try:
        checked = params.model_copy(update={"tooth_offset": None})
        if errors(OUTLINE.findings(table_of(checked))):
            return None
        polygon = shapely.Polygon(outline_of(params).outer.flatten(1e-4))
    except MechwrightError:
        return None
    if kind == "grown":
        polygon = polygon.buffer(float(rng.choice([-1, 1]) * 10 ** rng.uniform(-4, -1)), quad_segs=16)
    if kind == "cut":
        radius = float(rng.uniform(0.3, 0.8)) * teeth_of(params).rack.module
        polygon = polygon.buffer(radius, quad_segs=32).buffer(-radius, quad_segs=32)
    flank = kind not in ("cut", "phase", "addendum")
    return params, shapely.get_coordinates(shapely.orient_polygons(polygon).exterior)[:-1], flank


def measured(one: shapely.Polygon, other: shapely.Polygon) -> tuple[float, float, float]:
    """Area, mm², depth, mm, and distance, mm, of two outlines in position."""
    common, depth = one.intersection(other), 0.0
    for mine, its in ((one, other), (other, one)):
        corners = shapely.get_coordinates(mine)
        inside = corners[shapely.contains_xy(its, *corners.T)]
        if len(inside):
            # No edge outside this box is as near as the box is long.
            reach = max(np.ptp(inside, axis=0).max(), 1.0)
            rim = shapely.clip_by_rect(
                shapely.boundary(its), *(inside.min(0) - reach), *(inside.max(0) + reach)
            )
            depth = max(depth, float(shapely.distance(rim, shapely.points(inside)).max()))
    return float(common.area), depth, 0.0 if common.area else float(one.distance(other))


def placed(points: np.ndarray, angle: float, away: float) -> shapely.Polygon:
    """An outline (n, 2) turned, and shifted along x."""
    turned = points @ np.array([[np.cos(angle), np.sin(angle)], [-np.sin(angle), np.cos(angle)]])
    return shapely.Polygon(turned + np.array([away, 0.0]))


def near_each_other(one: shapely.Polygon, other: shapely.Polygon, margin: float) -> list[shapely.Polygon]:
    """What two outlines have in the box that holds both, and a margin, mm, around it."""
    low = np.maximum(one.bounds[:2], other.bounds[:2]) - margin
    high = np.minimum(one.bounds[2:], other.bounds[2:]) + margin
    cut = [shapely.clip_by_rect(polygon, *low, *high) for polygon in (one, other)]
    shapely.prepare(cut)
    return cut


def differences(params: EllipticGearParams, points: np.ndarray, flank: bool) -> list[str]:
    """Compare the proof with polygons in some positions; a line for each contradiction."""
    pair, pitch = pair_of(params), teeth_of(params).rack.pitch
    found = mesh(points, points, pair, params.teeth, positions=POSITIONS, allowance=ALLOWANCE)
    theta2, theta4 = found.angles
    ring = shapely.get_coordinates(shapely.segmentize(shapely.LinearRing(points), pitch / EDGES_PER_PITCH))[
        :-1
    ]
    wrong, areas = [], []
    for i in range(POSITIONS):
        both = placed(ring, theta2[i], 0), placed(ring, theta4[i], pair.distance)
        one, other = near_each_other(*both, pitch)
        area, depth, gap = measured(one, other)
        areas.append(area)
        said = f"position {i}: depth {found.depth[i]:.6f} gap {found.gap[i]:.6f} overlap {found.overlap:.6f}"
        true = f"polygons: depth {depth:.6f} distance {gap:.6f} area {area:.6f}"
        if max(found.depth[i], depth) > ALLOWANCE and abs(found.depth[i] - depth) > 1e-6:
            wrong.append(f"depth: {said}; {true}")
        if found.depth[i] > ALLOWANCE and area == 0:
            wrong.append(f"a depth without area: {said}; {true}")
        # The proof's gap is where the least turn is. A tip that is too long, or a fillet as cut, may be
        # nearer, and in the wrong phase the other flank, with a shorter lever, to its mate: never farther.
        off = min(found.gap[i], 0.1) - min(gap, 0.1)
        if area == 0 and (abs(off) if flank else -off) > max(2 * ALLOWANCE, 0.02 * gap):
            wrong.append(f"gap: {said}; {true}")
    deep = [area for area, depth in zip(areas, found.depth, strict=True) if depth > ALLOWANCE]
    if abs(max(deep, default=0.0) - found.overlap) > 1e-9 + 1e-6 * found.overlap:
        wrong.append(f"overlap {found.overlap} is not {max(deep, default=0.0)}")
    return wrong


def main(pairs: int, seed: int) -> int:
    """Compare so many pairs."""
    rng, start = np.random.default_rng(seed), time.perf_counter()
    done = bad = 0
    while done < pairs:
        drawn = random_pair(rng)
        if drawn is None:
            continue
        done += 1
        wrong = differences(*drawn)
        bad += bool(wrong)
        for line in wrong[:2]:
            print(drawn[0].model_dump(exclude_defaults=True), line, flush=True)
    seconds = time.perf_counter() - start
    print(f"{done} pairs, {done * POSITIONS} positions: {bad} pairs with contradictions; {seconds:.0f} s")
    return bad


if __name__ == "__main__":
    given = [int(text) for text in sys.argv[1:]]
    sys.exit(bool(main(*(given + [200, 1][len(given) :]))))
