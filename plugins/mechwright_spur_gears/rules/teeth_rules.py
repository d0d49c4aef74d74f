"""Rules of the teeth: distance, shifts, undercut, tips, roots, contact, rims, backlash, the mesh."""

import math
from collections.abc import Callable, Iterator
from dataclasses import replace
from typing import Any

import numpy as np

from mechwright import Array, Severity, Stage
from mechwright.contracts.design_rule import DesignRule, Failure
from mechwright.contracts.design_table import items
from mechwright.contracts.finding import Change
from mechwright.contracts.procedure import Note
from mechwright.contracts.rule_list import all_of
from mechwright.mechanics.gearing.checks import FULL_RIM, LEAST_RIM, LEAST_TIP
from mechwright.mechanics.gearing.involute import (
    MOST_SHIFT,
    InvolutePair,
    involute,
    least_shift,
    straight_depth,
)
from mechwright.mechanics.opening_rules import keyed_rules, size_rules
from mechwright.tolerances import falls_short
from mechwright_spur_gears.gear_table import Flank, GearTable
from mechwright_spur_gears.pair import least_backlash

GOOD_CONTACT, LEAST_CONTACT = 1.2, 1.0
"""Contact ratio below which gears run roughly, and below which contact is lost."""

LEAST_ARC = 0.02
"""Modules between the centres of the rack's tip arcs and the pitch circle, below it: fillets begin there."""

Rule = DesignRule[GearTable]
Fails = Failure[GearTable]


def each(m: GearTable, value: Callable[[InvolutePair, int], Any], again: float | None = None) -> Array:
    """A number of every gear in its meshes, (n, k); ``again`` of a gear that is in a mesh before."""
    found = [
        again if one.again and again is not None else value(m.meshes[one.mesh], one.gear) for one in m.flanks
    ]
    return items(found, m.size)


def flank_of(f: Fails) -> Flank:
    """The gear that breaks a rule."""
    return f.m.flanks[f.item]


def _mate(f: Fails) -> Flank:
    """What meshes with it there."""
    return f.m.flanks[f.item ^ 1]


def _stands(m: GearTable) -> Any:
    """Whether the base circles of both gears leave a line of action."""
    return ~np.isnan(m.pair.operating_angle)


def _least_distance(m: GearTable) -> Any:
    """The centre distance at which both base circles touch, mm."""
    return abs(m.pair.reference_distance) * np.cos(m.pair.angle)


DISTANCE = Rule(
    "gear.distance",
    "centre_distance",
    "the axes are {value:g} mm apart, and the base circles touch at {limit:.6g} mm: no flanks meet",
    value=lambda m: m.given.centre_distance,
    limit=_least_distance,
    unit="mm",
    remedy=lambda f: (
        f"make centre_distance at least {math.ceil(1000 * _plain_distance(f.m)) / 1000:g}, or module smaller"
    ),
    must_be="above",
    stage=Stage.MOTION,
    when=lambda m: m.given.centre_distance is not None,
    proposed=lambda _: ({"parameters.centre_distance": None},),
)


def _sum(m: GearTable) -> float:
    return float(m.pair.shifts[0] + m.pair.shifts[1])


def _sum_limit(m: GearTable) -> float:
    """Sum of the shifts with which the base circles touch."""
    return float(-involute(m.pair.angle) * m.pair.total / (2 * np.tan(m.pair.angle)))


