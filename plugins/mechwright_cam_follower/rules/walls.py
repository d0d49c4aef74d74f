"""Walls and room: errors of the parts that need no load."""

import math
from collections.abc import Callable, Iterator
from typing import Any

import numpy as np

from mechwright import TOLERANCES, Array, Finding, Stage
from mechwright.contracts.design_rule import DesignRule, Failure, Text
from mechwright.contracts.design_table import number
from mechwright.contracts.finding import Change
from mechwright.contracts.procedure import Procedure
from mechwright.contracts.rule_list import all_of, in_turn
from mechwright.geometry.keyway import LEAST_WIDTH
from mechwright.mechanics.opening_rules import keyed_rules, size_rules
from mechwright_cam_follower.kinematics.contact import contact_of
from mechwright_cam_follower.kinematics.extremes import innermost, outermost
from mechwright_cam_follower.kinematics.mechanism import Mechanism
from mechwright_cam_follower.kinematics.turn import Samples, least
from mechwright_cam_follower.parts.cam_outline import outline_of
from mechwright_cam_follower.parts.shaft_opening import opening_reach
from mechwright_cam_follower.parts.slide_dimensions import FREE, shaft_room

Rule = DesignRule[Mechanism]
Fails = Failure[Mechanism]

_STATIONS = 721
"""Places of a turn at which a roller is compared with the whole cam."""

CLEAR = 0.9
"""Share of the least support up to which no roller meets another place; else the outline decides."""


def _wall(
    parameter: str,
    what: Text[Mechanism],
    value: Callable[[Mechanism], Any],
    remedy: Text[Mechanism],
    change: Callable[[Fails], Change | None],
    when: Callable[[Mechanism], Any] | None = None,
) -> Rule:
    """Make the rule of a wall, mm, that must be ``least_wall``."""

    def message(f: Fails) -> str:
        where = what(f) if callable(what) else what
        return f"{where} leaves {f.value:.3g} mm of wall, below least_wall"

    return Rule(
        "follower.wall",
        parameter,
        message,
        value=value,
        limit=lambda m: m.given.least_wall,
        unit="mm",
        remedy=remedy,
        proposed=lambda f: () if (one := change(f)) is None else (one,),
        when=when,
    )


def _inner(m: Mechanism) -> Any:
    """Give the least radius of the cams."""
    return number(np.minimum.reduce([innermost(m, cam).value for cam in m.cams]))


def _bore_that_fits(f: Fails) -> float | None:
    """Give the largest bore, mm, at most the present one, that leaves the wall; None if none does."""
    bore: float = f.m.given.bore
    inner: float = _inner(f.m)
    while True:
        # A keyway's corners stand out of a smaller bore farther than of a larger one.
        beyond = opening_reach(f.m, bore) - bore / 2
        most = math.floor(20 * (inner - f.limit - beyond)) / 10
        if most >= bore:
            return bore
        if most < max(LEAST_WIDTH, f.m.given.keyway_width):
            return None
        bore = most


def _bore_remedy(f: Fails) -> str:
    most = _bore_that_fits(f)
    return "make base_radius larger" if most is None else f"make bore at most {most:g}, or base_radius larger"


def _bore_change(f: Fails) -> Change | None:
    most = _bore_that_fits(f)
    return None if most is None else {"parameters.bore": most}


def _ring(f: Fails) -> float:
    """Give the screw circle in the middle between shaft and edge."""
    middle: float = opening_reach(f.m) + _inner(f.m)
    return round(middle, 2)


def _screwed(m: Mechanism) -> Any:
    return np.asarray(m.given.screw_diameter) > 0


def _screw_circle(towards: str, value: Callable[[Mechanism], Any]) -> Rule:
    return _wall(
        "screw_circle",
        f"the screw circle, towards the {towards},",
        value,
        lambda f: f"make it {_ring(f):g}, or the holes smaller",
        lambda f: {"parameters.screw_circle": _ring(f)},
        _screwed,
    )


