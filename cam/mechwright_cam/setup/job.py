"""A job: one part, its stock, its holding and its cutters, in work coordinates.

Glossary
--------
work coordinates
    Those of the work offset: x and y from the origin that the design file names, z = 0 on top of the stock.
target
    The finished part seen from above.
keep
    What must stay at a height: the target, and below the top of the tabs the tabs as well.
body
    What features lie in: the target, and when the plate has been turned over the part in it.
cut
    What the cutters leave of the target's surroundings: the target with the corners filled that a round
    cutter cannot enter.

Planner and proof both start from a job and from nothing else, so that the proof does not depend on the plan.
"""

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import Literal

import shapely

from mechwright.contracts.details import Detail, moved
from mechwright.contracts.part import Feature, Part, is_outside
from mechwright.geometry.segments import Point
from mechwright_cam.setup.holding import Clamp, Jaw, Tab, ToeClamp
from mechwright_cam.setup.turned import Frame, TurnedOver
from mechwright_cam.shop.settings import CamSettings
from mechwright_cam.shop.tool import MILLS, Tool, ToolKind
from mechwright_plane.nest import moved_feature

LEVEL = 1e-6
"""Heights nearer than this are one, mm: far below the last decimal of a program."""

LEAST_TURN = 0.05
"""With cutter compensation the tool's centre turns on at least this radius in an inside corner, mm, however
large D is: on a smaller one rounding to three decimals would change its direction by degrees."""


PEELED = 1.3
"""Width of a channel that is opened with bounded engagement, in diameters of its mill: wider ones take longer
loops, and narrower ones more of them."""


def wear_margin(settings: CamSettings) -> float:
    """By so much a cutter reaches less far into corners than its radius alone would let it, mm."""
    return 0.0 if settings.compensation == "computer" else settings.wear_limit + LEAST_TURN


@dataclass(frozen=True)
class Air:
    """What earlier setups have cut from the other side: nothing stands there below ``top``."""

    shape: shapely.Geometry
    """Plan view in work coordinates."""
    top: float
    """Height z, mm: 0 where they have cut through."""


def air_below(gone: Sequence[Air], z: float) -> shapely.Geometry:
    """Where nothing stands below a height z, mm; for 0, where earlier setups have cut through."""
    return shapely.union_all([air.shape for air in gone if air.top >= z - LEVEL])


@dataclass(frozen=True)
class Job:
    """Everything that planning and proof need to know; what holds the part is one of four."""

    part: Part
    """A plate part, or a nest of several."""
    settings: CamSettings
    tools: tuple[Tool, ...]
    """The cutters that may be used."""
    origin: Point
    """Where X0 Y0 lies in the part's own coordinates, mm."""
    stock: tuple[float, float, float, float]
    """Least x, least y, greatest x, greatest y of the plate, work coordinates, mm."""
    tabs: tuple[Tab, ...] = ()
    clamp: Clamp | None = None
    jaws: tuple[Jaw, ...] = ()
    toes: tuple[ToeClamp, ...] = ()
    """The clamps on the plate, if those hold it."""
    side: Literal["top", "underside"] = "top"
    """The underside is on top where the plate has been turned over."""
    gone: tuple[Air, ...] = ()
    """What of the plate earlier setups have cut away, by height; higher regions lie in lower ones."""
    planned: bool = True
    """Whether programs are planned by the settings; those of other hands answer for what is set alone."""
    pick_up: tuple[Point, ...] = ()
    """Middle of the bore, or of the two dowels, by which a plate turned over is found, work coordinates."""

    @property
    def thickness(self) -> float:
        """Thickness of part and stock, mm: the underside is at z = -thickness."""
        return self.part.thickness

    @property
    def floor(self) -> float:
        """Depth of through cuts, z in mm."""
        return -self.thickness - self.settings.breakthrough

    @property
    def highest(self) -> float:
        """Height z of the highest thing known to be over the table: the stock's top, 0, or what holds it."""
        things = (self.clamp, *self.jaws, *self.toes)
        return max(0.0, *(thing.top for thing in things if thing is not None), 0.0)

    @property
    def datum(self) -> Point:
        """X and Y of the edges of the stock from which X0 and Y0 are found, mm: left and front.

        When the plate has been turned over they are the same two edges, on its right or rear then: only so
        do both sides meet in a plate that is not as large as stated.
        """
        x0, y0, x1, y1 = self.stock
        flip = self.settings.second_side.flip if self.side == "underside" else ""
        return x1 if flip == "y" else x0, y1 if flip == "x" else y0

    def air_below(self, z: float) -> shapely.Geometry:
        """Where earlier setups have left nothing below a height z, mm; for 0, where they have cut through."""
        return air_below(self.gone, z)

    @cached_property
    def target(self) -> shapely.Geometry:
        """The finished part seen from above; of a nest all parts."""
        plates = [outline.polygon() for outline in self.part.outlines]
        whole = plates[0] if len(plates) == 1 else shapely.MultiPolygon(plates)
        return shapely.transform(whole, lambda points: points - (self.origin[0], self.origin[1]))

    @cached_property
    def frame(self) -> Frame | None:
        """What tells the part from its frame, if the plate has been turned over."""
        if not isinstance(self.part, TurnedOver):
            return None
        frame = self.part.frame
        shapes = (frame.body, frame.part, frame.holds)
        return Frame(*(shapely.transform(shape, lambda points: points - self.origin) for shape in shapes))

    @property
    def body(self) -> shapely.Geometry:
        """What features lie in; beyond it they are open, and nothing of them has to be cut."""
        return self.target if self.frame is None else self.frame.body

    @cached_property
    def features(self) -> tuple[Feature, ...]:
        """The part's features in work coordinates."""
        x, y = -self.origin[0], -self.origin[1]
        return tuple(moved_feature(feature, x, y) for feature in self.part.features)

    @property
    def inner(self) -> list[Feature]:
        """The features apart from outsides."""
        return [feature for feature in self.features if not is_outside(feature)]

    @cached_property
    def details(self) -> tuple[Detail, ...]:
        """The part's details in work coordinates."""
        return tuple(moved(detail, -self.origin[0], -self.origin[1]) for detail in self.part.details)

    def reach(self, tool: Tool) -> float:
        """Radius by which a finishing tool reaches into corners, mm.

        With cutter compensation that of the largest D allowed, and a little more: no inside corner of the
        contour is narrower.
        """
        return tool.radius + self.wear_margin

    @property
    def wear_margin(self) -> float:
        """That of the settings, see :func:`wear_margin`."""
        return wear_margin(self.settings)

    def tools_of(self, kind: ToolKind) -> list[Tool]:
        """The tools of a kind that cut the material, widest first."""
        fit = (tool for tool in self.tools if tool.kind is kind and self.part.material in tool.cutting)
        return sorted(fit, key=lambda tool: -tool.diameter)

    @property
    def end_mills(self) -> tuple[Tool, ...]:
        """The flat end mills, largest first."""
        return tuple(tool for tool in self.mills if tool.kind is ToolKind.END_MILL)

    @property
    def mills(self) -> tuple[Tool, ...]:
        """The end mills, bull noses and balls, largest first; of one diameter the roundest first."""
        mills = [tool for tool in self.tools if tool.kind in MILLS]
        return tuple(sorted(mills, key=lambda tool: (-tool.diameter, -tool.nose)))
