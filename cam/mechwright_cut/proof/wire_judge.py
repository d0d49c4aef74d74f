"""Whether a program of a wire cuts the right pieces: its contours with the registers D of the control.

The control moves the wire aside by D. Each pass is judged by what that makes of it: the wire runs on the
waste's side, finds no corner too narrow for D, and the last pass leaves the wall on the contour itself.
"""

import math
from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np
import shapely

from mechwright.arrays import Array
from mechwright.errors import ProgramError
from mechwright.tolerances import TOLERANCES
from mechwright_cut.proof.judge import FELT, WALL, Check, CutProof, TargetPiece
from mechwright_cut.proof.reading import Motion
from mechwright_cut.proof.swept import points_of
from mechwright_cut.proof.wire_reading import Threaded, WireReading, WireRun, read_wire

SMOOTH = 0.02
"""Neighbours that turn by less, rad, meet without a corner: rounding of short moves turns as much."""
ROUNDED = 2e-4
"""What rounding moves ends of the contour by, mm."""


@dataclass(frozen=True)
class WireQuestion:
    """What the proof knows besides the text; lengths in mm.

    ``registers`` are D1, D2 ...; the last one is half of the kerf. ``start_hole`` is a diameter.
    """

    registers: tuple[float, ...]
    start_hole: float
    sheet: tuple[float, float]
    pieces: tuple[TargetPiece, ...]
    refused: str = ""


@dataclass(frozen=True)
class _Wanted:
    """A loop of a piece: where the wall is, and on which side the part is."""

    piece: int
    outside: bool
    ring: shapely.Polygon
    felt: tuple[tuple[shapely.LineString, bool], ...]


def prove_wire(text: str, asked: WireQuestion) -> CutProof:
    """Prove the text of a program of a wire."""
    try:
        reading = read_wire(text)
    except ProgramError as error:
        return CutProof((Check("reading", ok=False, message=str(error)),))
    wanted = [
        _Wanted(number, loop.area > 0, shapely.Polygon(loop.flatten()), _felt(loop.segments))
        for number, one in enumerate(asked.pieces)
        for loop in one.outline.loops
    ]
    found = [
        Check("wire and offsets", ok=not reading.faults, message="; ".join(reading.faults[:3])),
        Check("material", ok=not asked.refused, message=asked.refused),
        *_contours(reading, wanted, asked),
    ]
    length = sum(_line(run.motions).length for hole in reading.holes for run in hole.runs)
    return CutProof(tuple(found), length)


def wire_walls(text: str, registers: Sequence[float]) -> list[shapely.Polygon]:
    """The contours of a proven program, inside corners as round as the last pass leaves them."""
    asked = WireQuestion(tuple(registers), 0.0, (0.0, 0.0), ())
    walls, reach = [], registers[-1]
    for hole in read_wire(text).holes:
        ring, _ = _ring(hole, asked)
        if ring is not None:
            # The wire runs outside a part, and inside an opening.
            first = hole.runs[0]
            sign = 1 if (first.side == 1) != _forth_is_ccw(hole) else -1
            walls.append(
                shapely.buffer(shapely.buffer(ring, sign * reach, quad_segs=64), -sign * reach, quad_segs=64)
            )
    return walls


def _felt(segments: Sequence[object]) -> tuple[tuple[shapely.LineString, bool], ...]:
    return tuple(
        (shapely.LineString(one.flatten(0.01)), one.tag in FELT)  # type: ignore[attr-defined]
        for one in segments
    )


def _line(motions: Sequence[Motion]) -> shapely.LineString:
    parts = [points_of(motion) for motion in motions]
    return shapely.LineString(np.concatenate([parts[0], *(part[1:] for part in parts[1:])]))


def _contours(reading: WireReading, wanted: Sequence[_Wanted], asked: WireQuestion) -> list[Check]:
    """Hole by hole, in the order of the program."""
    kept = shapely.union_all([one.outline.polygon() for one in asked.pieces])
    left = list(wanted)
    walls, order, waste, leads = [], [], [], []
    for hole in reading.holes:
        waste += _hole(hole, kept, asked)
        ring, faults = _ring(hole, asked)
        walls += faults
        if ring is None:
            continue
        match = next((one for one in left if _same(ring, one.ring, asked.registers[0], one.outside)), None)
        if match is None:
            x, y = hole.hole
            walls.append(
                f"line {hole.line}: what is cut from X{x:g} Y{y:g} is no contour that is still wanted"
            )
            continue
        left.remove(match)
        walls += _sides(hole, match, asked)
        leads += _leads(hole, match, kept, asked)
        if match.outside and any(one.piece == match.piece for one in left):
            order.append(
                f"line {hole.line}: {asked.pieces[match.piece].name} falls before its openings are cut"
            )
    missing = [f"{asked.pieces[one.piece].name}: a contour is not cut" for one in left]
    good = f"{len(asked.pieces)} pieces within {1000 * WALL:g} µm, {len(reading.holes)} contours"
    return [
        _check("contours", [*walls, *missing], good),
        _check("openings before outsides", order),
        _check("start holes in the waste", waste),
        _check("ways to the wall", leads),
    ]


