"""Remedies that are sought: softer laws, more teeth, lower tips, and the nearest law that makes gears.

A law that turns back has a softer one of its own kind. A formula with a corner, or without a slope somewhere,
has none: its ratio is fitted by harmonics, weighed so that they do not overshoot at the corner (Lanczos), and
softened until gears can be made.
"""

import math
from collections.abc import Callable
from dataclasses import replace
from typing import Any

import numpy as np
from pydantic import ValidationError

from mechwright import Finding, Severity
from mechwright.contracts.design_rule import DesignRule
from mechwright.contracts.finding import Change, errors
from mechwright.contracts.rule_list import in_turn
from mechwright_noncircular_gears.kinematics.law import fastest_of, law_of, slowest_of
from mechwright_noncircular_gears.kinematics.laws.formula import AngleFormula, RatioFormula
from mechwright_noncircular_gears.parameters import NoncircularParams
from mechwright_noncircular_gears.parts.cutter import profile_of
from mechwright_noncircular_gears.rules.law_rules import LAW, RING, TURNS_BACK
from mechwright_noncircular_gears.rules.part_rules import LOCKED, PARTS, STEEP
from mechwright_noncircular_gears.rules.shape_rules import HOLLOW, UNDERCUT, finer, least_teeth
from mechwright_noncircular_gears.rules.softer import nearest, said
from mechwright_noncircular_gears.rules.tip_rules import CUSP, TIP_FILLET, Fits, both, clear, lower, straight
from mechwright_noncircular_gears.table import GearTable, table_of

HARMONICS = 8
"""Of a formula with a corner: more bend the pitch curve more than teeth bear."""

SOFTER = ("law.turns-back", "law.ring", "gear.convexity", "gear.undercut", "gear.ring-room", "gear.mesh")
"""Findings that a softer law of the same kind does not have."""

FAINT = 0.1
"""Share of the change of a formula's ratio below which its harmonics tell more of it than what is left."""

PLACES = 512
"""Of a lobe, in the middle between which lie both ends of it."""

STEPS = 7
"""Halvings: to a hundredth of the change of the ratio, for each asks for all teeth."""

Works = Callable[[NoncircularParams], bool]
Advice = Callable[[NoncircularParams, Finding], Finding]


def with_remedy(params: NoncircularParams, finding: Finding) -> Finding:
    """A finding with what helps against it, and the nearest law of which gears can be made, all tried."""
    return cured(params, advised(params, finding), _meshes)


def _meshes(params: NoncircularParams) -> bool:
    """Whether gears can be made, and those in rings run: beside each other they do, but for few."""
    m = table_of(params)
    with np.errstate(all="ignore"):
        if errors(in_turn(LAW, PARTS).findings(m, quick=True)):
            return False
    return not (params.internal and m.collides)


def advised(params: NoncircularParams, finding: Finding) -> Finding:
    """A finding with a softer law, more teeth or lower tips, unless it has a proposal of its own."""
    advice = ADVICE.get(finding.code)
    return finding if advice is None or finding.proposed else advice(params, finding)


def _softer(works: Works) -> Advice:
    """Advice that is the nearest softer law that works."""

    def advice(params: NoncircularParams, finding: Finding) -> Finding:
        words, changes = said(nearest(params, works), finding.remedy)
        return replace(finding, remedy=words, proposed=changes)

    return advice


def _keeps(*rules: DesignRule[GearTable]) -> Works:
    return lambda params: all(rule.allows(table_of(params)) for rule in rules)


def _not_hollow(params: NoncircularParams, finding: Finding) -> Finding:
    """A shaper, more teeth, or a softer law."""
    if profile_of(params).shaper_radius is None:
        words, changes = said(nearest(params, _keeps(HOLLOW)), "")
        remedy = f'set cutter = "shaper", or {words}' if words else finding.remedy
        return replace(finding, remedy=remedy, proposed=({"parameters.cutter": "shaper"}, *changes))
    softer = _softer(_keeps(HOLLOW))(params, finding)
    if softer.proposed or (more := finer(params)) is None:
        return softer
    change: Change = {"parameters.teeth": more}
    return replace(softer, remedy=f"use {more} teeth, or {softer.remedy}", proposed=(change,))


def _without_undercut(params: NoncircularParams, finding: Finding) -> Finding:
    """The least number of teeth, or a softer law."""
    more = least_teeth(params)
    if more is None:
        return _softer(_keeps(UNDERCUT))(params, finding)
    remedy, change = f"use {more} teeth, the least number that works", {"parameters.teeth": more}
    return replace(finding, limit=more, remedy=remedy, proposed=(change,))


