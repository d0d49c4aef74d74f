"""Cures of laws that cannot be run: the nearest law of which gears can be made.

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
from mechwright_noncircular_gears.law import fastest_of, law_of, slowest_of
from mechwright_noncircular_gears.laws.formula import AngleFormula, RatioFormula
from mechwright_noncircular_gears.params import NoncircularParams
from mechwright_noncircular_gears.softer import nearest, said

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
