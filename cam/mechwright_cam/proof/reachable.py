"""What cutters leave at a height of the part although nothing hinders them from going there.

Glossary
--------
layer
    Top, z in mm, and what has to stay from there down to the next layer.
rest
    What has to stay at a height, with all around it that no cutter gets at: the corners that its radius does
    not enter, and at the foot of a wall the fillet of its nose.

A cutter whose tip is at t may stand where at the top of every layer above t it is as far from what stays as
it is wide there. At the height z it then sweeps discs as wide as it is at z - t. A flat end mill does most
with its tip at z, and leaves the closing of the layer. A round one leaves less if it can go deeper: on the
floors, wherever it meets them, and below the underside with all of its nose. Heights in between, at which its
narrow end would go round corners step by step, do not count: that is no milling of walls.
"""

from collections.abc import Sequence
from dataclasses import dataclass, field

import numpy as np
import shapely

from mechwright_cam.proof.fillets import Fillet, stay
from mechwright_cam.proof.paths import NEAR
from mechwright_cam.proof.plane import Shape, closing, grow
from mechwright_cam.setup.views import SKIN
from mechwright_cam.shop.cutter import CORNER_SHARE, LEAST_SHARE, cutter, makes_floor
from mechwright_cam.shop.tool import Tool
from mechwright_plane.offsets import areas, polygons

Layer = tuple[float, Shape]


@dataclass(frozen=True)
class Surroundings:
    """What has to stay: layers from the top of the plate down, the fillets of floors, and the floors.

    ``floors`` are the heights z, mm, of the floors on which a tip may stand, with their plan views;
    ``underside`` is that of the plate.
    """

    layers: Sequence[Layer]
    underside: float
    floors: Sequence[Layer] = ()
    fillets: Sequence[Fillet] = ()
    blocked: dict[tuple[int, float, float], Shape] = field(
        default_factory=dict, init=False, repr=False, compare=False
    )
    """Where the axis of a cutter must not be, by its T number, the height of its tip and its play: every band
    asks for the same ones."""
    free: dict[tuple[int, int, float], Shape] = field(
        default_factory=dict, init=False, repr=False, compare=False
    )
    """Where it may be on a floor, by its T number, the index of the floor and its play."""


