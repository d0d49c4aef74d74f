"""What the mills of a program have to leave, band by band: the part, and what they do not get at."""

from collections.abc import Sequence
from dataclasses import replace
from functools import cached_property

import shapely

from mechwright.contracts.part import Bore, Feature, Profile
from mechwright.tolerances import TOLERANCES
from mechwright_cam.proof.bands import Band, bands, floor_of, wall_region
from mechwright_cam.proof.fillets import fillets
from mechwright_cam.proof.grooves import along, entered
from mechwright_cam.proof.paths import NEAR
from mechwright_cam.proof.plane import Shape, grow
from mechwright_cam.proof.reachable import Reach, Surroundings
from mechwright_cam.setup.depths import makes, thread_in
from mechwright_cam.setup.job import Job
from mechwright_cam.setup.views import inside_of
from mechwright_cam.shop.tool import Tool

PLAY = TOLERANCES.outline + TOLERANCES.flatten
"""A cutter reaches what it enters with this much air on either side, mm.

Paths and polygons are no better, and may be a micron too deep as outlines may: a path in the middle of a
narrower slot would cut more off both walls. Without it a slot up to 3 µm wider than the cutter would count as
left over; with ``flatten`` alone the narrow ends of recesses would still prove, but such slots would not.
"""
TAB_SLACK = 0.5
"""A tab may come out this much higher than planned, mm: the cutter is lifted over it with room to spare, and
the tab is cut off by hand."""
COARSE = 0.002
"""Accuracy of areas that are not reported, mm: a fifth of the leftover limit."""


def play(job: Job) -> float:
    """Air on either side of a cutter where it can enter, mm: more where paths keep farther off the walls."""
    return max(PLAY, job.settings.path.bias)


class TargetShape:
    """What the mills of a program have to leave, band by band."""

    def __init__(self, job: Job, mills: Sequence[Tool]) -> None:
        self.job, self.mills = job, mills
        air = play(job) + job.wear_margin
        self.reach = Reach(mills, air, -job.floor)
        self.fillets = fillets(job)
        self.smallest = min(tool.radius for tool in mills) + air
        self.slack = max(TAB_SLACK, *self.reach.noses) if self.reach.noses else TAB_SLACK
        extra = [z for fillet in self.fillets for z in fillet.heights] + _above_floors(job, self.reach)
        self.pointed = drilled_floors(job)
        extra += [-depth for _, depth in self.pointed]
        self.bands = bands(job, (*(tab.top + self.slack for tab in job.tabs), *extra))
        self.drawn = wall_region(job)

    @property
    def alike(self) -> bool:
        """Whether one cross-section asks but once.

        With round or short cutters, or round floors, every height is another question.
        """
        return self.reach.plain and not self.fillets and not self.pointed

    def narrowest(self, band: Band) -> float:
        """Radius of the narrowest mill where a band is measured, mm."""
        underside = band.bottom <= -self.job.thickness + NEAR
        if underside or not self.reach.noses:
            return self.smallest
        return self.reach.least(TOLERANCES.leftover)

    def rest(self, place: int, level: float, *, held: bool = False) -> Shape:
        """What has to stay at a height in the band of an index; with ``held`` the tabs as well."""
        rest = self.reach.rest(self._held if held else self._free, place, level)
        if not self.reach.noses:
            return rest
        return along(rest, play(self.job), self.job, self.bands[place], self.mills, level)

    def tab_lift_area(self, place: int) -> Shape | None:
        """Where the cutter lifts beside the tabs that a band touches: what stays there goes with them."""
        tabs, widest = self._tabs[place], max(tool.diameter for tool in self.mills)
        return shapely.union_all([grow(tab, widest, COARSE) for tab in tabs]) if tabs else None

    @cached_property
    def _tabs(self) -> list[list[Shape]]:
        """The tabs that each band touches."""
        tabs = self.job.tabs
        return [[t.shape for t in tabs if t.top + self.slack >= band.top - NEAR] for band in self.bands]

    @cached_property
    def _free(self) -> Surroundings:
        """What has to stay, without tabs."""
        job, floors = self.job, []
        if not self.reach.plain:
            floors = [(-(one.top + one.depth), floor_of(one, job)) for one in recesses(job)]
        layers = [(band.top, self._entered(band, band.keep)) for band in self.bands]
        return Surroundings(layers, -job.thickness, floors, self.fillets)

    @cached_property
    def _held(self) -> Surroundings:
        """What has to stay, with the tabs."""
        layers = [
            (band.top, self._entered(band, shapely.union_all([band.keep, *tabs])))
            for band, tabs in zip(self.bands, self._tabs, strict=True)
        ]
        return replace(self._free, layers=layers)

    def _entered(self, band: Band, keep: Shape) -> Shape:
        # Below the end of a tapped thread the point of its drill may stay.
        drilled = [inside_of(bore) for bore, depth in self.pointed if band.top <= NEAR - depth]
        keep = shapely.union_all([keep, *(grow(hole, TOLERANCES.leftover) for hole in drilled)])
        return entered(keep, self.smallest, play(self.job), self.job, band)


def drilled_floors(job: Job) -> list[tuple[Bore, float]]:
    """The blind holes that are tapped, and where their threads end, mm: a drill's point may stay below."""
    blind = [bore for bore in recesses(job) if isinstance(bore, Bore)]
    threads = [(bore, thread) for bore in blind if (thread := thread_in(job, bore)) is not None]
    return [(bore, one.depth) for bore, one in threads if any(makes(tool, one) for tool in job.tools)]


def recesses(job: Job) -> list[Feature]:
    """The features that end in the plate: each has a floor."""
    return [
        feature
        for feature in job.features
        if feature.top + feature.depth < job.thickness - NEAR
        and not (isinstance(feature, Profile) and feature.side == "outside")
    ]


def _above_floors(job: Job, reach: Reach) -> list[float]:
    """Heights from which on round mills are as wide as they get above the floors."""
    floors = {feature.top + feature.depth for feature in recesses(job)}
    return [nose - floor for nose in reach.noses for floor in floors]
