"""Whether a program cuts the right pieces, in the right order, and nothing else.

Glossary
--------
piece
    What of the sheet hangs together after all cuts, without the rest that reaches the sheet's edge.
loose
    Cut out of the sheet, so that it may have moved.
"""

import math
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
import shapely

from mechwright.errors import ProgramError
from mechwright.geometry import Loop, Outline
from mechwright.geometry.segments import Point
from mechwright.tolerances import TOLERANCES
from mechwright_cut.proof.reading import Motion, Reading, read_beam
from mechwright_cut.proof.swept import disc, runs, way
from mechwright_cut.proof.taper import taper_faults

WALL = TOLERANCES.gouge
"""Largest distance of a cut wall from the outline, mm."""
SPECK = 1e-6
"""Area of what is no more than rounding, mm²."""
PIERCED = 1.0
"""A pierce opens a hole of so many kerfs around its middle: it stays off walls by more."""
FELT = frozenset({"flank", "slot", "lobe", "dwell", "cam", "side"})
"""Names of segments on which no lead may meet the contour."""


@dataclass(frozen=True)
class TargetPiece:
    """What has to fall out: an outline on the sheet, mm, its marks, and its micro-joints."""

    name: str
    outline: Outline
    marks: tuple[tuple[Point, ...], ...] = ()
    joints: int = 0


@dataclass(frozen=True)
class Question:
    """What the proof knows besides the text; lengths in mm.

    ``through`` and ``mark`` are the S words of a cut and of a mark, ``refused`` why the material must not be
    cut, ``passes`` how often each contour is run, ``taper`` by how much the faces of a piece may differ.
    ``common`` says that pieces may share a cut: then a run may begin in one, and graze what is loose by no
    more than a wall may be off.
    """

    control: str
    kerf: float
    sheet: tuple[float, float]
    pieces: tuple[TargetPiece, ...]
    through: float
    mark: float
    full: float
    passes: int = 1
    joint_width: float = 0.0
    taper: float = 0.0
    refused: str = ""
    common: bool = False


@dataclass(frozen=True)
class Check:
    """One thing that the proof looked at: its name, whether it is right, and what there is to say."""

    name: str
    ok: bool
    message: str = ""


@dataclass(frozen=True)
class CutProof:
    """What the proof says of a program."""

    checks: tuple[Check, ...]
    length: float = 0.0
    """Way of the beam through the sheet, mm."""

    @property
    def ok(self) -> bool:
        """Whether the program cuts the right pieces."""
        return all(check.ok for check in self.checks)

    @property
    def failures(self) -> Sequence[Check]:
        """The checks that it does not pass."""
        return [check for check in self.checks if not check.ok]

    def as_dict(self) -> dict[str, Any]:
        """Plain data."""
        rows = [{"name": c.name, "ok": c.ok, "message": c.message} for c in self.checks]
        return {"ok": self.ok, "length_mm": round(self.length, 1), "checks": rows}


def prove(text: str, asked: Question) -> CutProof:
    """Prove the text of a program of a beam."""
    try:
        reading = read_beam(text, asked.control)
    except ProgramError as error:
        return CutProof((Check("reading", ok=False, message=str(error)),))
    through = [m for m in reading.motions if m.power > asked.mark]
    found = [
        _states(reading),
        _material(asked),
        _powers(reading, asked),
        _on_sheet(reading, asked),
        *_pieces(reading, asked),
        _taper(through, asked),
        _marks(reading, asked),
    ]
    return CutProof(tuple(found), sum(way([m]).length for m in through))


def _check(name: str, faults: Sequence[str], good: str = "") -> Check:
    return Check(name, ok=not faults, message="; ".join(faults[:3]) or good)


def _states(reading: Reading) -> Check:
    lit = [f"line {m.line}: a rapid with the beam on" for m in reading.motions if m.rapid and m.power > 0]
    faults = [*reading.faults, *lit]
    return _check("beam off in rapids and at the end", faults)


def _material(asked: Question) -> Check:
    return _check("material", [f"must not be cut: {asked.refused}"] if asked.refused else [])


