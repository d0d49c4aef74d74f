"""The pair of a design table, or of one whose numbers are columns: its module, shifts and backlash.

The table is that of :mod:`mechwright_spur_gears.parameters`, which imports this module.
"""

import math
from dataclasses import replace
from typing import Any

import numpy as np

from mechwright.mechanics.gearing.backlash import LEFT, PLANNED, pair_backlash
from mechwright.mechanics.gearing.involute import (
    MOST_SHIFT,
    InvolutePair,
    least_shift,
    share_by_size,
    share_by_sliding,
    straight_depth,
    sum_of_shifts,
)
from mechwright.mechanics.gearing.rack_pair import RackPair
from mechwright.mechanics.gearing.usual import TIP_RADIUS
from mechwright.tolerances import OFF_CENTRE

INCH = 25.4
"""mm."""

STEP = 1e-3
"""Shifts that are chosen are multiples of this, in modules."""

CUTTER_RADII = (TIP_RADIUS, 0.3, 0.25, 0.2, 0.15, 0.1, 0.05, 0.0)
"""Radii at the tips of a ring's cutter, modules: the first that leaves a land between both arcs is chosen."""

TRAVEL = 100.0
"""Way of a rack that names neither its travel nor its teeth, mm."""

LEAST_RING = 0.3
"""Modules: height of a ring's teeth that is chosen at least."""


def module_of(given: Any) -> Any:
    """Reference diameter over the number of teeth, mm."""
    return given.module if given.module is not None else INCH / given.diametral_pitch


def pair_of(given: Any) -> InvolutePair:
    """Both gears, with the shifts and the backlash that the design leaves out; a ring has teeth below 0."""
    if given.arrangement == "rack":
        return rack_pair_of(given)
    angle, ring = np.radians(given.pressure_angle), given.arrangement == "internal"
    mate = given.addendum if not ring or given.ring_addendum is None else given.ring_addendum
    pair = InvolutePair(
        module_of(given),
        angle,
        (given.teeth, -given.mate_teeth if ring else given.mate_teeth),
        (0.0, 0.0),
        (given.addendum, mate),
        given.dedendum,
        given.tip_radius,
        0.0,
    )
    shifted = pair.with_shifts(*(_ring_shifts if ring else _shifts)(given, pair))
    whole = replace(
        shifted, backlash=least_backlash(given, shifted) if given.backlash is None else given.backlash
    )
    return replace(whole, cutter_radius=_cutter_radius(whole)) if ring else whole


def rack_pair_of(given: Any) -> RackPair:
    """Pinion and rack, with the shift and the backlash that the design leaves out."""
    angle, module = np.radians(given.pressure_angle), module_of(given)
    heights = given.addendum, given.addendum if given.rack_addendum is None else given.rack_addendum
    rack = {"addendum": heights, "dedendum": given.dedendum, "tip_radius": given.tip_radius}
    pair = RackPair.of(module, angle, given.teeth, 0.0, **rack)
    if given.centre_distance is not None:
        shift = (given.centre_distance - pair.reference_distance) / module
    else:
        shift = _least(given, pair, 0) if given.shift is None else given.shift
    backlash = backlash_for(pair) if given.backlash is None else given.backlash
    return RackPair.of(module, angle, given.teeth, shift, backlash=backlash, **rack)


def rack_addendum(given: Any) -> Any:
    """Height of a rack's teeth, modules: that of the pinion's, or what its flanks have room for."""
    straight = straight_depth(np.radians(given.pressure_angle), given.dedendum, given.tip_radius)
    height = np.floor(100 * straight + 1e-6) / 100
    return np.clip(height, np.minimum(LEAST_RING, given.addendum), given.addendum)


def travel_of(given: Any, pair: RackPair) -> Any:
    """Way of a rack, mm: the usual one, or what its teeth allow, in whole millimetres."""
    if given.rack_teeth is None:
        return TRAVEL
    return np.maximum(np.floor(pair.travel(given.rack_teeth)), 1.0)


def ring_pair_of(given: Any, pair: InvolutePair) -> InvolutePair:
    """Planets and ring of a planetary set, at the centre distance of sun and planets.

    Planets have one thickness of teeth for both meshes: backlashes stand to each other as 1/cos α_w.
    """
    teeth, shift = (given.mate_teeth, -given.ring_teeth), pair.shifts[1]
    total = sum_of_shifts(teeth, pair.module, pair.angle, -pair.distance)
    height = given.addendum if given.ring_addendum is None else given.ring_addendum
    heights = given.addendum - pair.shortening, height
    bare = replace(pair, teeth=teeth, shifts=(shift, total - shift), addendum=heights)
    backlash = pair.backlash * np.cos(pair.operating_angle) / np.cos(bare.operating_angle)
    whole = replace(bare, backlash=backlash)
    return replace(whole, cutter_radius=_cutter_radius(whole))


