"""Rules of a pair of toothed bodies: cutter, root land, tips, rim, mesh and backlash.

They take a :class:`~mechwright.mechanics.gearing.toothed_pair.ToothedPair`; a family lists them in its own
order. Limits and their reasons stand in :mod:`mechwright.mechanics.gearing.checks`.
"""

import math
from collections.abc import Iterator, Mapping
from typing import Any

import numpy as np

from mechwright.contracts.design_rule import DesignRule, Failure
from mechwright.contracts.finding import Finding, Severity, Stage, at_stage
from mechwright.contracts.procedure import Note, Procedure
from mechwright.contracts.rule_list import Rules, all_of, in_turn
from mechwright.errors import GeometryError
from mechwright.mechanics.gearing.checks import (
    FULL_RIM,
    LEAST_CLEARANCE,
    LEAST_RIM,
    LEAST_TIP,
    least_tip,
    mesh_findings,
)
from mechwright.mechanics.gearing.toothed_pair import ToothedPair
from mechwright.mechanics.gearing.usual import chosen

Pair = ToothedPair[Any]
Rule = DesignRule[Pair]
Fails = Failure[Pair]

RACK = Rule(
    "gear.rack",
    "tip_radius",
    "the tip arc of the rack is deeper than its tooth",
    value=lambda m: m.profile.tip_radius,
    limit=lambda m: m.profile.dedendum,
    remedy="make tip_radius smaller than dedendum",
    must_be="below",
)


def _clearance(m: Pair) -> Any:
    return m.profile.dedendum - m.profile.addendum


def _clear(f: Fails) -> tuple[float, float]:
    return f.m.profile.dedendum, f.m.profile.addendum + LEAST_CLEARANCE


NO_CLEARANCE = Rule(
    "gear.clearance",
    "dedendum",
    f"tips run {{value:.3g}} modules from the mating roots, below {LEAST_CLEARANCE:g}",
    value=_clearance,
    limit=0.0,
    remedy=lambda f: f"make dedendum at least {_clear(f)[1]:g}, or addendum smaller",
    must_be="above",
    reported=_clear,
)
CLEARANCE = NO_CLEARANCE.but(
    severity=Severity.WARNING,
    limit=LEAST_CLEARANCE,
    must_be="at least",
    when=lambda m: np.asarray(_clearance(m)) > 0,
)


def _greatest_tip_radius(m: Pair) -> float:
    """That leaves a land, modules: the half land is half_space - h_f tan α - r_f (1 - sin α) / cos α."""
    rack = m.rack
    sin, cos = math.sin(rack.pressure_angle), math.cos(rack.pressure_angle)
    return (rack.half_space - rack.dedendum * sin / cos) * cos / (1 - sin) / rack.module


def _land(f: Fails) -> tuple[float, float]:
    most, rack = _greatest_tip_radius(f.m), f.m.rack
    if most >= 0:
        return f.m.profile.tip_radius, most
    return f.m.profile.dedendum, rack.half_space / math.tan(rack.pressure_angle) / rack.module


def _land_remedy(f: Fails) -> str:
    most = math.floor(_land(f)[1] * 1e4) / 1e4
    if _greatest_tip_radius(f.m) >= 0:
        return f"make tip_radius at most {most:g}"
    return f"make dedendum less than {most:g}, or pressure_angle smaller"


LAND = Rule(
    "gear.root-land",
    lambda f: "tip_radius" if _greatest_tip_radius(f.m) >= 0 else "dedendum",
    lambda f: (
        "the two tip arcs of a rack tooth overlap: the fillets of a space merge and no root is left"
        if _greatest_tip_radius(f.m) >= 0
        else "the flanks of a rack tooth meet before its tip: there is no root"
    ),
    value=lambda m: m.half_land,
    limit=0.0,
    remedy=_land_remedy,
    reported=_land,
)


def _no_tip(m: Pair) -> Iterator[Finding]:
    """Flanks of one pair that do not reach their tips."""
    try:
        _ = m.tip_width
    except GeometryError as error:
        yield Finding.error(
            "gear.tip",
            "addendum",
            str(error),
            m.profile.addendum,
            remedy="make addendum smaller",
            stage=Stage.PARTS,
        )


def _blamed(f: Fails) -> str:
    """The backlash if the teeth would be thick enough without one."""
    thick = f.m.backlash and least_tip(f.m.teeth_with(0.0)) >= LEAST_TIP
    return "backlash" if thick else "addendum"