def _lower_tips(rule: DesignRule[GearTable], works: Fits) -> Advice:
    """Advice that are the greatest tooth heights that work for both gears, or a softer law."""

    def advice(params: NoncircularParams, finding: Finding) -> Finding:
        found = lower(params, next(rule.failures(table_of(params))).item, works)
        if found is None:
            return _softer(lambda one: both(one, works))(params, finding)
        remedy = "make " + " and ".join(f"{name} at most {most:g}" for name, most in found.items())
        change: Change = {f"parameters.{name}": most for name, most in found.items()}
        return replace(finding, limit=found[finding.parameter], remedy=remedy, proposed=(change,))

    return advice


ADVICE: dict[str, Advice] = {
    "law.ring": _softer(_keeps(RING)),
    "law.turns-back": _softer(_keeps(TURNS_BACK)),
    "gear.convexity": _not_hollow,
    "gear.undercut": _without_undercut,
    "gear.tip-cusp": _lower_tips(CUSP, straight),
    "gear.tip-fillet": _lower_tips(TIP_FILLET, clear),
    "gear.pressure-angle": _softer(_keeps(LOCKED, STEEP)),
}
"""Code to what helps."""


def cured(params: NoncircularParams, finding: Finding, works: Works) -> Finding:
    """An error that is the law's with the nearest law of which gears can be made as its last proposal."""
    if finding.severity is not Severity.ERROR:
        return finding
    if finding.code in SOFTER:
        fields = nearest(params, works, STEPS)
        if params.law in {"ratio", "angle"} and params.sector is None and _faint(params, fields):
            rounder = _smooth(params, works)
            if rounder is not None:
                words, changes = said(rounder, "")
                return replace(finding, remedy=words, proposed=(*changes, *finding.proposed))
    elif finding.code in {"law.corner", "law.formula"} and params.sector is None:
        fields = _smooth(params, works)
    else:
        return finding
    if fields is None:
        return finding
    words, changes = said(fields, "")
    return replace(
        finding,
        remedy=finding.remedy if finding.proposed else words,
        proposed=(*finding.proposed, *changes),
    )


def _faint(params: NoncircularParams, fields: dict[str, Any] | None) -> bool:
    """Whether a softer law has next to nothing left of the change of the ratio."""
    if fields is None:
        return True
    softer = NoncircularParams.model_validate({**params.model_dump(), **fields})
    return _swing(softer) < FAINT * _swing(params)


def _swing(params: NoncircularParams) -> float:
    law = law_of(params)
    return fastest_of(law).value - slowest_of(law).value


def _smooth(params: NoncircularParams, works: Works) -> dict[str, Any] | None:
    harmonics = _harmonics(params)
    if harmonics is None:
        return None
    fields = {"law": "fourier", params.law: None, **harmonics}
    try:
        fitted = NoncircularParams.model_validate({**params.model_dump(), **fields})
    except ValidationError:
        return None
    if works(fitted):
        return fields
    softer = nearest(fitted, works, STEPS)
    return None if softer is None else {**fields, **softer}


def _harmonics(params: NoncircularParams) -> dict[str, tuple[float, ...]] | None:
    """Amplitudes, degrees, of the ratio that a formula has; None where it has no value somewhere."""
    law = law_of(params)
    if not isinstance(law, RatioFormula | AngleFormula):
        return None
    phi = (np.arange(PLACES) + 0.5) / PLACES * law.period
    with np.errstate(all="ignore"):
        ratio = law.shape(phi)[0]
        mean = float(ratio.mean())
    if not (np.isfinite(ratio).all() and mean > 0):
        return None
    order = np.arange(1, HARMONICS + 1)
    turned = order[:, None] * law.lobes[0] * phi
    scale = law.lobes[0] / law.lobes[1] / mean * np.sinc(order / (HARMONICS + 1)) / (order * law.lobes[0])
    waves = {"sines": np.cos(turned), "cosines": np.sin(turned)}
    found = {name: np.degrees(2 * scale * (wave * ratio).mean(axis=1)) for name, wave in waves.items()}
    most = max(float(np.abs(one).max()) for one in found.values())
    digits = 3 - math.floor(math.log10(most or 1.0))
    return {
        name: tuple(round(float(one), digits) + 0.0 for one in values)
        for name, values in found.items()
        if np.abs(values).max() > most * 10.0**-3
    }
