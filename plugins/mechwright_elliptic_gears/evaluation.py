"""Many pairs at once: by formulas where they tell, left to themselves where they do not.

Left to themselves are trains, pairs with keyways or a given tooth offset, those whose tips may collide, which
only the mesh proof tells, and those whose load is not far from what a tooth breaks at.
"""

import math
from collections.abc import Collection
from typing import Any

import numpy as np
from numpy.typing import NDArray
from scipy.special import ellipe

from mechwright import Array, Stage, material
from mechwright.contracts.by_arrays import Answer, Designs
from mechwright.contracts.mass import KILOGRAMS
from mechwright.contracts.masses import OF_PART, TOTAL, is_mass
from mechwright.geometry.keyway import LEAST_WIDTH
from mechwright.mechanics.gearing import driven_torque
from mechwright.mechanics.gearing.checks import FULL_RIM, LEAST_CLEARANCE, LEAST_RIM, LEAST_TIP
from mechwright.mechanics.gearing.usual import LEAST_REGULARITY
from mechwright.mechanics.linkage.areas import circle_area
from mechwright.mechanics.strength.allowed import ROOT_SAFETY, allowed
from mechwright.mechanics.strength.tooth_bending import FACTOR, STRAIGHT, Rack, form_factors
from mechwright.tolerances import exceeds, falls_short
from mechwright_elliptic_gears.kinematics.equations import alpha_peak
from mechwright_elliptic_gears.many_columns import columns_of
from mechwright_elliptic_gears.parameters import LEAST_MODULE
from mechwright_elliptic_gears.parts.areas import areas_of
from mechwright_elliptic_gears.parts.backlash import least_backlashes
from mechwright_elliptic_gears.parts.defaults import following
from mechwright_elliptic_gears.parts.teeth import ENDS, SHARES, Gears, least_regularity, tips_of
from mechwright_elliptic_gears.parts.tip_reach import DOUBT

BLOCK = 256
"""Gears whose teeth are followed at once: arrays of a tenth of a megabyte."""

VARIED = frozenset(
    {"eccentricity", "teeth", "module", "semi_major", "pressure_angle", "addendum", "dedendum", "tip_radius"}
    | {"backlash", "thickness", "bore", "speed", "load_torque", "point_along", "point_across", "band"}
)
"""Keys that may differ between designs that formulas tell of."""

RACK = frozenset({"pressure_angle", "addendum", "dedendum", "tip_radius"})
"""Keys of the rack."""

_SURE = 1e-9
"""Share by which a bound is off a limit beyond rounding."""

_TOGETHER = 4
"""Numbers of teeth that are followed together; gears of fewer have idle places."""

_LOOKS, _SPARE = 9, 1.1
"""Numbers of virtual teeth that are looked at, and by how much form factors between them may be greater."""

Places = NDArray[np.intp]


def answer(designs: Designs, columns: Collection[str], stage: Stage) -> Answer | None:
    """What forbids designs, and their figures; see :mod:`mechwright.contracts.by_arrays`."""
    common = designs.common
    if common.stages != 1 or common.keyway_width or not set(designs.varied) <= VARIED:
        return None
    if common.tooth_offset is not None or (stage is Stage.MACHINING and common.backlash is not None):
        return None
    # Each has what it would have by itself.
    left = following(designs.__getitem__, {*designs.varied, *common.model_fields_set})
    follow = {name: value for name, value in left.items() if np.ndim(value)}
    designs = Designs(common, {**designs.varied, **follow})
    said = Answer(len(designs))
    if stage is not Stage.MOTION:
        _judge(designs, said)
    free = said.left
    moving = [name for name in columns if not is_mass(name)]
    found = columns_of(designs.some(free), moving)
    if found is None:
        return None
    if stage is not Stage.MOTION and len(moving) < len(columns):
        found |= _masses(designs.some(free))
    for name in columns:
        if name in found:
            said.give(name, found[name], free)
    return said


