"""Shaft openings of wheel and driver."""

import math
from collections.abc import Iterator

from mechwright import Finding
from mechwright.geometry.keyway import (
    KEYS,
    LEAST_WIDTH,
    SMALLEST_EDGE,
    Opening,
    key_for_bore,
    key_of_width,
)
from mechwright_geneva.params import GenevaParams


def wheel_opening(params: GenevaParams) -> Opening | None:
    """The wheel's opening; None without a bore."""
    return _opening(params.bore, params.keyway_width, params.keyway_relief)


def driver_opening(params: GenevaParams) -> Opening | None:
    """The driver's opening; None without a bore."""
    return _opening(params.driver_bore, params.driver_keyway_width, params.keyway_relief)


def _opening(bore: float, width: float, relief: float) -> Opening | None:
    if bore == 0:
        return None
    key = key_of_width(width)
    if key is None:
        return Opening(bore)
    return Opening(bore, key.width, key.hub_depth, relief)


def reach(opening: Opening | None) -> float:
    """How far an opening reaches from the axis, mm: to the farthest corner of its keyway."""
    if opening is None:
        return 0.0
    if not opening.has_keyway:
        return opening.bore / 2
    # A relief bulges beyond its corner by less than its own bite.
    return math.hypot(opening.floor, opening.width / 2) + opening.bite / 2


def hub_radius(params: GenevaParams) -> float:
    """Radius about the wheel's axis that the slots must leave alone: opening or hub, mm."""
    return max(reach(wheel_opening(params)), params.hub_diameter / 2)


def driver_radius(bore: float, least_wall: float, fixing: float) -> float:
    """Radius about the crank's axis that opening (as far as it reaches), walls and dowels need, mm."""
    return bore + (2 * least_wall + fixing if fixing > 0 else least_wall)


def opening_findings(params: GenevaParams) -> Iterator[Finding]:
    """What is wrong with bores and keyways by themselves."""
    yield from _one(params, "bore", "keyway_width")
    yield from _one(params, "driver_bore", "driver_keyway_width")
    if 0 < params.keyway_relief < LEAST_WIDTH:
        yield _too_small("keyway_relief", params.keyway_relief)


def _too_small(name: str, value: float) -> Finding:
    return Finding.error(
        "bore.size",
        name,
        f"{value:.3g} mm is too small to be milled",
        value,
        LEAST_WIDTH,
        "mm",
        f"set {name} to 0 for none, or to {LEAST_WIDTH:g} or more",
    )


def _one(params: GenevaParams, bore_name: str, width_name: str) -> Iterator[Finding]:
    bore, width = float(getattr(params, bore_name)), float(getattr(params, width_name))
    for name, value in ((bore_name, bore), (width_name, width)):
        if 0 < value < LEAST_WIDTH:
            yield _too_small(name, value)
            return
    if width == 0:
        return
    fitting = key_for_bore(bore)
    advice = f"the standard is {fitting.width:g}" if fitting else "0 for none"
    if width >= bore:
        yield Finding.error(
            "bore.keyway-width",
            width_name,
            f"a keyway {width:g} mm wide swallows the bore of {bore:g} mm",
            width,
            bore,
            "mm",
            f"make {width_name} smaller than {bore_name}; {advice}",
        )
        return
    key = key_of_width(width)
    if key is None:
        widths = ", ".join(f"{one.width:g}" for one in KEYS)
        yield Finding.error(
            "bore.keyway-width",
            width_name,
            f"no standard key is {width:g} mm wide",
            width,
            fitting.width if fitting else None,
            "mm",
            f"use one of {widths}",
        )
        return
    if fitting is None or fitting.width != width:
        yield Finding.warning(
            "bore.keyway-series",
            width_name,
            f"DIN 6885-1 has another key for a bore of {bore:g} mm",
            width,
            fitting.width if fitting else None,
            "mm",
            f"use {width_name} = {fitting.width:g}" if fitting else "make sure that such a key is at hand",
        )
    opening = Opening(bore, key.width, key.hub_depth, params.keyway_relief)
    most = opening.greatest_relief - math.sqrt(2) * SMALLEST_EDGE
    if params.keyway_relief > most:
        yield Finding.error(
            "bore.keyway-relief",
            "keyway_relief",
            f"reliefs of {params.keyway_relief:g} mm leave nothing of the keyway's floor or sides",
            params.keyway_relief,
            most,
            "mm",
            f"make keyway_relief at most {math.floor(most * 100) / 100:g}",
        )