def _check(name: str, faults: Sequence[str], good: str = "") -> Check:
    return Check(name, ok=not faults, message="; ".join(faults[:3]) or good)


def _hole(hole: Threaded, kept: shapely.Geometry, asked: WireQuestion) -> list[str]:
    x, y = hole.hole
    length, width = asked.sheet
    off = float(shapely.distance(shapely.Point(hole.hole), kept))
    if off < asked.start_hole / 2 + max(asked.registers):
        return [f"line {hole.line}: the start hole at X{x:g} Y{y:g} is {off:.2f} mm off a wall"]
    if not (0 < x < length and 0 < y < width):
        return [f"line {hole.line}: the start hole at X{x:g} Y{y:g} is not on the sheet"]
    return []


def _ring(hole: Threaded, asked: WireQuestion) -> tuple[shapely.Polygon | None, list[str]]:
    """The net contour of a hole: one pass, and the tab, which close it."""
    faults = []
    if len(hole.runs) != len(asked.registers) + 1:
        count = len(hole.runs) - 1
        return None, [f"line {hole.line}: {count} passes, not {len(asked.registers)}, and the tab"]
    *passes, last = hole.runs
    for number, run in enumerate(passes, start=1):
        if run.register != number:
            faults.append(f"line {run.line}: D{run.register} in pass {number}")
        if len(run.motions) < 3:
            return None, [f"line {run.line}: a pass without a contour"]
    if last.register != len(asked.registers):
        faults.append(f"line {last.line}: D{last.register} along the tab")
    if not last.held:
        faults.append(f"line {last.line}: no stop before the tab; write M1")
    if any(run.held for run in passes):
        faults.append(f"line {hole.line}: a stop between passes")
    main = [_way(run, passes[0].side) for run in passes]
    for run, way in zip(passes, main, strict=True):
        if len(way) != len(main[0]) or np.abs(way - main[0]).max() > TOLERANCES.outline:
            faults.append(f"line {run.line}: a pass that runs elsewhere than the first")
    tab = _way(last, passes[0].side)
    if (
        math.dist(main[0][-1], tab[0]) > TOLERANCES.outline
        or math.dist(tab[-1], main[0][0]) > TOLERANCES.outline
    ):
        return None, [*faults, f"line {last.line}: the contour is open"]
    ring = shapely.Polygon(np.concatenate([main[0][:-1], tab[:-1]]))
    if not ring.is_valid:
        return None, [*faults, f"line {hole.line}: the contour cuts itself"]
    return ring, faults


def _way(run: WireRun, first: int) -> Array:
    """The contour of a pass without its ways on and off, in the direction of the first pass."""
    points: Array = shapely.get_coordinates(_line(run.motions[1:-1]))
    return points if run.side == first else points[::-1]


def _same(ring: shapely.Polygon, wanted: shapely.Polygon, reach: float, outside: bool) -> bool:
    """Whether a contour is the wanted one, but for corners that are too narrow for the wire."""
    sign = 1 if outside else -1
    closed = shapely.buffer(shapely.buffer(wanted, sign * reach, quad_segs=64), -sign * reach, quad_segs=64)
    least, most = (wanted, closed) if outside else (closed, wanted)
    points = shapely.points(shapely.get_coordinates(wanted.exterior))
    if shapely.is_empty(closed) or shapely.distance(points, closed.boundary).max() > 2 * reach:
        return False  # a slot that the wire would leave full
    return bool(shapely.covers(shapely.buffer(most, WALL), ring)) and bool(
        shapely.covers(shapely.buffer(ring, WALL), least)
    )