def _thin_tip(f: Fails) -> str:
    what = "pointed" if f.value <= 0 else f"{f.value:.3f} modules wide at the tip"
    return f"the thinnest tooth is {what}, below {LEAST_TIP:g} modules"


def _tip_remedy(f: Fails) -> str:
    if _blamed(f) == "addendum":
        return "make addendum smaller, or pressure_angle smaller"
    if f.m.profile.backlash is None:
        return f"make {f.m.larger} larger: as made, these teeth need all their backlash"
    return "make backlash smaller"


TIP: Rules[Any] = in_turn(
    Procedure[Pair](("gear.tip",), _no_tip, when=lambda m: m.single, stage=Stage.PARTS),
    Rule(
        "gear.tip",
        _blamed,
        _thin_tip,
        value=lambda m: m.tip_width,
        limit=LEAST_TIP,
        remedy=_tip_remedy,
    ),
)


def _full_rim(m: Pair) -> Any:
    return FULL_RIM * (m.profile.addendum + m.profile.dedendum)


def _rim_remedy(f: Fails, share: float) -> str:
    if f.m.rim.blamed != "bore":
        return f"make {f.m.rim.blamed} smaller, or the gear larger"
    hundredths = math.floor(max(0.0, 2 * (f.m.rim.root - share * f.m.rack.module)) * 100)
    if hundredths == 0:
        return f"make the gear larger, or {f.m.roomier}"
    return f"make bore at most {hundredths / 100:g}, or the gear larger"


_RIM = Rule(
    "bore.rim",
    lambda f: f.m.rim.blamed,
    "{value:.2f} modules stay between the shaft opening and the nearest root",
    value=lambda m: m.rim.thickness,
    limit=lambda m: np.minimum(LEAST_RIM, _full_rim(m)),
    remedy=lambda f: _rim_remedy(f, LEAST_RIM),
    reported=lambda f: (f.value, LEAST_RIM),
)
RIM: Rules[Any] = in_turn(
    _RIM,
    _RIM.but(
        severity=Severity.WARNING,
        limit=_full_rim,
        remedy=lambda f: _rim_remedy(f, f.limit),
        reported=None,
    ),
)


def _mesh(m: Pair) -> Iterator[Finding]:
    yield from at_stage(Stage.PARTS, mesh_findings(m.proof(), m.backlash, m.clearing))


MESH = Procedure[Pair](("gear.mesh", "gear.contact"), _mesh, slow=True, stage=Stage.PARTS)
"""The mesh proof of one pair."""


def _jams(m: Pair) -> Any:
    return np.asarray(m.backlash < m.jamming_backlash)


def _thick_enough(f: Fails) -> bool:
    return bool(least_tip(f.m.teeth_with(f.limit)) >= LEAST_TIP)


_BACKLASH = Rule(
    "gear.backlash",
    "backlash",
    "gears as made may jam: walls and axes within tolerance take up to {limit:g} mm of the backlash",
    value=lambda m: m.backlash,
    limit=lambda m: m.least_backlash,
    unit="mm",
    remedy=lambda f: (
        f"make backlash at least {f.limit:g}, or leave it out"
        if _thick_enough(f)
        else f"make {f.m.larger} larger: with a backlash of {f.limit:g} the teeth are too thin"
    ),
    severity=Severity.WARNING,
    stage=Stage.MACHINING,
    when=lambda m: ~_jams(m),
    proposed=lambda f: ({"parameters.backlash": f.limit},),
)
BACKLASH: Rules[Any] = all_of(
    _BACKLASH.but(
        severity=Severity.ERROR,
        message=lambda f: (
            "gears as made jam: walls as they are planned take up to "
            f"{f.m.jamming_backlash:g} mm of the backlash"
        ),
        when=_jams,
    ),
    _BACKLASH,
)


def chosen_note(usual: Mapping[str, float]) -> Procedure[Any]:
    """A note of the dimensions that a design leaves out and that differ from their usual values."""
    return Procedure(
        ("gear.chosen",),
        lambda m: at_stage(Stage.PARTS, chosen("gear.chosen", m.params, usual)),
        slow=True,
        warns=True,
    )


FILLET = Note[Any](
    "gear.fillet",
    "the largest end mill that cuts every fillet exactly has a diameter of {value:.3f} mm",
    lambda m: m.fillet_mill,
    "mm",
)
"""Of a table with a ``fillet_mill``, mm."""