TOO_NEAR = Rule(
    "gear.shift",
    "mate_shift",
    lambda f: f"shifts of {_sum(f.m):.3f} modules together put the flanks of both gears into each other",
    value=lambda m: (
        involute(m.pair.angle)
        + 2 * np.tan(m.pair.angle) * (m.pair.shifts[0] + m.pair.shifts[1]) / m.pair.total
    ),
    limit=0.0,
    reported=lambda f: (_sum(f.m), _sum_limit(f.m)),
    remedy=lambda f: (
        f"make both shifts together at {'most' if f.m.pair.total < 0 else 'least'} "
        f"{(math.floor if f.m.pair.total < 0 else math.ceil)(100 * _sum_limit(f.m)) / 100:g}"
    ),
    must_be="above",
    stage=Stage.MOTION,
)
SHIFT = Rule(
    "gear.shift",
    lambda f: flank_of(f).shift if getattr(f.m.given, flank_of(f).shift) is not None else "centre_distance",
    "the centre distance asks for a profile shift of {value:.3f} modules, and the limit is {limit:g}",
    value=lambda m: np.abs(each(m, lambda pair, gear: pair.shifts[gear], again=0.0)),
    limit=MOST_SHIFT,
    must_be="at most",
    remedy=lambda f: (
        f"leave centre_distance out, which gives {_plain_distance(f.m):.6g} mm, or change module"
    ),
    proposed=lambda _: ({"parameters.centre_distance": None},),
    each=False,
)


def _plain_distance(m: GearTable) -> float:
    return float(abs(m.pair.reference_distance))


def _up(value: float) -> float:
    return math.ceil(value * 1000 - 1e-6) / 1000


def _shifted(f: Fails) -> Iterator[Change]:
    if f.limit <= MOST_SHIFT:
        yield {f"parameters.{flank_of(f).shift}": _up(f.limit), "parameters.centre_distance": None}
    yield {f"parameters.{flank_of(f).shift}": None}


UNDERCUT = Rule(
    "gear.undercut",
    lambda f: flank_of(f).shift,
    lambda f: (
        f"{flank_of(f).words} with {f.m.number_of(flank_of(f))} teeth and a profile shift of {f.value:.3f} "
        "is undercut: the cutter takes away a part of the flank near the root"
    ),
    value=lambda m: each(m, lambda pair, gear: pair.shifts[gear], again=np.inf),
    limit=lambda m: each(
        m, lambda pair, gear: least_shift(pair.teeth[gear], pair.angle, pair.dedendum, pair.tip_radius)
    ),
    remedy=lambda f: f"make {flank_of(f).shift} at least {_up(f.limit):g}, or {flank_of(f).teeth} larger",
    proposed=_shifted,
)


def _arc_depth(pair: InvolutePair, gear: int) -> Any:
    """How deep the centres of the rack's tip arcs are below the pitch circle, modules.

    No rack rolls in a ring or on a rack.
    """
    depth = pair.dedendum - pair.shifts[gear] - pair.tip_radius
    return np.where(rolls(pair, gear), depth, np.inf)


def rolls(pair: InvolutePair, gear: int) -> Any:
    """Whether a gear is a round one with teeth outside."""
    teeth = np.asarray(pair.teeth[gear])
    return (teeth > 0) & np.isfinite(teeth)


def _less_round(f: Fails) -> Iterator[Change]:
    less = math.floor(1000 * (float(f.m.given.tip_radius) + f.value - f.limit)) / 1000
    if less >= 0:
        yield {"parameters.tip_radius": less}
    yield {f"parameters.{flank_of(f).shift}": None}


LAND = Rule(
    "gear.root-land",
    "tip_radius",
    "the two tip arcs of a rack tooth overlap: the fillets of a space merge and no root is left",
    value=lambda m: (
        math.pi / 4
        - straight_depth(m.pair.angle, m.given.dedendum, m.given.tip_radius) * np.tan(m.pair.angle)
        - m.given.tip_radius * np.cos(m.pair.angle)
    ),
    limit=0.0,
    remedy="make tip_radius, dedendum or pressure_angle smaller",
)
ARC = Rule(
    "gear.rack",
    "tip_radius",
    lambda f: (
        f"with its shift the tip arcs of the rack have their centres {f.value:.3f} modules below the pitch "
        f"circle of {flank_of(f).words}, and need {f.limit:g}"
    ),
    value=lambda m: each(m, _arc_depth, again=np.inf),
    limit=LEAST_ARC,
    remedy=lambda f: (
        f"make tip_radius or {flank_of(f).shift} smaller by {math.ceil(1000 * (f.limit - f.value)) / 1000:g}"
    ),
    proposed=_less_round,
)
TIP = Rule(
    "gear.tip",
    "addendum",
    lambda f: (
        f"a tooth of {flank_of(f).words} is "
        + ("pointed" if f.value <= 0 else f"{f.value:.3f} modules wide at the tip")
        + f", below {LEAST_TIP:g} modules"
    ),
    value=lambda m: each(
        m, lambda pair, gear: pair.thickness_at(gear, pair.tip(gear)) / pair.module, again=np.inf
    ),
    limit=LEAST_TIP,
    remedy=lambda f: f"make {flank_of(f).shift} or {height_key(f)} smaller",
)


