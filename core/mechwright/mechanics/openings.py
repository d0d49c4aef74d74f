"""The opening for a shaft of a design table, and what is wrong with it by itself.

Sizes that no mill cuts, and keys that do not fit.
"""

import math
from collections.abc import Iterator, Mapping

from mechwright.contracts.finding import Finding, Severity, errors
from mechwright.contracts.keyed import Keyed
from mechwright.errors import GeometryError
from mechwright.geometry.keyway import (
    KEYS,
    LEAST_WIDTH,
    SMALLEST_EDGE,
    Opening,
    key_for_bore,
    key_of_width,
)


def opening_of(table: Keyed) -> Opening | None:
    """The shaft opening, None without a bore.

    Raises
    ------
    GeometryError
        The keyway's width is not standard and its depth is not given.
    """
    if table.bore == 0:
        return None
    if table.keyway_width == 0:
        return Opening(table.bore)
    depth = table.keyway_depth
    if depth is None:
        key = key_of_width(table.keyway_width)
        if key is None:
            raise GeometryError(
                f"keyway_depth: no standard key is {table.keyway_width:g} mm wide; give a depth"
            )
        depth = key.hub_depth
    return Opening(table.bore, table.keyway_width, depth, table.keyway_relief)


def keyed_findings(table: Keyed) -> Iterator[Finding]:
    """Judge the keyway of a table that has one: its depth, its width, its reliefs."""
    standard = key_of_width(table.keyway_width)
    if table.keyway_depth is None and standard is None:
        fitting = key_for_bore(table.bore)
        yield Finding.error(
            "bore.keyway-depth",
            "keyway_depth",
            f"no standard key is {table.keyway_width:g} mm wide, so its depth is not known",
            table.keyway_width,
            unit="mm",
            remedy=f"give keyway_depth, or a width of {', '.join(f'{key.width:g}' for key in KEYS)}",
            proposed=({"parameters.keyway_width": fitting.width},) if fitting else (),
        )
        return
    opening = opening_of(table)
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


def too_small(sizes: Mapping[str, float | None]) -> Iterator[Finding]:
    """Errors for the parameters, mm, that are above 0 and below what an end mill cuts."""
    for name, value in sizes.items():
        if value is not None and 0 < value < LEAST_WIDTH:
            yield Finding.error(
                "bore.size",
                name,
                f"{value:.3g} mm is too small to be milled",
                value,
                LEAST_WIDTH,
                "mm",
                f"set {name} to 0 for none, or to {LEAST_WIDTH:g} or more",
            )


def keyway_findings(
    opening: Opening, bore: str = "bore", width: str = "keyway_width", relief: str = "keyway_relief"
) -> Iterator[Finding]:
    """Judge a keyway against its bore and the standard; the names are those of its parameters."""
    fitting = key_for_bore(opening.bore)
    if opening.width >= opening.bore:
        yield Finding.error(
            "bore.keyway-width",
            width,
            f"a keyway {opening.width:g} mm wide swallows the bore of {opening.bore:g} mm",
            opening.width,
            opening.bore,
            "mm",
            f"make {width} smaller than {bore}; "
            + (f"the standard is {fitting.width:g}" if fitting else "0 for none"),
            proposed=({f"parameters.{width}": fitting.width if fitting else 0},),
        )
        return
    if fitting is None or fitting.width != opening.width:
        yield Finding.warning(
            "bore.keyway-series",
            width,
            f"DIN 6885-1 has another key for a bore of {opening.bore:g} mm: "
            + (f"{fitting.width:g} mm" if fitting else "none"),
            opening.width,
            fitting.width if fitting else None,
            "mm",
            f"use {width} = {fitting.width:g}" if fitting else "make sure that such a key is at hand",
            proposed=({f"parameters.{width}": fitting.width},) if fitting else (),
        )
    most = opening.greatest_relief - math.sqrt(2) * SMALLEST_EDGE
    if opening.relief > max(0.0, most):
        yield Finding.error(
            "bore.keyway-relief",
            relief,
            f"reliefs of {opening.relief:g} mm leave nothing of the keyway's floor or sides",
            opening.relief,
            most,
            "mm",
            f"make {relief} at most {max(0.0, math.floor(most * 100) / 100):g}",
        )
