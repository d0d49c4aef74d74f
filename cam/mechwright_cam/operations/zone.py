"""Zones: what has to be cut away around or inside a wall, between two heights.

Glossary
--------
keep
    What must stay.
clear
    What must go, from ``top`` to ``bottom``.
room
    Where the centre of a cutter may be, apart from the distance to ``keep``.
"""

from dataclasses import dataclass
from functools import cached_property, lru_cache
from typing import Literal

import shapely

from mechwright.tolerances import TOLERANCES
from mechwright_cam.operations.choice import HEAVY, radius_in, roughers
from mechwright_cam.operations.recess import Layer
from mechwright_cam.setup.holding import Tab
from mechwright_cam.setup.vice import RUN_OUT
from mechwright_cam.shop.settings import PathSettings
from mechwright_cam.shop.tool import Tool
from mechwright_plane.offsets import FINE, ROUGH, grow, simplified, thinned, valid_shape

SLACK = 0.02
"""Play in the width of a channel, mm, so that the path that opens it lies inside its room."""

TAB_SLACK = 4 * ROUGH
"""Roughing keeps off tabs by all that its thinned path may be off, mm."""

CUSP = TOLERANCES.leftover / 2
"""Height of what may stand between the cuts of a round mill on a floor, mm: half of what may stay."""

SNUG = TOLERANCES.gouge - TOLERANCES.arc_fit - 3 * TOLERANCES.flatten
"""A groove may be so much narrower on each side than the mill that makes it, mm: what the path and the
outline leave of the permitted gouge."""