def _masses(designs: Designs) -> dict[str, Array]:
    """Of a gear, of which there are two, kg."""
    sizes = Sizes(designs)
    area = areas_of(sizes.gears()) * sizes.semi_major**2 - circle_area(designs["bore"])
    mass = KILOGRAMS * material(designs.common.material).density * area * designs["thickness"]
    return {f"{OF_PART}gear": mass, TOTAL: 2 * mass}


class Sizes:
    """Sizes (n,) of designs; lengths in mm."""

    def __init__(self, designs: Designs) -> None:
        def column(name: str) -> Array:
            return np.asarray(designs.full(name), dtype=float)

        self.e, self.teeth = column("eccentricity"), column("teeth")
        self.angle = np.radians(column("pressure_angle"))
        self.addendum, self.dedendum = column("addendum"), column("dedendum")
        self.tip_radius = column("tip_radius")
        perimeter = 4 * ellipe(self.e**2)
        if designs.common.semi_major is None:
            self.module = column("module")
            self.semi_major = math.pi * self.module * self.teeth / perimeter
        else:
            self.semi_major = column("semi_major")
            self.module = self.semi_major * perimeter / (math.pi * self.teeth)
        given = designs.common.backlash is not None
        self.backlash = column("backlash") if given else least_backlashes(self.e, self.angle)

    def gears(self) -> Gears:
        """Of all designs, in semi-major axes."""
        a, odd = self.semi_major, self.teeth % 2 == 1
        each: tuple[Array, ...] = (
            *(self.e, self.teeth, np.where(odd, 0.0, 0.25)),
            *(self.module / a, self.backlash / a),
            *(self.angle, self.addendum, self.dedendum, self.tip_radius),
        )
        return Gears(*(values[:, None] for values in each))


def _judge(designs: Designs, said: Answer) -> None:
    """As :func:`mechwright_elliptic_gears.rules.checks.judged`."""
    sizes = Sizes(designs)
    gears = sizes.gears()
    _rack(sizes, gears, said)
    _undercut(gears, said)
    collides = _tips(gears, said)
    rim = (sizes.semi_major * (1 - sizes.e) - designs["bore"] / 2) / sizes.module - sizes.dedendum
    bore = np.asarray(designs["bore"])
    said.forbid("bore.size", (bore > 0) & (bore < LEAST_WIDTH))
    full = FULL_RIM * (sizes.addendum + sizes.dedendum)
    said.forbid("bore.rim", _short(rim, full) & (rim < LEAST_RIM))
    along, across = designs["point_along"], np.abs(designs["point_across"])
    said.forbid("point.off-coupler", (along < 0) | (along > 1) | (across > sizes.semi_major))
    said.doubt(collides)
    said.doubt(_may_break(designs, sizes))


def _short(value: Any, limit: Any) -> NDArray[np.bool_]:
    return np.asarray(falls_short(value, limit))


def _rack(sizes: Sizes, gears: Gears, said: Answer) -> None:
    said.forbid("gear.module", _short(sizes.module, LEAST_MODULE))
    said.forbid("gear.rack", sizes.tip_radius >= sizes.dedendum)
    clearance = sizes.dedendum - sizes.addendum
    said.forbid("gear.clearance", _short(clearance, LEAST_CLEARANCE) & (clearance <= 0))
    said.forbid("gear.convexity", (gears.dedendum * gears.module >= gears.least_radius)[:, 0])
    said.forbid("gear.root-land", gears.half_land[:, 0] < 0)


def _undercut(gears: Gears, said: Answer) -> None:
    """A flank keeps its regularity if it would where the pitch curve is bent most; others are looked at."""
    deepest = gears.straight_depth * gears.module / (gears.least_radius * np.sin(gears.angle) ** 2)
    sure = 1 - deepest[:, 0] > LEAST_REGULARITY + _SURE
    for shares in (ENDS, SHARES):  # mostly the end of a flank tells
        places = _alike(gears, np.flatnonzero(said.open & ~sure))
        for start in range(0, places.size, BLOCK):
            some = places[start : start + BLOCK]
            cut = least_regularity(gears.rows(some), shares)[:, 0] < LEAST_REGULARITY
            said.forbid("gear.undercut", cut, some)


