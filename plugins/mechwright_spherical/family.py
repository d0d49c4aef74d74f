"""The family ``spherical``."""

from collections.abc import Sequence
from typing import TYPE_CHECKING

from mechwright.errors import DesignError
from mechwright.family import Family
from mechwright.findings import Finding, errors
from mechwright_spherical.params import SphericalParams

if TYPE_CHECKING:
    from mechwright.motion import Motion
    from mechwright.part import Part


class Spherical(Family[SphericalParams]):
    """Spherical linkages: all axes meet in one point."""

    name = "spherical"
    title = "Spherical linkages"
    summary = "Spherical four-bars, and adjustable five-bars that trace a path on a sphere in two phases."
    Params = SphericalParams

    def check(self, params: SphericalParams) -> Sequence[Finding]:
        """Assembly, transmission angle, mobility, path, and room for the links."""
        from mechwright_spherical.checks import findings

        return findings(params)

    def solve(self, params: SphericalParams, samples: int) -> "Motion":
        """The travel of the phase that is shown, at constant speed."""
        from mechwright_spherical.motion import motion_of

        return motion_of(params, samples)

    def parts(self, params: SphericalParams) -> "Sequence[Part]":
        """Links, pins, drive, base plate and flat strips.

        Raises
        ------
        DesignError
            ``check`` finds an error; the message is that of the first one.
        """
        from mechwright_spherical.checks import findings
        from mechwright_spherical.parts import parts_of

        for finding in errors(findings(params)):
            raise DesignError(f"{finding.parameter}: {finding.message}; {finding.remedy}")
        return parts_of(params)
