"""Which tool gets to a screw, a circlip or a coupling, and what stands in its way.

A hexagon key needs a column over the socket and a sector in which it swings; a bit needs a cylinder along the
axis; a ball end is tilted. Pliers for circlips need a cylinder beside the shaft. Each body that a tool would
cut is one that has to come later.
"""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from typing import Literal

import numpy as np
from manifold3d import CrossSection, Manifold

from mechwright.arrays import Array
from mechwright.errors import DesignError
from mechwright.standards import circlips
from mechwright.standards.hexagon_keys import (
    BIT_LENGTH,
    PLIERS,
    SWING,
    TILT,
    HexagonKey,
    bit_diameter,
    hexagon_key,
)
from mechwright_cad.assembly_order.groups import BodyLayers
from mechwright_cad.assembly_order.layers import frame_of
from mechwright_cad.bodies import Body, is_coupling
from mechwright_cad.contacts.screw_joints import Screwed, screw_of

Tool = Literal["key", "long key", "bit", "ball end", "pliers"]

AZIMUTHS = 12
"""Directions about an axis in which a tool is tried."""

BITE = 0.05
"""Volume, mm³, that a tool may share with a body: chords of round faces."""

CLAMP_KEY = 2.5
"""Width of the key for the clamping screws of couplings, mm."""

ALONG = 0.5
"""Product of a way and an axis above which the way leads along the axis."""

_CORNERS = 24
"""Of a round tool."""


@dataclass(frozen=True)
class Access:
    """A tool in one position, and the numbers of the bodies that it would cut there."""

    tool: Tool
    blockers: frozenset[int]