def _powers(reading: Reading, asked: Question) -> Check:
    known = {0.0, asked.through, asked.mark}
    faults = [
        f"line {m.line}: S{m.power:g} is neither that of a cut, S{asked.through:g}, nor of a mark"
        for m in reading.motions
        if min(abs(m.power - one) for one in known) > TOLERANCES.closure or m.power > asked.full
    ]
    return _check("power", faults)


def _on_sheet(reading: Reading, asked: Question) -> Check:
    length, width = asked.sheet
    rim = shapely.box(0, 0, length, width)
    faults = []
    for motion in reading.motions:
        taken = disc(way([motion]), asked.kerf) if motion.power else way([motion])
        if motion.start != motion.end and not shapely.covers(rim, taken):
            faults.append(f"line {motion.line}: leaves the sheet of {length:g} x {width:g} mm")
    return _check("inside the sheet", faults)


def _pieces(reading: Reading, asked: Question) -> list[Check]:
    """Cut run by run; what is loose must not be cut any more, and at the end the pieces are compared."""
    wanted = [one.outline.polygon() for one in asked.pieces]
    every = shapely.union_all(wanted)
    shapely.prepare(every)
    edge = shapely.box(0, 0, *asked.sheet).exterior
    left: shapely.Geometry = shapely.box(0, 0, *asked.sheet)
    loose: list[shapely.Geometry] = []
    late, pierced, felt = [], [], []
    seen: dict[tuple[Point, Point], int] = {}
    for run in runs([m for m in reading.motions if m.power == 0 or m.power > asked.mark]):
        line = way(run)
        taken = disc(line, asked.kerf)
        first = run[0]
        key = (first.start, run[-1].end)
        seen[key] = seen.get(key, 0) + 1
        again = seen[key] > 1
        if again:
            continue
        grazed = shapely.buffer(taken, -slack(asked)) if asked.common else taken
        hit = [one for one in loose if shapely.intersection(one, grazed).area > SPECK]
        late += [f"line {first.line}: cuts into what is loose" for _ in hit[:1]]
        loose = [shapely.difference(one, taken) for one in loose] if asked.common else loose
        opened = asked.common and _is_open(first, [left, *loose], asked)
        pierced += [] if opened else _pierce(first, every, asked)
        felt += _begins(first, asked) if opened else _joins(line, first, asked)
        left = shapely.difference(left, taken)
        parts = list(shapely.get_parts(left))
        loose += [one for one in parts if not shapely.intersects(one, edge) and one.area > SPECK]
        left = shapely.union_all([one for one in parts if shapely.intersects(one, edge)])
    passes = [
        f"a contour that begins at X{at[0]:g} Y{at[1]:g} is run {count} times, not {asked.passes}"
        for (at, _), count in seen.items()
        if count != asked.passes
    ]
    return [
        _check("nothing is cut that is loose", late),
        _check("pierces in the waste", pierced),
        _check("leads off flanks", felt),
        _check("passes", passes),
        *_compared(asked, wanted, loose, left),
    ]


def _taper(through: Sequence[Motion], asked: Question) -> Check:
    """The pieces at both faces; those on micro-joints have joints that are wider than the taper."""
    if asked.taper >= asked.kerf:
        said = f"not judged: a taper of {asked.taper:g} mm may be as wide as the kerf"
        return Check("taper", ok=True, message=said)
    freed = [(one.name, one.outline.polygon()) for one in asked.pieces if not one.joints]
    faults = [*taper_faults(through, asked.kerf, asked.taper, asked.sheet, freed)]
    if len(freed) < len(asked.pieces) and asked.joint_width <= asked.taper:
        faults.append(
            f"micro-joints of {asked.joint_width:g} mm end at one face: the taper is {asked.taper:g} mm"
        )
    return _check("taper", faults, f"the faces differ by up to {asked.taper:g} mm")


def _pierce(first: Motion, every: shapely.Geometry, asked: Question) -> list[str]:
    """A pierce needs room; a stretch behind a micro-joint begins on the contour."""
    room = asked.kerf * (0.5 if any(one.joints for one in asked.pieces) else PIERCED)
    off = float(shapely.distance(shapely.Point(first.start), every))
    if off >= room - WALL or _is_middle(first, asked):
        return []
    x, y = first.start
    return [f"line {first.line}: the pierce at X{x:g} Y{y:g} is {off:.3f} mm off a wall, not {room:.3f}"]