def height_key(f: Fails) -> str:
    """The key of the height of a gear's teeth."""
    last = f.item == len(f.m.flanks) - 1
    if last and f.m.straight:
        return "rack_addendum"
    return "ring_addendum" if last and f.m.ring else "addendum"


CONTACT = Rule(
    "gear.contact-ratio",
    "addendum",
    "the contact ratio is {value:.3f}: a pair of teeth lets go before the next one takes over",
    value=lambda m: items([one.contact_ratio for one in m.meshes], m.size),
    limit=LEAST_CONTACT,
    must_be="above",
    remedy="make pressure_angle or the shifts smaller, addendum larger, or use more teeth",
    proposed=lambda _: (
        {"parameters.addendum": None, "parameters.dedendum": None},
        {"parameters.addendum": None, "parameters.dedendum": None, "parameters.pressure_angle": None},
    ),
)
ROUGH = CONTACT.but(
    message="the contact ratio is {value:.3f}, below {limit:g}: teeth with errors run roughly",
    limit=GOOD_CONTACT,
    must_be="at least",
    severity=Severity.WARNING,
    when=lambda m: np.all([np.reshape(one.contact_ratio, -1) > LEAST_CONTACT for one in m.meshes], axis=0),
)
INTERFERENCE = Rule(
    "gear.interference",
    lambda f: _mate_height(f) if f.m.straight else "addendum",
    lambda f: (
        f"the tips of {_mate(f).words} run into the fillets of {flank_of(f).words}: its flanks begin "
        f"{abs(f.limit):.3f} mm along the line of action, and the tips reach {abs(f.value):.3f} mm"
    ),
    value=lambda m: each(m, lambda pair, gear: pair.foot_curvature(gear)),
    limit=lambda m: each(m, _form),
    unit="mm",
    remedy=lambda f: (
        f"make {_mate_height(f)} at most {_highest(f):g}" + (", or tip_radius smaller" if f.item else "")
        if f.m.straight
        else f"make {flank_of(f).shift} larger, {_mate_height(f)} or tip_radius smaller, or use more teeth"
    ),
    each=False,
    proposed=lambda f: tuple(_lower(f)),
)


def _lower(f: Fails) -> Iterator[Change]:
    if f.m.straight:
        yield {"parameters.rack_addendum": None} | ({"parameters.addendum": _highest(f)} if f.item else {})
    elif f.m.ring:
        yield {"parameters.ring_addendum": None}


def _mate_height(f: Fails) -> str:
    return height_key(replace(f, item=f.item ^ 1))


def _highest(f: Fails) -> float:
    """The greatest height of the mate's teeth, modules, with which they touch flanks of rack and pinion."""
    pair = f.m.pair
    sine, rolled = np.sin(pair.angle), pair.reference(0) * np.sin(pair.angle)
    if f.item:
        high = (np.hypot(pair.base(0), rolled - f.limit) - pair.reference(0)) / pair.module - pair.shifts[0]
    else:
        high = (rolled - f.limit) * sine / pair.module + pair.shifts[0]
    return math.floor(100 * float(high) + 1e-6) / 100


def _form(pair: InvolutePair, gear: int) -> Any:
    """Where the flank of a gear begins; those of a ring and of a rack are below 0."""
    form = pair.form_curvature(gear)
    return np.where(rolls(pair, gear), np.maximum(form, 0.0), form)