def least_backlash(given: Any, pair: InvolutePair, *, jams: bool = False) -> Any:
    """As :func:`backlash_for`, mm; of sun and planets what lets planets turn in their ring too."""
    least = backlash_for(pair, jams=jams)
    if given.arrangement != "planetary" or given.ring_teeth is None:
        return least
    ring = ring_pair_of(given, pair)
    other = backlash_for(ring, jams=jams) * np.cos(ring.operating_angle) / np.cos(pair.operating_angle)
    return np.fmax(least, other)


def _cutter_radius(pair: InvolutePair) -> Any:
    """At the tips of a ring's cutter: the greatest that leaves a land between both arcs."""
    return np.select([np.asarray(pair.cutter_land(one) >= 0) for one in CUTTER_RADII], CUTTER_RADII, 0.0)


def _ring_shifts(given: Any, pair: InvolutePair) -> tuple[Any, Any]:
    """x1 and x2: the pinion is free of undercut, and the ring is shifted by as much."""
    one, two, total = given.shift, given.mate_shift, 0.0
    if given.centre_distance is not None:
        total = sum_of_shifts(pair.teeth, pair.module, pair.angle, -given.centre_distance)
    elif one is not None and two is not None:
        return one, two
    if one is None:
        one = _least(given, pair, 0) if two is None else total - two
    return one, total - one


def _shifts(given: Any, pair: InvolutePair) -> tuple[Any, Any]:
    """x1 and x2."""
    one, two = given.shift, given.mate_shift
    least = [_least(given, pair, gear) for gear in (0, 1)]
    if given.centre_distance is not None:
        total = sum_of_shifts(pair.teeth, pair.module, pair.angle, given.centre_distance)
        if one is not None or two is not None:
            return (one, total - one) if one is not None else (total - two, two)
    elif one is not None or two is not None or given.shift_rule != "equal-sliding":
        return (least[0] if one is None else one), (least[1] if two is None else two)
    else:
        total = least[0] + least[1]
    # A sum is shared; neither gear gets less than it needs, where that goes.
    low, high = np.minimum(least[0], total - least[1]), np.maximum(least[0], total - least[1])
    low, high = np.maximum(low, -MOST_SHIFT), np.minimum(high, MOST_SHIFT)
    if given.shift_rule == "equal-sliding":
        chosen = share_by_sliding(pair, total, low, high)
    else:
        chosen = np.clip(share_by_size(pair.teeth, total), low, high)
    return chosen, total - chosen


def _least(given: Any, pair: InvolutePair, gear: int) -> Any:
    """The least shift without undercut, 0 or more."""
    exact = least_shift(pair.teeth[gear], pair.angle, given.dedendum, given.tip_radius)
    return np.maximum(np.ceil(exact / STEP - 1e-9) * STEP, 0.0)


def backlash_for(pair: InvolutePair, *, jams: bool = False) -> Any:
    """The least backlash, mm, with which gears as made turn; or with which they are sure to jam below it."""
    left, off_centre = (PLANNED, 0.0) if jams else (LEFT, OFF_CENTRE)
    return pair_backlash(1.0, pair.operating_angle, left, off_centre)


def rack_tip_radius(given: Any) -> Any:
    """The usual radius at the tip of the rack, in modules, or what leaves a land between both arcs."""
    angle = np.radians(given.pressure_angle)
    room = (math.pi / 4 - given.dedendum * np.tan(angle)) / (
        np.cos(angle) - (1 - np.sin(angle)) * np.tan(angle)
    )
    return np.maximum(np.minimum(TIP_RADIUS, np.floor(100 * room) / 100), 0.0)


def ring_height(given: Any) -> Any:
    """Height of a ring's teeth, modules: that of the pinion's, or what its flanks have room for."""
    pair = pair_of(given)
    if given.arrangement == "planetary":
        pair = ring_pair_of(given, pair)
    least = np.sqrt(pair.base(1) ** 2 + (np.maximum(pair.form_curvature(0), 0.0) - pair.line) ** 2)
    height = (-least - pair.reference(1)) / pair.module - pair.shifts[1]
    low = np.minimum(LEAST_RING, given.addendum)
    return np.clip(np.nan_to_num(np.floor(100 * height) / 100, nan=LEAST_RING), low, given.addendum)


def least_root(given: Any) -> Any:
    """The smaller root radius of gears with a bore, mm; NaN of gears that cannot stand at their distance."""
    pair = pair_of(given)
    return np.minimum(pair.root(0), pair.root(1)) if given.arrangement == "external" else pair.root(0)
