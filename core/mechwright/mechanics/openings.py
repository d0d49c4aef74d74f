"""What is wrong with the opening for a shaft by itself: sizes that no mill cuts, and keys that do not fit."""

import math
from collections.abc import Iterator, Mapping

from mechwright.contracts.finding import Finding
from mechwright.geometry.keyway import LEAST_WIDTH, SMALLEST_EDGE, Opening, key_for_bore


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