def _alike(gears: Gears, places: Places) -> Places:
    """Places in an order in which neighbours have about as many teeth and terms of their arcs."""
    teeth, e = gears.teeth[places, 0] // _TOGETHER, gears.eccentricity[places, 0]
    return places[np.lexsort((e, teeth))]


def _tips(gears: Gears, said: Answer) -> NDArray[np.bool_]:
    """Narrow tips, and which designs may have tips that collide."""
    collides = np.zeros(said.size, bool)
    places = _alike(gears, said.left)
    for start in range(0, places.size, BLOCK):
        some = places[start : start + BLOCK]
        block = gears.rows(some)
        tips = tips_of(block)
        said.doubt(~tips.found[:, 0], some)
        said.forbid("gear.tip", _short(tips.width, LEAST_TIP)[:, 0], some)
        near = (block.straight_depth - tips.depth < DOUBT) | (
            block.dedendum - block.addendum < LEAST_CLEARANCE
        )
        collides[some] = near[:, 0]
    return collides


def _may_break(designs: Designs, sizes: Sizes) -> NDArray[np.bool_]:
    """Whether a tooth may break: not where it bears the greatest of all that goes into its stress at once.

    A gear is within its pitch ellipse grown in proportion; it has no bore, and no play of the load.
    """
    e, a, own = sizes.e, sizes.semi_major, material(designs.common.material)
    b = a * np.sqrt(1 - e * e)
    grown = 1 + sizes.addendum * sizes.module / b
    polar = math.pi * a * b * (grown**4 * (a * a + b * b) / 4 + grown**2 * (a * e) ** 2)
    inertia = polar * designs["thickness"] * own.density * 1e-6
    omega = designs["speed"] * math.tau / 60
    torque = driven_torque(inertia, omega**2 * alpha_peak(e), designs["load_torque"])
    slant = np.arcsin(e)
    reach = a * (1 - e) * np.cos(sizes.angle + slant) / np.cos(sizes.angle)
    force = torque * 1000 / reach
    least, most = (2 * ratio * a / sizes.module for ratio in (1 - e * e, 1 / np.sqrt(1 - e * e)))
    form = _greatest_form(sizes, least, np.minimum(most, STRAIGHT), bool(RACK & set(designs.varied)))
    stress = force / (designs["thickness"] * sizes.module) * _SPARE * form * FACTOR
    breaks = ROOT_SAFETY * allowed(designs.common.material).root
    steep = sizes.angle + slant >= math.pi / 2
    far: NDArray[np.bool_] = np.asarray(exceeds(stress, breaks))
    far |= ~np.isfinite(stress) | steep
    return far


def _greatest_form(sizes: Sizes, least: Array, most: Array, varied: bool) -> Array:
    """What form and stress factors together are at most (n,) between two numbers of virtual teeth."""
    if varied:
        racks = sizes.angle, sizes.addendum, sizes.dedendum, sizes.tip_radius
        shares = np.linspace(0, 1, _LOOKS)
        forms = np.stack([_form(least * (most / least) ** share, racks) for share in shares])
        return np.asarray(forms.max(axis=0))
    one = tuple(
        float(values[0]) for values in (sizes.angle, sizes.addendum, sizes.dedendum, sizes.tip_radius)
    )
    teeth = np.geomspace(least.min(), STRAIGHT, _LOOKS**2)
    factors = np.maximum.accumulate(_form(teeth, one)[::-1])[::-1]
    return np.asarray(factors[np.maximum(np.searchsorted(teeth, least) - 1, 0)])


def _form(teeth: Array, racks: tuple[Any, ...]) -> Array:
    one, two = form_factors(teeth, Rack(*racks))
    return np.where(np.isfinite(one * two), one * two, np.inf)