def _sides(hole: Threaded, match: _Wanted, asked: WireQuestion) -> list[str]:
    """The wire on the waste's side in every pass, and no move of which the offset leaves nothing."""
    faults = []
    first = hole.runs[0]
    # Clockwise around a part, and counter-clockwise in an opening, the waste is on the left.
    left = _forth_is_ccw(hole) != match.outside
    begin = _way(first, first.side)[0]
    for number, run in enumerate(hole.runs):
        forth = run.side == first.side
        if number < len(hole.runs) - 1:
            at = shapely.get_coordinates(_line(run.motions[1:-1]))[0]
            forth = math.dist(at, begin) <= TOLERANCES.outline
        if (run.side == 1) != (left == forth):
            faults.append(f"line {run.line}: the wire is on the part's side")
    ring_of = [*first.motions[1:-1], *_forth(hole.runs[-1], first.side)]
    for one in _narrow(ring_of, first.side, max(asked.registers)):
        faults.append(f"line {one.line}: too short or too round for an offset of {max(asked.registers):g} mm")
    return faults


def _forth(run: WireRun, side: int) -> list[Motion]:
    """The moves of a tab in the direction of the first pass."""
    moves = run.motions[1:-1]
    if run.side == side:
        return moves
    return [replace(m, start=m.end, end=m.start, turn=-m.turn) for m in reversed(moves)]


def _narrow(moves: Sequence[Motion], side: int, offset: float) -> list[Motion]:
    """Moves of a closed contour of which nothing is left when the wire runs ``offset`` mm beside them.

    At an inside corner of angle a, both neighbours lose offset · tan(a / 2); an arc about a centre on the
    wire's side has the offset less radius.
    """
    headings = [_headings(move) for move in moves]
    taken = [0.0] * len(moves)
    for number in range(len(moves)):
        turn = (headings[number][0] - headings[number - 1][1] + math.pi) % math.tau - math.pi
        if side * turn > SMOOTH:
            loss = offset * math.tan(min(side * turn, math.pi - SMOOTH) / 2)
            taken[number] += loss
            taken[number - 1] += loss
    found = []
    for move, lost in zip(moves, taken, strict=True):
        radius = math.inf if move.centre is None else math.dist(move.start, move.centre)
        if (move.turn * side > 0 and radius < offset - ROUNDED) or lost > shapely.LineString(
            points_of(move)
        ).length + ROUNDED:
            found.append(move)
    return found


def _headings(move: Motion) -> tuple[float, float]:
    """Directions at the start and at the end of a move, rad."""
    if move.centre is None:
        heading = math.atan2(move.end[1] - move.start[1], move.end[0] - move.start[0])
        return heading, heading
    cx, cy = move.centre
    ends = (move.start, move.end)
    one, two = (math.atan2(y - cy, x - cx) + move.turn * math.pi / 2 for x, y in ends)
    return one, two


def _forth_is_ccw(hole: Threaded) -> bool:
    """Whether the first pass and the tab behind it run counter-clockwise."""
    main = shapely.get_coordinates(_line(hole.runs[0].motions[1:-1]))
    return bool(shapely.is_ccw(shapely.LinearRing(main)))


def _leads(hole: Threaded, match: _Wanted, kept: shapely.Geometry, asked: WireQuestion) -> list[str]:
    """Ways on and off: straight, longer than D, through waste, to no segment that works."""
    faults = []
    most = max(asked.registers)
    for number, run in enumerate(hole.runs):
        for motion, at in ((run.motions[0], 1), (run.motions[-1], 0)):
            if math.dist(motion.start, motion.end) <= most:
                faults.append(f"line {motion.line}: the way is shorter than the offset of {most:g} mm")
            # It ends on the wall: what lies farther off than half a wire has to be waste.
            way = shapely.LineString([motion.start, motion.end])
            foot = shapely.Point(motion.end if at else motion.start)
            if shapely.difference(shapely.intersection(way, kept), shapely.buffer(foot, most)).length > WALL:
                faults.append(f"line {motion.line}: the way leads through a part")
            middle = shapely.line_interpolate_point(way, 0.5, normalized=True)
            if shapely.contains(kept, middle):
                faults.append(f"line {motion.line}: the way leads through a part")
        if number == 0:
            foot = shapely.Point(run.motions[0].end)
            flags = [flag for _, flag in match.felt]
            if any(flags) and not all(flags):
                off = [float(shapely.distance(segment, foot)) for segment, _ in match.felt]
                if flags[off.index(min(off))]:
                    faults.append(f"line {run.motions[0].line}: the way meets the part on a flank")
    if hole.runs and math.dist(hole.runs[0].motions[0].start, hole.hole) > TOLERANCES.outline:
        faults.append(f"line {hole.line}: the first pass does not begin in the start hole")
    return faults