def slack(asked: Question) -> float:
    """What a beam may graze, mm: far less than its own width."""
    return min(WALL, asked.kerf / 4)


def _is_open(first: Motion, solid: Sequence[shapely.Geometry], asked: Question) -> bool:
    """Whether a run begins in a cut: nothing is left under the beam, so that nothing is pierced."""
    beam = shapely.buffer(shapely.Point(first.start), asked.kerf / 2 - slack(asked))
    return not any(shapely.intersects(one, beam) for one in solid)


def _begins(first: Motion, asked: Question) -> list[str]:
    """A run that begins in a cut begins beside no segment that works."""
    start = shapely.Point(first.start)
    for one in asked.pieces:
        for loop in one.outline.loops:
            if at := _felt_at(loop, start, asked.kerf / 2 + WALL):
                return [f"line {first.line}: a cut beside {one.name} begins on a {at}"]
    return []


def _felt_at(loop: Loop, at: shapely.Point, reach: float = math.inf) -> str:
    """The tag of the segment next to a place within reach, mm, if it works; at a corner both have to."""
    off = [float(shapely.distance(shapely.LineString(s.flatten(0.01)), at)) for s in loop.segments]
    near = [s.tag for s, far in zip(loop.segments, off, strict=True) if far <= min(off) + WALL]
    return loop.segments[off.index(min(off))].tag if min(off) <= reach and FELT.issuperset(near) else ""


def _is_middle(first: Motion, asked: Question) -> bool:
    for one in asked.pieces:
        for loop in one.outline.inner:
            hole = shapely.Polygon(loop.flatten())
            if shapely.contains_xy(hole, *first.start):
                centre = shapely.Point(shapely.maximum_inscribed_circle(hole).coords[0])
                return bool(shapely.distance(centre, shapely.Point(first.start)) <= asked.kerf / 10)
    return False


def _joins(line: shapely.LineString, first: Motion, asked: Question) -> list[str]:
    """Where a run first comes to the wall: not on a segment that works, if its loop has another."""
    start = shapely.Point(first.start)
    for one in asked.pieces:
        for loop in one.outline.loops:
            flags = [segment.tag in FELT for segment in loop.segments]
            if all(flags) or not any(flags):
                continue
            ring = shapely.LinearRing(loop.flatten())
            near = shapely.intersection(line, shapely.buffer(ring, asked.kerf / 2 + WALL / 2))
            if shapely.is_empty(near) or shapely.dwithin(start, ring, asked.kerf / 2 + WALL / 2):
                continue
            ends = [shapely.Point(shapely.get_coordinates(part)[0]) for part in shapely.get_parts(near)]
            at = min(ends, key=lambda end: shapely.line_locate_point(line, end))
            if tag := _felt_at(loop, at):
                return [f"line {first.line}: the lead meets {one.name} on a {tag}"]
    return []


def _compared(
    asked: Question,
    wanted: Sequence[shapely.Polygon],
    loose: Sequence[shapely.Geometry],
    left: shapely.Geometry,
) -> list[Check]:
    """Each piece against its outline; a piece on micro-joints is what is left where it stands."""
    shapes, order = [], []
    tree = shapely.STRtree(list(loose)) if loose else None
    for one, shape in zip(asked.pieces, wanted, strict=True):
        inside = shapely.buffer(shape, -WALL)
        own = [] if tree is None else [loose[k] for k in tree.query(inside, predicate="intersects")]
        if one.joints:
            shapes += _jointed(one, shape, own, left, asked)
        elif len(own) != 1:
            said = "is not cut free" if not own else f"falls in {len(own)} pieces"
            shapes.append(f"{one.name} {said}")
        else:
            shapes += _fits(one.name, own[0], shape, asked.kerf)
    freed = [shape for one, shape in zip(asked.pieces, wanted, strict=True) if not one.joints]
    kept = shapely.union_all(list(wanted)) if wanted else shapely.Polygon()
    waste = [one for one in loose if shapely.intersection(one, kept).area <= SPECK]
    slugs = sum(len(one.outline.inner) for one in asked.pieces)
    if len(loose) - len(waste) > len(freed):
        order.append(f"{len(loose) - len(waste)} pieces fall, {len(freed)} are wanted")
    return [
        _check("pieces", shapes, f"{len(wanted)} pieces within {1000 * WALL:g} µm, {slugs} openings"),
        _check("number of pieces", order),
    ]


