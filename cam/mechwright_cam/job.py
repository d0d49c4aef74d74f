"""A job: one part, its stock, its holding and its cutters, in work coordinates.

Glossary
--------
work coordinates
    Those of the work offset: x and y from the origin that the design file names, z = 0 on top of the stock.
target
    The finished part seen from above.
keep
    What must stay at a height: the target, and below the top of the tabs the tabs as well.
cut
    What the cutters leave of the target's surroundings: the target with the corners filled that a round
    cutter cannot enter.

Planner and proof both start from a job and from nothing else, so that the proof does not depend on the plan.
"""

from collections.abc import Sequence
from dataclasses import dataclass, field, replace
from functools import cached_property
from typing import Literal

import shapely

from mechwright.details import Detail, moved
from mechwright.errors import DesignError, GeometryError
from mechwright.geometry.segments import Point
from mechwright.part import Bore, Feature, Part, Profile
from mechwright.tooling import CamSettings, Tool, ToolKind
from mechwright_cam.nest import Nest, moved_feature, outlines_of
from mechwright_cam.tabs import Tab, lay_tabs


@dataclass(frozen=True)
class Clamp:
    """A round clamp on the part that the cutter and its holder must go around or over."""

    centre: Point
    diameter: float
    top: float


@dataclass(frozen=True)
class Job:
    """Everything that planning and proof need to know.

    Parameters
    ----------
    part
        A plate part, or a nest of several.
    settings
        The table ``[cam]``.
    tools
        The cutters that may be used.
    origin
        Where X0 Y0 lies in the part's own coordinates, mm.
    stock
        Least x, least y, greatest x, greatest y of the plate, work coordinates, mm.
    tabs
        Bridges that hold the part; empty if a clamp does.
    clamp
        The bore clamp, if that holds the part.
    side
        ``"underside"`` if the plate has been turned over.
    gone
        What of the plate earlier setups have cut away from top to bottom, work coordinates.
    pick_up
        Middle of the bore by which a plate that has been turned over is picked up, work coordinates.
    """

    part: Part
    settings: CamSettings
    tools: tuple[Tool, ...]
    origin: Point
    stock: tuple[float, float, float, float]
    tabs: tuple[Tab, ...] = ()
    clamp: Clamp | None = None
    side: Literal["top", "underside"] = "top"
    gone: shapely.Geometry = field(default_factory=shapely.Polygon)
    pick_up: Point | None = None

    @property
    def thickness(self) -> float:
        """Thickness of part and stock, mm: the underside is at z = -thickness."""
        return self.part.thickness

    @property
    def floor(self) -> float:
        """Depth of through cuts, z in mm."""
        return -self.thickness - self.settings.breakthrough

    @cached_property
    def target(self) -> shapely.Geometry:
        """The finished part seen from above; of a nest all parts."""
        plates = [outline.polygon() for outline in outlines_of(self.part)]
        whole = plates[0] if len(plates) == 1 else shapely.MultiPolygon(plates)
        return shapely.transform(whole, lambda points: points - (self.origin[0], self.origin[1]))

    @cached_property
    def features(self) -> tuple[Feature, ...]:
        """The part's features in work coordinates."""
        x, y = -self.origin[0], -self.origin[1]
        return tuple(moved_feature(feature, x, y) for feature in self.part.features)

    @cached_property
    def details(self) -> tuple[Detail, ...]:
        """The part's details in work coordinates."""
        return tuple(moved(detail, -self.origin[0], -self.origin[1]) for detail in self.part.details)

    @property
    def end_mills(self) -> tuple[Tool, ...]:
        """The end mills, largest first."""
        mills = [tool for tool in self.tools if tool.kind is ToolKind.END_MILL]
        return tuple(sorted(mills, key=lambda tool: -tool.diameter))


def make_job(part: Part, settings: CamSettings, tools: Sequence[Tool]) -> Job:
    """Lay a plate part into its stock and decide how it is held.

    Raises
    ------
    GeometryError
        The part is no plate.
    DesignError
        The stock is too small, or the part has no bore to be held by.
    """
    if part.outline is None:
        raise GeometryError(f"part {part.name} is no plate: it has no outline to mill")
    x0, y0, x1, y1 = part.outline.bounds
    widest = max((tool.diameter for tool in tools if tool.kind is ToolKind.END_MILL), default=0.0)
    wanted = settings.stock
    if wanted.length is not None and wanted.width is not None:
        mx, my = (wanted.length - (x1 - x0)) / 2, (wanted.width - (y1 - y0)) / 2
    else:
        # A frame has to stay around the channel that the largest cutter opens: 3 mm is stiff enough for tabs.
        mx = my = widest + 3.0 if wanted.margin is None else wanted.margin
    if min(mx, my) < 0:
        raise DesignError(
            f"cam.stock: the part {part.name} is {x1 - x0:.1f} x {y1 - y0:.1f} mm and does not fit into "
            f"{wanted.length:g} x {wanted.width:g} mm; take a larger plate"
        )
    stock = (x0 - mx, y0 - my, x1 + mx, y1 + my)
    origin = {
        "axis": (0.0, 0.0),
        "corner": (stock[0], stock[1]),
        "centre": ((stock[0] + stock[2]) / 2, (stock[1] + stock[3]) / 2),
    }[settings.origin]
    placed = Job(
        part,
        settings,
        tuple(tools),
        origin,
        (stock[0] - origin[0], stock[1] - origin[1], stock[2] - origin[0], stock[3] - origin[1]),
    )
    if settings.hold.method == "bore":
        if isinstance(part, Nest):
            raise DesignError(
                f"cam.hold.method: the {len(part.placed)} parts of {part.name} are cut in one setup and "
                'cannot be clamped one by one; use method = "tabs", or no cam.nest'
            )
        return replace(placed, clamp=_clamp(placed))
    return replace(placed, tabs=lay_tabs(placed, max(mx, my)))


def _clamp(job: Job) -> Clamp:
    bores = [feature for feature in job.features if isinstance(feature, Bore)]
    openings = [f for f in job.features if isinstance(f, Profile) and f.side == "inside"]
    if bores:
        centre = max(bores, key=lambda bore: bore.diameter).centre
    elif openings:
        middle = shapely.Polygon(openings[0].loop.flatten()).centroid
        centre = (middle.x, middle.y)
    else:
        raise DesignError(
            f'cam.hold.method: part {job.part.name} has no bore to be held by; use method = "tabs"'
        )
    hold = job.settings.hold
    return Clamp(centre, hold.clamp_diameter, hold.clamp_height)
