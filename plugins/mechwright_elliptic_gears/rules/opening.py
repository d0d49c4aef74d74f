"""Checks of bore and keyway: standard sizes, reliefs, and the rim up to the roots."""

from collections.abc import Iterator

from mechwright import Finding
from mechwright.contracts.finding import errors
from mechwright.mechanics.gearing.checks import rim_findings
from mechwright.mechanics.openings import keyed_findings, too_small
from mechwright_elliptic_gears.parameters import EllipticGearParams
from mechwright_elliptic_gears.parts.gear import rack_of, room


def opening_findings(params: EllipticGearParams) -> Iterator[Finding]:
    """Bore and keyway by themselves, then their rim."""
    names = ("bore", "keyway_width", "keyway_relief", "tracer_diameter")
    found = list(too_small({name: getattr(params, name) for name in names}))
    if not found and params.keyway_width > 0:
        found += keyed_findings(params)
    yield from found
    if not errors(found):
        yield from rim_findings(
            params,
            rack_of(params),
            lambda points: room(params, points),
            bare="eccentricity",
            roomier="use more teeth or a smaller eccentricity",
        )
