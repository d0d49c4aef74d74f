"""What STEP files hold of a machine: volumes and places of bodies, and round faces that go into each other."""

import math
import tempfile
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from functools import lru_cache
from pathlib import Path

import cadquery as cq
import numpy as np
from cam.step_read import read_step_solids
from OCP.BRepAdaptor import BRepAdaptor_Surface
from OCP.GeomAbs import GeomAbs_SurfaceType
from OCP.TopAbs import TopAbs_Orientation

from mechwright.arrays import Array
from mechwright.contracts.part import Part
from mechwright.mechanics.mating.rounds import Round, rounds_of
from mechwright.standards import circlips, shims
from mechwright_cad.assembly_order.plan import Plan
from mechwright_cad.contacts.screw_joints import screw_of

CLOSE = 0.1
"""Diameters of a pair differ by less, mm: a wider hole is room."""

ASIDE, ALONG = 0.05, 0.3
"""How far apart the axes of a pair are at most, and how far one is in the other at least, mm."""

SMALL = 1e-3
"""Share by which volumes of the same body may differ, and distance of their centres, mm."""

RINGS = circlips.STANDARDS | {shims.STANDARD}
"""Standards of rings that lie on a shaft and fit nothing."""

Piece = tuple[float, float, float, Array, Array]
"""A face of a cylinder: where it begins and ends, how far it goes round, rad, a point of its axis, the axis."""


@dataclass(frozen=True)
class Cylinder:
    """A round face: a point of its axis (3,), the axis (3,), where it begins and ends along it, mm."""

    at: Array
    axis: Array
    diameter: float
    inside: bool
    low: float
    high: float

    def moved(self, turn: Array, shift: Array) -> "Cylinder":
        """The same in another place."""
        at, axis = turn @ self.at + shift, turn @ self.axis
        return Cylinder(at, axis, self.diameter, self.inside, self.low, self.high)


@dataclass(frozen=True)
class Solid:
    """A solid: volume, mm³, centre (3,), mm, and the round faces that go round more than half."""

    volume: float
    centre: Array
    cylinders: tuple[Cylinder, ...]


@lru_cache(maxsize=256)
def read_solids(content: bytes) -> tuple[Solid, ...]:
    """All solids of a STEP file."""
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / "part.step"
        path.write_bytes(content)
        found = read_step_solids(path)
    return tuple(
        Solid(one.Volume(), np.array(one.Center().toTuple()), tuple(_cylinders(one))) for one in found
    )


def _cylinders(solid: cq.Solid) -> Iterator[Cylinder]:
    pieces: dict[tuple[float, ...], list[Piece]] = {}
    for face in solid.Faces():
        surface = BRepAdaptor_Surface(face.wrapped)
        if surface.GetType() != GeomAbs_SurfaceType.GeomAbs_Cylinder:
            continue
        cylinder = surface.Cylinder()
        axis, place = cylinder.Axis().Direction(), cylinder.Axis().Location()
        way, at = np.array((axis.X(), axis.Y(), axis.Z())), np.array((place.X(), place.Y(), place.Z()))
        sign = 1.0 if tuple(way.round(6)) > (0.0, 0.0, 0.0) else -1.0
        start = float(at @ way)
        at = at - start * way
        ends = sorted(sign * (start + end) for end in (surface.FirstVParameter(), surface.LastVParameter()))
        reversed_ = face.wrapped.Orientation() == TopAbs_Orientation.TopAbs_REVERSED
        inside = reversed_ == cylinder.Position().Direct()
        diameter = 2 * cylinder.Radius()
        key = (*at.round(3), *(sign * way).round(5), round(diameter, 4), float(inside))
        turn = surface.LastUParameter() - surface.FirstUParameter()
        pieces.setdefault(tuple(map(float, key)), []).append((ends[0], ends[1], turn, at, sign * way))
    for key, those in pieces.items():
        for some in _stretches(those):
            around = sum(turn * (high - low) for low, high, turn, _, _ in some)
            low, high = min(one[0] for one in some), max(one[1] for one in some)
            if around > math.pi * (high - low):
                yield Cylinder(some[0][3], some[0][4], key[6], bool(key[7]), low, high)


def _stretches(pieces: Sequence[Piece]) -> Iterator[list[Piece]]:
    """Pieces of one cylinder that follow each other along it without a gap."""
    found: list[Piece] = []
    for one in sorted(pieces, key=lambda piece: piece[:2]):
        if found and one[0] > max(other[1] for other in found) + ASIDE:
            yield found
            found = []
        found.append(one)
    yield found


def solid_faults(parts: Sequence[Part], plan: Plan, solids: Mapping[str, Sequence[Solid]]) -> Iterator[str]:
    """Bodies that are not once in the assembly, and bores and seats whose size is not the drawn one."""
    yield from _places(plan, solids)
    for part in parts:
        if part.bought is None and part.name in solids and not part.marks:
            yield from _sizes(part, [c for one in solids[part.name] for c in one.cylinders])