OPENINGS = all_of(
    *size_rules("bore", "keyway_width", "keyway_relief", "screw_diameter", "guide_screw", "pin_diameter"),
    keyed_rules(),
    Rule(
        "follower.shaft",
        "bore",
        "two cams on one shaft need a bore",
        value=lambda m: m.given.bore,
        limit=0.0,
        unit="mm",
        remedy="set bore = 15",
        must_be="above",
        proposed=lambda f: ({"parameters.bore": 15.0},),  # noqa: ARG005
        when=lambda m: m.given.conjugate,
    ),
)

CAM = all_of(
    _wall(
        "bore",
        "the opening for the shaft",
        lambda m: _inner(m) - opening_reach(m),
        _bore_remedy,
        _bore_change,
        lambda m: np.asarray(m.given.bore) > 0,
    ),
    _screw_circle(
        "shaft", lambda m: m.given.screw_circle / 2 - m.given.screw_diameter / 2 - opening_reach(m)
    ),
    _screw_circle("edge", lambda m: _inner(m) - m.given.screw_circle / 2 - m.given.screw_diameter / 2),
    _wall(
        "screws",
        "the row of screws",
        lambda m: m.given.screw_circle * np.sin(math.pi / m.given.screws) - m.given.screw_diameter,
        "use fewer",
        lambda f: {"parameters.screws": max(2, f.m.given.screws - 1)},
        _screwed,
    ),
)


def _beside_hole(diameter: str, what: str, when: Callable[[Mechanism], Any] | None = None) -> Rule:
    """Make the rule of the wall of bar or lever beside a hole in its middle."""

    def wide(f: Fails) -> float:
        need: float = getattr(f.m.given, diameter) + 2 * f.limit
        return need

    return _wall(
        "follower_width",
        what,
        lambda m: (m.given.follower_width - getattr(m.given, diameter)) / 2,
        lambda f: f"make follower_width {wide(f):g}",
        lambda f: {"parameters.follower_width": wide(f)},
        when,
    )


def _has_roller(m: Mechanism) -> bool:
    return not m.flat


STUD = in_turn(
    Rule(
        "follower.stud",
        "pin_diameter",
        "a stud of {value:g} mm is no smaller than its roller",
        value=lambda m: m.given.pin_diameter,
        limit=lambda m: np.floor(2 * (m.roller - m.given.least_wall / 2) * 10) / 10,
        unit="mm",
        remedy="make it at most {limit:g}, or roller_radius larger",
        must_be="at most",
        proposed=lambda f: ({"parameters.pin_diameter": f.limit},),
    ),
    _beside_hole("pin_diameter", "the hole for the stud"),
    when=_has_roller,
)

SLIDE = all_of(
    Rule(
        "follower.guide",
        "guide_length",
        "rails of {value:g} mm have no room for two screws of {m.given.guide_screw:g}",
        value=lambda m: m.given.guide_length,
        limit=lambda m: 4 * m.given.guide_screw + 2 * m.given.least_wall,
        unit="mm",
        remedy="make guide_length {limit:g}",
        proposed=lambda f: ({"parameters.guide_length": f.limit},),
    ),
    when=lambda m: m.slides,
)


def _arm_that_fits(f: Fails) -> float:
    need: float = (f.m.given.pivot_bore + f.m.given.pin_diameter) / 2 + f.limit
    return need


def _reach(m: Mechanism) -> Any:
    """Give the greatest radius of the cams."""
    return number(np.maximum.reduce([outermost(m, cam).value for cam in m.cams]))


