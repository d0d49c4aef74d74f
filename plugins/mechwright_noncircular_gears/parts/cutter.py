"""What makes the teeth of a design: a rack, or a round cutter where a pitch curve is hollow."""

import math
from dataclasses import dataclass

from mechwright import kept
from mechwright.mechanics.gearing import Rack, Shaper
from mechwright.mechanics.gearing.usual import ADDENDUM, TIP_RADIUS, tip_radius_beside
from mechwright_noncircular_gears.kinematics.law import extremes_of
from mechwright_noncircular_gears.parameters import NoncircularParams

FLATTEST = 1e-4
"""Least curvature of a pitch curve for a centre distance of 1: below, a rack digs into its own flanks."""

SHAPER_RADIUS = 9.0
"""Modules: a cutter of 18 teeth."""

USUAL_PROFILE = {"rack": (ADDENDUM, TIP_RADIUS), "shaper": (0.8, 0.2)}
"""Cutter to addendum and tip radius, modules: tips of hollow arcs reach farther into their mates."""


@dataclass(frozen=True)
class CutterProfile:
    """The generating cutter: modules and degrees; ``backlash``, mm, as the design says it."""

    pressure_angle: float
    addendum: float
    dedendum: float
    tip_radius: float
    backlash: float | None
    shaper_radius: float | None

    @property
    def round(self) -> bool:
        """Whether it is a shaper's."""
        return self.shaper_radius is not None

    def sized(self, module: float, backlash: float) -> Rack:
        """The cutter in mm."""
        sizes = (
            module,
            math.radians(self.pressure_angle),
            self.addendum * module,
            self.dedendum * module,
            self.tip_radius * module,
            backlash,
        )
        if self.shaper_radius is None:
            return Rack(*sizes)
        return Shaper(*sizes, self.shaper_radius * module)


def convex(params: NoncircularParams) -> bool:
    """Whether a rack can roll on both pitch curves."""
    return all(least.value >= FLATTEST for least in extremes_of(params).curvatures)


@kept
def profile_of(params: NoncircularParams) -> CutterProfile:
    """The cutter of a design, with what it leaves out."""
    cutter = params.cutter
    if cutter is None:
        cutter = "rack" if convex(params) and params.shaper_radius is None else "shaper"
    addendum, tip = USUAL_PROFILE[cutter]
    tip = min(tip, float(tip_radius_beside(params.dedendum, params.pressure_angle)))
    radius = None
    if cutter == "shaper":
        radius = SHAPER_RADIUS if params.shaper_radius is None else params.shaper_radius
    return CutterProfile(
        params.pressure_angle,
        addendum if params.addendum is None else params.addendum,
        params.dedendum,
        tip if params.tip_radius is None else params.tip_radius,
        params.backlash,
        radius,
    )