class Reach:
    """The accesses to all that needs a tool, best tool first; each is looked for once."""

    def __init__(self, bodies: Sequence[Body], sample: int, standing: BodyLayers) -> None:
        self.bodies, self.sample, self.standing = tuple(bodies), sample, standing
        self._boxes = np.array([standing.box(k) for k in range(len(self.bodies))])
        self._known: dict[tuple[int, tuple[float, ...]], list[Access]] = {}

    def needs_tool(self, number: int) -> bool:
        """Whether a body is a screw, a circlip or a coupling."""
        part = self.bodies[number].part
        standard = part.bought.standard if part.bought is not None else ""
        return screw_of(part) is not None or standard in circlips.STANDARDS or is_coupling(part)

    def accesses(self, number: int, way: Array) -> list[Access]:
        """All accesses to a body that comes along a way, up to the first that nothing ever blocks."""
        key = (number, tuple(way.round(6).tolist()))
        if key not in self._known:
            found: list[Access] = []
            for access in self._tried(number, way):
                found.append(access)
                if not access.blockers:
                    break
            self._known[key] = found
        return self._known[key]

    def tool(self, number: int, way: Array, there: frozenset[int]) -> Tool | None:
        """The tool that gets to a body while others stand there; None if none does."""
        free = (one.tool for one in self.accesses(number, way) if not one.blockers & there)
        return next(free, None)

    def always_in_the_way(self, number: int, way: Array) -> frozenset[int]:
        """Bodies each of which alone keeps every tool away."""
        found = [one.blockers for one in self.accesses(number, way)]
        return frozenset.intersection(*found) if found else frozenset()

    def _tried(self, number: int, way: Array) -> Iterator[Access]:
        body = self.bodies[number]
        screw = screw_of(body.part)
        axis = body.poses.rotation[self.sample][:, 2]
        foot = body.poses.position[self.sample] + body.instance.z * axis
        if screw is not None and screw.head:
            yield from self._keys(number, screw, foot, -screw.tip * axis)
        elif screw is not None:  # a stud may be turned end for end: its socket looks to the fitter
            along = -way if abs(way @ axis) > ALONG else -screw.tip * axis
            near = along @ axis * screw.tip < 0
            end = foot if near else foot + screw.length * screw.tip * axis
            yield from self._keys(number, screw, end, along)
        elif is_coupling(body.part):
            yield from self._clamps(number, foot, axis)
        else:
            yield from self._pliers(number, foot, axis, way)

    def _keys(self, number: int, screw: Screwed, seat: Array, out: Array) -> Iterator[Access]:
        of = screw.of
        height, deep = {"4762": (of.head_height, of.socket), "10642": (0.0, of.sunk_socket)}.get(
            screw.standard, (0.0, of.set_socket)
        )
        frame, top = frame_of(out), seat + height * out
        try:
            key = hexagon_key(screw.key)
        except DesignError:
            key = None
        if key is not None:
            arms: tuple[tuple[Tool, float, float], ...] = (
                ("key", key.short, key.long),
                ("long key", key.long, key.short),
            )
            for tool, up, arm in arms:
                column = self._cut(number, _cylinder(key.width, up - deep), frame, top)
                for turn in range(AZIMUTHS):
                    swing = _sector(key.width, up - deep, arm, turn)
                    yield Access(tool, column | self._cut(number, swing, frame, top))
        bit = _cylinder(bit_diameter(of.size), BIT_LENGTH)
        yield Access("bit", self._cut(number, bit, frame, top))
        for turn in range(AZIMUTHS if key is not None else 0):
            assert key is not None  # noqa: S101 - the range is empty without one
            yield Access("ball end", self._cut(number, _tilted(key, deep, turn), frame, top))

    def _clamps(self, number: int, foot: Array, axis: Array) -> Iterator[Access]:
        """From the side; the shaft can be turned, so one direction is enough."""
        shape = self.bodies[number].part.bought
        if shape is None or shape.shape is None:
            return
        (corners,) = (piece.profile for piece in shape.shape.pieces if hasattr(piece, "profile"))
        outside, length = max(r for r, _ in corners), max(z for _, z in corners)
        key = _cylinder(CLAMP_KEY, hexagon_key(CLAMP_KEY).long)
        u, v, _ = frame_of(axis)
        for turn in 2 * np.pi * np.arange(AZIMUTHS) / AZIMUTHS:
            out = np.cos(turn) * u + np.sin(turn) * v
            for share in (0.25, 0.75):
                start = foot + share * length * axis + outside * out
                yield Access("key", self._cut(number, key, frame_of(out), start))

    def _pliers(self, number: int, foot: Array, axis: Array, way: Array) -> Iterator[Access]:
        bought = self.bodies[number].part.bought
        if bought is None:
            return
        size, thick = (float(x) for x in bought.designation.split(" - ")[1].split(" x "))
        out = -way if abs(way @ axis) > ALONG else axis
        start = foot + (thick if out @ axis > 0 else 0.0) * axis
        wide, long = PLIERS
        side = 1.0 if bought.standard == circlips.ON_SHAFTS else -1.0
        far = max(size / 2 + side * wide / 2, 0.0)
        frame = frame_of(out)
        for turn in 2 * np.pi * np.arange(AZIMUTHS) / AZIMUTHS:
            beside = start + far * (np.cos(turn) * frame[0] + np.sin(turn) * frame[1])
            yield Access("pliers", self._cut(number, _cylinder(wide, long), frame, beside))

    def _cut(self, number: int, tool: Manifold, frame: Array, at: Array) -> frozenset[int]:
        """Numbers of bodies that a tool cuts whose own z goes along the frame's third row from a point."""
        placed = tool.transform(np.column_stack((frame.T, at)))
        low, high = np.reshape(placed.bounding_box(), (2, 3))
        near = (self._boxes[:, 0] < high).all(axis=1) & (low < self._boxes[:, 1]).all(axis=1)
        near[number] = False
        return frozenset(
            k for k in np.flatnonzero(near).tolist() if (placed ^ self.standing.solid(k)).volume() > BITE
        )


def _cylinder(width: float, length: float) -> Manifold:
    return Manifold.cylinder(max(length, 1.0), width / 2, circular_segments=_CORNERS)


def _sector(width: float, height: float, arm: float, turn: int) -> Manifold:
    """What the free arm sweeps, its upper side at a height over the head."""
    start = 2 * np.pi * turn / AZIMUTHS
    angles = start + np.linspace(0.0, np.radians(SWING), 7)
    rim = arm * np.column_stack((np.cos(angles), np.sin(angles)))
    flat = CrossSection([np.vstack(((0.0, 0.0), rim))])
    return Manifold.extrude(flat, width).translate((0.0, 0.0, max(height - width, 0.0)))


def _tilted(key: HexagonKey, deep: float, turn: int) -> Manifold:
    tool = _cylinder(key.width, key.long - deep)
    return tool.rotate((TILT, 0.0, 0.0)).rotate((0.0, 0.0, 360.0 * turn / AZIMUTHS))


def blockers_of(accesses: Sequence[Access], there: frozenset[int]) -> frozenset[int]:
    """Bodies that stand in the way of the tool which fewest block."""
    found = [one.blockers & there for one in accesses]
    return min(found, key=lambda some: (len(some), sorted(some)), default=frozenset())