LEVER = all_of(
    _beside_hole("pivot_bore", "the bore of the lever"),
    _wall(
        "arm_length",
        "the hole for the stud beside the lever's bore",
        lambda m: m.arm - (m.given.pivot_bore + m.given.pin_diameter) / 2,
        lambda f: f"make arm_length {_arm_that_fits(f):g}",
        lambda f: {"parameters.arm_length": _arm_that_fits(f)},
        _has_roller,
    ),
    Rule(
        "follower.face-offset",
        "face_offset",
        "the lever's boss of {m.given.follower_width:g} mm stands out over its face",
        value=lambda m: m.face,
        limit=lambda m: m.given.follower_width / 2,
        unit="mm",
        remedy="make it {limit:g}, or leave it out",
        proposed=lambda f: ({"parameters.face_offset": None},),  # noqa: ARG005
        when=lambda m: m.flat,
    ),
    Rule(
        "follower.room",
        "centre_distance",
        lambda f: f"the cam reaches {_reach(f.m):.4g} mm, up to the lever's axis",
        value=lambda m: m.axis,
        limit=lambda m: _reach(m) + (m.given.follower_width if m.flat else m.given.pivot_bore) / 2 + FREE,
        unit="mm",
        remedy=lambda f: f"make it {math.ceil(f.limit):g} with a longer arm, or the cam smaller",
        proposed=lambda f: ({"parameters.centre_distance": float(math.ceil(f.limit))},),
    ),
    when=lambda m: not m.slides,
)


def _beside_slot(m: Mechanism) -> Any:
    """Give the least wall between the slot for the shaft of a pair and the holes of studs and pivot.

    Each end of the shaft's way is as far from the stud beside it as it is where the follower is lowest.
    """
    room, stud = shaft_room(m), m.given.pin_diameter / 2
    if m.slides:
        return np.maximum(np.hypot(m.offset, m.start) - room, 0.0) - stud
    away = np.hypot(m.axis * np.cos(m.start) - m.arm, m.axis * np.sin(m.start))
    beside = np.maximum(away - room, 0.0) - stud
    return np.minimum(beside, np.maximum(m.axis - room, 0.0) - m.given.pivot_bore / 2)


PAIR = _wall(
    "base_radius",
    lambda f: f"the slot for the shaft, {2 * shaft_room(f.m):g} mm wide,",
    _beside_slot,
    "make base_radius larger, or the bore smaller",
    lambda f: {"parameters.base_radius": math.ceil(f.m.given.base_radius + f.limit - f.value)},
    lambda m: m.given.conjugate,
)


def _may_collide(m: Mechanism) -> Any:
    """Tell which designs may have a roller that meets another place of its cam.

    It would where a chord of the pitch curve, shorter than 2 R, is normal to the curve at both of its ends.
    Such a chord is as long as the supports of both ends together, which are the centre's parts along the
    normal.
    """
    return m.roller >= CLEAR * np.minimum.reduce([_least_support(m, cam) for cam in m.cams])


def _least_support(m: Mechanism, cam: int) -> Any:
    """Give the least part of a roller's centre along the normal of its cam, mm."""

    def support(one: Samples) -> Array:
        (x, y), (u, v) = one.contacts[cam].middle, one.contacts[cam].normal
        return np.asarray(x * u + y * v)

    return least(m, ("support", cam), support).value


def _collision(m: Mechanism) -> Iterator[Finding]:
    """A roller that fits each place of the cam may still meet another place of it."""
    import shapely

    theta = np.linspace(0.0, math.tau, _STATIONS)
    for cam in m.cams:
        loop, deviation = outline_of(m, cam)
        centre = contact_of(m, m.cycle.at(theta), cam).centre * np.exp(-1j * m.sense * theta)
        shape = shapely.Polygon(loop.flatten())
        away = shapely.distance(shape, shapely.points(centre.real, centre.imag))
        worst = int(np.argmin(away))
        if not shape.is_valid or away[worst] < m.roller - deviation - 2 * TOLERANCES.flatten:
            yield Finding.error(
                "follower.collision",
                "base_radius",
                f"at {math.degrees(theta[worst]):.1f} degrees the roller stands "
                f"{m.roller - away[worst]:.3g} mm in another place of its cam",
                float(away[worst]),
                m.roller,
                "mm",
                "use a larger base_radius, a smaller roller, or longer angles",
                Stage.PARTS,
                proposed=({"parameters.base_radius": math.ceil(1.2 * m.given.base_radius)},),
            )
            return


COLLISION = in_turn(
    Procedure[Mechanism](["follower.collision"], _collision, when=_may_collide), when=_has_roller
)

WALLS = in_turn(OPENINGS, CAM, STUD, SLIDE, LEVER, PAIR, COLLISION)