def _sizes(part: Part, cylinders: Sequence[Cylinder]) -> Iterator[str]:
    """Holes in the middle of their limits, pins at their nominal size: that is how models are made."""
    bores = [one for one in part.features if getattr(one, "fit", None) is not None]
    for bore in bores:
        near = [c for c in cylinders if c.inside and math.dist(c.at[:2], bore.centre) < SMALL]
        low, high = bore.fit.limits
        if not any(low <= c.diameter <= high for c in near):
            sizes = ", ".join(f"{c.diameter:.4f}" for c in near) or "none"
            yield f"{part.name}.step: {bore.name} is ⌀{sizes}, and the limits are {low:.4f} to {high:.4f}"
    for step in part.turned.steps if part.turned is not None else ():
        if step.fit is not None:
            low, high = step.fit.limits
            sizes = [c.diameter for c in cylinders if not c.inside]
            if not any(abs(d - step.fit.size) < SMALL or low <= d <= high for d in sizes):
                yield f"{part.name}.step: no step of ⌀{step.fit.text}"


def _places(plan: Plan, solids: Mapping[str, Sequence[Solid]]) -> Iterator[str]:
    left = list(solids.get("assembly", ()))
    for body in plan.bodies:
        for one in solids.get(body.part.name, ()):
            poses = plan.motion.poses[body.instance.body]
            lift = one.centre + np.array((0.0, 0.0, body.instance.z))
            centre = poses.rotation[0] @ lift + poses.position[0]
            same = [
                other
                for other in left
                if abs(other.volume - one.volume) <= SMALL * one.volume
                and np.linalg.norm(other.centre - centre) < 10 * SMALL
            ]
            if not same:
                yield f"assembly.step: {body.name} is not there"
            else:
                left.remove(same[0])
    if left:
        yield f"assembly.step: {len(left)} solids that are no bodies"


def pair_faults(plan: Plan, solids: Mapping[str, Sequence[Solid]]) -> Iterator[str]:
    """Round faces in each other of which one has no limits."""
    faces = [
        (k, one.moved(turn, place + body.instance.z * turn[:, 2]))
        for k, body in enumerate(plan.bodies)
        for turn, place in ((body.poses.rotation[plan.sample], body.poses.position[plan.sample]),)
        for solid in solids.get(body.part.name, ())
        for one in solid.cylinders
    ]
    pins = [(k, one) for k, one in faces if not one.inside]
    holes = [(k, one) for k, one in faces if one.inside]
    if not pins or not holes:
        return
    told = set()
    known = [rounds_of(body, plan.sample) for body in plan.bodies]
    for (m, pin), (k, hole) in _in_each_other(pins, holes):
        bodies = [plan.bodies[n].part for n in (m, k)]
        names = (bodies[0].name, bodies[1].name)
        standards = {part.bought.standard for part in bodies if part.bought is not None}
        if names in told or screw_of(bodies[0]) is not None or standards & RINGS:
            continue
        silent = [
            part.name
            for n, part, one in ((m, bodies[0], pin), (k, bodies[1], hole))
            if not any(_same(one, face) and (face.fit is not None or face.threaded) for face in known[n])
        ]
        if silent:
            told.add(names)
            yield f"{names[0]} in {names[1]}, ⌀{pin.diameter:.3f}: no limits in {' and '.join(silent)}"


def _in_each_other(
    pins: Sequence[tuple[int, Cylinder]], holes: Sequence[tuple[int, Cylinder]]
) -> Iterator[tuple[tuple[int, Cylinder], tuple[int, Cylinder]]]:
    sizes = np.array([one.diameter for _, one in holes])
    ways, points = np.array([one.axis for _, one in holes]), np.array([one.at for _, one in holes])
    for m, pin in pins:
        away = pin.at - points
        aside = np.linalg.norm(away - (away * ways).sum(axis=1)[:, None] * ways, axis=1)
        fits = (abs(sizes - pin.diameter) < CLOSE) & (abs(ways @ pin.axis) > 1 - 1e-6) & (aside < ASIDE)
        for n in np.flatnonzero(fits).tolist():
            k, hole = holes[n]
            sign, start = float(np.sign(hole.axis @ pin.axis)), float(away[n] @ ways[n])
            low, high = sorted((start + sign * pin.low, start + sign * pin.high))
            if k != m and min(high, hole.high) - max(low, hole.low) > ALONG:
                yield (m, pin), (k, hole)


def _same(one: Cylinder, face: Round) -> bool:
    away = one.at - face.at
    aside = np.linalg.norm(away - (away @ face.axis) * face.axis)
    return face.inside == one.inside and abs(face.diameter - one.diameter) < ASIDE and bool(aside < ASIDE)