def reach(m: GearTable) -> Any:
    """How far the shaft opening reaches from the axis, mm."""
    given = m.given
    width = float(np.ravel(given.keyway_width)[0])
    if width == 0 or not m.single:
        return given.bore / 2
    opening = m.opening
    return given.bore / 2 if opening is None else float(np.hypot(*opening.loop().flatten().T).max())


def _rim(m: GearTable) -> Any:
    def rim(pair: InvolutePair, gear: int) -> Any:
        if not np.any(rolls(pair, gear)):
            return np.inf  # neither a ring nor a rack has a shaft
        pin = m.planetary and gear == 1
        return (pair.root(gear) - (m.dimensions.pin_diameter / 2 if pin else reach(m))) / pair.module

    return each(m, rim, again=np.inf)


def _bored(m: GearTable) -> Any:
    return m.planetary | (np.asarray(m.given.bore) > 0)


def _bore(f: Fails, share: float) -> float:
    m = f.m
    most = 2 * (float(m.meshes[flank_of(f).mesh].root(flank_of(f).gear)) - share * float(m.pair.module))
    keyed = 2 * (float(reach(m)) - m.given.bore / 2) if flank_of(f).bore == "bore" else 0.0
    return math.floor(100 * (most - keyed)) / 100


RIM = Rule(
    "bore.rim",
    lambda f: flank_of(f).bore,
    "{value:.2f} modules stay between the shaft opening and the nearest root",
    value=_rim,
    limit=LEAST_RIM,
    remedy=lambda f: f"make {flank_of(f).bore} at most {max(_bore(f, LEAST_RIM), 0):g}, or the gear larger",
    when=_bored,
    each=False,
)
THIN_RIM = RIM.but(
    severity=Severity.WARNING,
    limit=lambda m: FULL_RIM * (m.given.addendum + m.given.dedendum),
    remedy=lambda f: f"make {flank_of(f).bore} at most {max(_bore(f, f.limit), 0):g}, or the gear larger",
    when=lambda m: _bored(m) & np.asarray(~falls_short(_rim(m), LEAST_RIM)).all(axis=-1, keepdims=True),
)


def _given_backlash(m: GearTable) -> Any:
    return m.given.backlash is not None


BACKLASH = Rule(
    "gear.backlash",
    "backlash",
    "gears as made may jam: walls and axes within tolerance take up to {limit:g} mm of the backlash",
    value=lambda m: m.given.backlash,
    limit=lambda m: least_backlash(m.given, m.pair),
    unit="mm",
    remedy="make backlash at least {limit:g}, or leave it out",
    severity=Severity.WARNING,
    stage=Stage.MACHINING,
    when=_given_backlash,
    proposed=lambda _: ({"parameters.backlash": None},),
)
JAMS = BACKLASH.but(
    severity=Severity.ERROR,
    message="gears as made jam: walls as they are planned take up to {limit:g} mm of the backlash",
    limit=lambda m: least_backlash(m.given, m.pair, jams=True),
)
BACKLASH = BACKLASH.but(
    when=lambda m: (
        _given_backlash(m)
        and ~np.asarray(falls_short(m.given.backlash, least_backlash(m.given, m.pair, jams=True)))
    )
)


OPENING = all_of(*size_rules("bore", "keyway_width", "keyway_relief"), keyed_rules())


def _size_message(m: GearTable) -> str:
    pair = m.pair
    one, two = (float(shift) for shift in pair.shifts)
    return (
        f"centre distance {float(m.distance):.4f} mm, profile shifts {one:.3f} and {two:.3f}, operating "
        f"pressure angle {math.degrees(float(pair.operating_angle)):.3f} degrees, contact ratio "
        f"{float(pair.contact_ratio):.3f}"
    )


SIZE = Note[GearTable]("gear.size", _size_message, lambda m: float(m.distance), "mm")