@dataclass(frozen=True)
class Reach:
    """The mills of a program."""

    mills: Sequence[Tool]
    """All of them, one at least."""
    play: float
    """Air on either side without which a cutter does not enter, mm."""
    through: float
    """How deep cuts through the plate are, mm: a cutter counts as far down as its flutes reach."""

    @property
    def flat(self) -> float:
        """Radius of the smallest flat end mill that cuts through, with its play, mm; inf if there is none."""
        return min((tool.radius + self.play for tool in self.mills if self._is_plain(tool)), default=np.inf)

    @property
    def plain(self) -> bool:
        """Whether all are flat end mills that cut through the plate, so that what stays is a closing."""
        return all(map(self._is_plain, self.mills))

    def _is_plain(self, tool: Tool) -> bool:
        return tool.nose == 0 and _cuts(tool, self.through)

    @property
    def noses(self) -> tuple[float, ...]:
        """The different corner radii of the round mills, mm."""
        return tuple(sorted({tool.nose for tool in self.mills if tool.nose > 0}))

    def least(self, height: float) -> float:
        """Radius of the narrowest mill at a height above its tip, mm."""
        return min(float(cutter(tool).radius_at(height)) for tool in self.mills)

    def rest(self, around: Surroundings, place: int, height: float) -> Shape:
        """What stays at ``height``, z in mm, in the layer of index ``place``."""
        top, layer = around.layers[place]
        solid = [one for one in (fillet.solid(height) for fillet in around.fillets) if not one.is_empty]
        keep = shapely.union_all([layer, *solid]) if solid else layer
        if np.isfinite(self.flat):
            found = closing(keep, self.flat)
        else:  # all that could stay, and more
            shapes = [layer, *(view for _, view in around.floors)]
            found = shapely.box(
                *grow(shapely.union_all(shapes), 2 * max(tool.diameter for tool in self.mills)).bounds
            )
        gone = []
        for tool in self.mills:
            if self._is_plain(tool) or (tool.radius + self.play >= self.flat and not around.fillets):
                continue
            others = [one for one in self.mills if not _is_ball(one)] if _is_ball(tool) else []
            if _cuts(tool, self.through + tool.nose) and not any(
                _cuts(one, self.through + one.nose) for one in others
            ):
                tip = around.underside - tool.nose
                blocked = self._blocked(tool, around, tip)
                left = shapely.union(keep, grow(blocked, -self._swept(tool, height - tip)))
                found = shapely.intersection(found, left)
            for at, (floor, _) in enumerate(around.floors):
                if floor < top - NEAR and _cuts(tool, -floor):
                    if others and self._served(others, around, at, tool):
                        continue
                    free = self._free(tool, around, at)
                    gone.append(grow(free, self._swept(tool, height - floor)))
        if gone:
            found = shapely.union(keep, shapely.difference(found, shapely.union_all(gone)))
        return areas(self._with_made(areas(found), around, place, height))

    def _served(self, others: Sequence[Tool], around: Surroundings, at: int, ball: Tool) -> bool:
        """Whether other mills make a floor, so that a ball, which makes none in good time, need not."""
        floor, view = around.floors[at]
        if any(abs(one.floor - floor) < NEAR and makes_floor(ball, one.radius) for one in around.fillets):
            return False
        for tool in others:
            if _cuts(tool, -floor):
                free = self._free(tool, around, at)
                if shapely.intersection(grow(free, tool.radius), view).area >= LEAST_SHARE * view.area:
                    return True
        return False

    def _with_made(self, rest: Shape, around: Surroundings, place: int, height: float) -> Shape:
        """In a recess with a fillet the corners that those mills leave which make it.

        Others would leave terraces there. A passage is no corner, nor is what no such mill enters.
        """
        left_by: dict[float, Shape] = {}  # by the radius of the fillet: in a nest many have the same
        for fillet in around.fillets:
            makers = [tool for tool in self.mills if makes_floor(tool, fillet.radius)]
            others = len(makers) < len(self.mills)
            if makers and others and fillet.floor <= height < -fillet.feature.top:
                if fillet.radius not in left_by:
                    reach = Reach(makers, self.play, self.through)
                    left_by[fillet.radius] = reach.rest(around, place, height)
                left = left_by[fillet.radius]
                # A skin into the wall, or rounding leaves a crack between the two.
                more = shapely.intersection(left, grow(fillet.inside, SKIN))
                wide = CORNER_SHARE * min(tool.radius for tool in makers)
                beyond = polygons(shapely.difference(more, rest))
                # Most are slivers: smaller than a disc of that radius, they need no closer look.
                passages = [
                    piece for piece in beyond if piece.area > wide**2 and not grow(piece, -wide).is_empty
                ]
                kept = polygons(shapely.difference(more, shapely.union_all(passages)))
                rest = shapely.union_all([rest, *kept])
        return rest

    def _swept(self, tool: Tool, height: float) -> float:
        """How far a cutter sweeps around its axis at a height above its tip, and its play, mm."""
        return float(cutter(tool).radius_at(height)) + self.play

    def _free(self, tool: Tool, around: Surroundings, at: int) -> Shape:
        """Where the axis of a cutter may be with its tip on the floor of this index."""
        key = tool.number, at, self.play
        if key not in around.free:
            floor, view = around.floors[at]
            blocked = self._blocked(tool, around, floor)
            around.free[key] = shapely.difference(grow(view, tool.radius), blocked)
        return around.free[key]

    def _blocked(self, tool: Tool, around: Surroundings, tip: float) -> Shape:
        """Where the axis of a cutter must not be with its tip at one height."""
        key = tool.number, tip, self.play
        if key not in around.blocked:
            around.blocked[key] = self._blocked_anew(tool, around, tip)
        return around.blocked[key]

    def _blocked_anew(self, tool: Tool, around: Surroundings, tip: float) -> Shape:
        blocked: list[tuple[float, Shape]] = []
        for top, keep in around.layers:  # of layers with one cross-section the highest asks for most
            if top > tip + NEAR and all(keep is not other for _, other in blocked):
                blocked.append((self._swept(tool, top - tip), keep))
        shapes = [grow(keep, away) for away, keep in blocked]
        for fillet in around.fillets:
            if tip >= fillet.floor + fillet.radius - NEAR:
                continue  # above it, layers say where the walls are
            off = stay(tool.nose, fillet.radius, tip - fillet.floor)
            shapes.append(grow(fillet.walls, tool.radius + off + self.play))
        return shapely.union_all(shapes)


def _is_ball(tool: Tool) -> bool:
    return tool.nose == tool.radius


def _cuts(tool: Tool, depth: float) -> bool:
    """Whether the flutes of a mill reach so deep, mm."""
    return tool.flute_length >= depth - NEAR
