"""Checks of bore and keyway: standard sizes, reliefs, and the rim up to the roots."""

import math
from collections.abc import Iterator

import numpy as np

from mechwright import Finding, Severity
from mechwright.contracts.finding import errors
from mechwright.geometry.keyway import KEYS, Opening, key_for_bore, key_of_width
from mechwright.mechanics.openings import keyway_findings, too_small
from mechwright.tolerances import falls_short
from mechwright_elliptic_gears.gear import ellipse_of, opening_of, rack_of
from mechwright_elliptic_gears.params import EllipticGearParams

LEAST_RIM = 1.0
"""Thinnest rim between opening and root, in modules: thinner ones give way under the tooth's load."""

FULL_RIM = 1.2
"""Rim in whole tooth depths from which it no longer weakens the teeth (the backup ratio of AGMA 2001)."""


def opening_findings(params: EllipticGearParams) -> Iterator[Finding]:
    """Bore and keyway by themselves, then their rim."""
    names = ("bore", "keyway_width", "keyway_relief", "tracer_diameter")
    found = list(too_small({name: getattr(params, name) for name in names}))
    if not found and params.keyway_width > 0:
        found += _keyway(params)
    yield from found
    if not errors(found):
        yield from _rim(params)


def _keyway(params: EllipticGearParams) -> Iterator[Finding]:
    standard = key_of_width(params.keyway_width)
    if params.keyway_depth is None and standard is None:
        fitting = key_for_bore(params.bore)
        yield Finding.error(
            "bore.keyway-depth",
            "keyway_depth",
            f"no standard key is {params.keyway_width:g} mm wide, so its depth is not known",
            params.keyway_width,
            unit="mm",
            remedy=f"give keyway_depth, or a width of {', '.join(f'{key.width:g}' for key in KEYS)}",
            proposed=({"parameters.keyway_width": fitting.width},) if fitting else (),
        )
        return
    opening = opening_of(params)
    assert opening is not None  # noqa: S101 - a keyway comes with a bore
    found = list(keyway_findings(opening))
    yield from found
    if standard is not None and not errors(found):
        yield from _depth(opening, standard.hub_depth, standard.height - standard.shaft_depth)


def _depth(opening: Opening, standard: float, key_height: float) -> Iterator[Finding]:
    if opening.depth == standard:
        return
    too_shallow = opening.depth < key_height
    yield Finding(
        "bore.keyway-depth",
        Severity.ERROR if too_shallow else Severity.WARNING,
        "keyway_depth",
        f"the standard key stands {key_height:g} mm out of the shaft and does not go in"
        if too_shallow
        else "the depth is not that of DIN 6885-1",
        opening.depth,
        key_height if too_shallow else standard,
        "mm",
        f"use keyway_depth = {standard:g}, or leave it out",
        proposed=({"parameters.keyway_depth": None},),
    )


def _rim(params: EllipticGearParams) -> Iterator[Finding]:
    rack = rack_of(params)
    m = rack.module
    opening = opening_of(params)
    plain = room(params, np.zeros((1, 2))) - params.bore / 2
    rim, blame = plain, "bore" if opening else "eccentricity"
    if opening and opening.has_keyway:
        rim = min(plain, room(params, opening.loop().flatten()))
        if falls_short(rim, plain):
            blame = "keyway_relief" if opening.relief and rim < _without_relief(params) else "keyway_depth"
    full = FULL_RIM * (rack.addendum + rack.dedendum) / m
    least = LEAST_RIM
    rim /= m
    if not falls_short(rim, full):
        return
    too_thin = rim < least
    if blame == "bore":
        wanted = max(0.0, 2 * (plain + params.bore / 2 - (least if too_thin else full) * m))
        remedy = f"make bore at most {math.floor(wanted * 100) / 100:g}, or the gear larger"
        if math.floor(wanted * 100) == 0:
            remedy = "make the gear larger, or use more teeth or a smaller eccentricity"
    else:
        remedy = f"make {blame} smaller, or the gear larger"
    yield Finding(
        "bore.rim",
        Severity.ERROR if too_thin else Severity.WARNING,
        blame,
        f"{rim:.2f} modules stay between the shaft opening and the nearest root",
        rim,
        least if too_thin else full,
        "",
        remedy,
    )


def _without_relief(params: EllipticGearParams) -> float:
    opening = opening_of(params.model_copy(update={"keyway_relief": 0.0}))
    assert opening is not None  # noqa: S101 - asked only where there is a keyway
    return room(params, opening.loop().flatten())


def room(params: EllipticGearParams, points: np.ndarray[tuple[int, ...], np.dtype[np.float64]]) -> float:
    """Least distance, mm, of points (n, 2), part frame, from the root curve; negative beyond it."""
    return float(ellipse_of(params).depth(points).min()) - rack_of(params).dedendum