def _fits(name: str, piece: shapely.Geometry, shape: shapely.Polygon, kerf: float) -> list[str]:
    """What a piece lacks, and what is on it that a round beam could have taken."""
    lack = shapely.difference(shape, shapely.buffer(piece, WALL))
    reach = shapely.buffer(shapely.buffer(shape, kerf / 2, quad_segs=64), -kerf / 2, quad_segs=64)
    over = shapely.difference(piece, shapely.buffer(reach, WALL))
    found = slots(name, shape, reach, kerf)
    for what, rest in (("cut into", lack), ("left on", over)):
        if rest.area > SPECK:
            x, y = rest.representative_point().coords[0]
            found.append(f"{name}: {rest.area:.4f} mm² {what} it at X{x:.3f} Y{y:.3f}")
    return found


def slots(name: str, shape: shapely.Polygon, reach: shapely.Geometry, kerf: float) -> list[str]:
    """What no beam of this width opens, and is deeper than any corner: a slot that it would leave full."""
    points = np.concatenate([np.asarray(ring.coords) for ring in (shape.exterior, *shape.interiors)])
    off = shapely.distance(shapely.points(points), shapely.boundary(reach))
    if off.max() <= kerf:
        return []
    x, y = points[int(off.argmax())]
    return [f"{name}: the slot at X{x:.2f} Y{y:.2f} is narrower than the kerf of {kerf:g} mm"]


def _jointed(
    one: TargetPiece,
    shape: shapely.Polygon,
    own: Sequence[shapely.Geometry],
    left: shapely.Geometry,
    asked: Question,
) -> list[str]:
    if own:
        return [f"{one.name} falls, and is to hang on {one.joints} micro-joints"]
    around = shapely.buffer(shape, asked.kerf / 2)
    ring = shapely.intersection(left, around.exterior)
    held = [part for part in shapely.get_parts(shapely.line_merge(ring)) if part.length > SPECK]
    if len(held) != one.joints:
        return [f"{one.name} hangs on {len(held)} micro-joints, not on {one.joints}"]
    wide = [
        part.length for part in held if abs(part.length - asked.joint_width) > 0.1 * asked.joint_width + WALL
    ]
    if wide:
        return [f"a micro-joint of {one.name} is {wide[0]:.3f} mm wide, not {asked.joint_width:g}"]
    # Beside its joints it is as any other.
    feet = shapely.buffer(shapely.union_all(held), asked.joint_width + asked.kerf)
    body = shapely.difference(shapely.intersection(left, shapely.buffer(shape, asked.kerf / 4)), feet)
    return _fits(one.name, body, shapely.difference(shape, feet), asked.kerf) if body.area else []


def _marks(reading: Reading, asked: Question) -> Check:
    """Marks are cut with little power, where they are wanted and nowhere else."""
    lit = [m for m in reading.motions if 0 < m.power <= asked.mark]
    wanted = [shapely.LineString(stroke) for one in asked.pieces for stroke in one.marks]
    drawn = shapely.union_all([way([m]) for m in lit]) if lit else shapely.LineString()
    aims = shapely.union_all(wanted) if wanted else shapely.LineString()
    faults = []
    if shapely.difference(drawn, shapely.buffer(aims, WALL)).length > WALL:
        faults.append("a mark where none is wanted")
    if shapely.difference(aims, shapely.buffer(drawn, WALL)).length > WALL:
        faults.append("a mark is missing")
    if sum(way([m]).length for m in lit) > aims.length + WALL:
        faults.append("a mark is cut more than once")
    return _check("marks", faults)