@dataclass(frozen=True, eq=False)
class Zone:
    """A wall and what has to go in front of it; shapes in work coordinates, heights z in mm."""

    name: str
    wall: shapely.Geometry
    """The material that belongs to the part."""
    clear: shapely.Geometry
    top: float
    bottom: float
    kind: Literal["outside", "inside", "pocket"]
    mills: tuple[Tool, ...]
    """Those long enough, and for an outside with a channel that leaves a frame; largest first."""
    finishers: tuple[Tool, ...]
    """Those that finish the wall, one after the other: the last one is the finest."""
    path: PathSettings
    """How exact the wall is to be."""
    below: bool
    """Whether the cut ends below the underside of the plate."""
    must: shapely.Geometry | None = None
    """The feature itself, where ``clear`` runs out beyond its open stretches."""
    channel: shapely.Geometry | None = None
    """Outside: everything up to the far wall of the channel; None where the whole stock goes."""
    tabs: shapely.Geometry | None = None
    """What of the tabs stands between these heights."""
    slopes: tuple[Tab, ...] = ()
    """Ramped tabs between these heights: the cutter goes over them."""
    walls: tuple[Layer, ...] = ()
    """What stands around a recess from its floor up, where round mills are to make it."""
    floor_radius: float = 0.0
    """Fillet that is to stay between floor and wall, mm."""
    like: "Zone | None" = None
    """The zone of which it is a turned copy: the same mills reach as much of both."""

    @cached_property
    def keep(self) -> shapely.Geometry:
        """What must stay."""
        return self.wall if self.tabs is None else shapely.union(self.wall, self.tabs)

    @property
    def through(self) -> bool:
        """Whether nothing of the plate stays below."""
        return self.below or self.kind == "outside"

    @property
    def finisher(self) -> Tool:
        """The finest of the mills that finish."""
        return self.finishers[-1]

    @property
    def tools(self) -> tuple[Tool, ...]:
        """All mills that have something to do, in the order of their work."""
        return (*roughers(self.mills, self.finishers), *self.finishers)

    def waste(self, mill: Tool, allowance: float) -> shapely.Geometry:
        """What a mill that roughs leaves beside tabs, away from the part: it stays with the frame."""
        if self.tabs is None:
            return shapely.Polygon()
        beside = grow(self.tabs, mill.diameter + allowance, ROUGH)
        band = grow(self.thinned, self.finisher.diameter + allowance + HEAVY, ROUGH)
        return shapely.difference(beside, band)

    @property
    def in_the_open(self) -> bool:
        """Whether all of the plate around the part goes, so that the cutter may run out anywhere."""
        return self.kind == "outside" and self.channel is None

    @property
    def height(self) -> float:
        """Height of the layer, mm."""
        return self.top - self.bottom

    def bottom_for(self, mill: Tool) -> float:
        """How deep a mill goes, z in mm: out of the plate with all of its rounded corner."""
        return self.bottom - mill.nose if self.below else self.bottom

    def radius_of(self, mill: Tool) -> float:
        """Radius of a mill at the top of the lowest wall, mm; above that a high nose is wider."""
        return radius_in(mill, self.walls[0][0]) if self.walls else mill.radius

    def blocked(self, mill: Tool, away: float, allowance: float | None = None) -> shapely.Geometry:
        """Where the centre of a mill must not be, ``away`` mm and what it is wide there off what must stay.

        With an ``allowance`` for roughing: that much stays on the walls besides, which are thinned.
        """
        radius = self.radius_of(mill) + away
        near = (
            valid_shape(grow(self.keep, radius)) if allowance is None else self.rough_keep(allowance, radius)
        )
        if self.radius_of(mill) == mill.radius:
            return near
        more = away + (allowance or 0.0)
        higher = [grow(wall, radius_in(mill, height) + more) for height, wall in self.walls[1:]]
        return shapely.union_all([near, *higher]) if higher else near

    def allowance_for(self, mill: Tool, allowance: float) -> float:
        """What a mill leaves on the wall, mm, so that a fillet stays at its foot.

        A corner of radius c at a distance a from the wall touches a fillet of radius f if a + c = f.
        """
        return max(allowance, self.floor_radius - mill.nose)

    @property
    def reach_radius(self) -> float:
        """Radius of the finisher as far as it reaches into corners, mm."""
        return self.radius_of(self.finisher)

    def room(self, radius: float, slack: float = 0.0, *, finishing: bool = False) -> shapely.Geometry:
        """Where the centre of a cutter of this radius may be, and ``slack`` beyond."""
        if self.kind == "outside":
            if self.channel is None:
                return grow(self.clear, radius + (RUN_OUT if finishing else 0.0), ROUGH)
            return grow(self.channel, slack - radius, ROUGH)
        if self.must is not None and finishing:
            # Past the end of a wall and around its corner, but not on along the outside.
            return shapely.intersection(self.clear, grow(self.must, radius + self.path.bias + 2 * FINE))
        return self.clear

    def rough_keep(self, allowance: float, radius: float = 0.0) -> shapely.Geometry:
        """``keep`` with stock on the part's walls, and next to none on the tabs, thinned.

        With a ``radius`` it is what the centre of a cutter must not enter: grown by that, tabs apart, for the
        layers above and below their tops have the same wall.
        """
        known = self._rough
        if (allowance, radius) not in known:
            wall = _with_allowance(self.thinned, allowance)
            if radius > 0:
                wall = _grown(wall, radius)
            if self.tabs is not None:
                wall = shapely.union(wall, grow(self.tabs, min(allowance, TAB_SLACK) + radius, ROUGH))
            known[allowance, radius] = wall
        return known[allowance, radius]

    @cached_property
    def _rough(self) -> dict[tuple[float, float], shapely.Geometry]:
        """What :meth:`rough_keep` has given."""
        return {}

    @cached_property
    def thinned(self) -> shapely.Geometry:
        """``wall`` for roughing."""
        return thinned(self.wall)


@lru_cache(maxsize=16)
def _with_allowance(wall: shapely.Geometry, allowance: float) -> shapely.Geometry:
    """A thinned wall with stock on it; layers above and below tabs have the same."""
    return simplified(grow(wall, allowance, ROUGH), ROUGH / 2)


@lru_cache(maxsize=16)
def _grown(wall: shapely.Geometry, radius: float) -> shapely.Geometry:
    """A wall for roughing as far as the centre of a cutter may come."""
    return grow(wall, radius, ROUGH)
