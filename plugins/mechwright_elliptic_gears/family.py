"""The family ``elliptic-gears``."""

from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING

from mechwright.errors import DesignError
from mechwright.family import Family
from mechwright.findings import Finding, errors
from mechwright_elliptic_gears.params import EllipticGearParams

if TYPE_CHECKING:
    import shapely

    from mechwright.motion import Motion
    from mechwright.part import Part


class EllipticGears(Family[EllipticGearParams]):
    """Two congruent elliptic gears that turn about their foci."""

    name = "elliptic-gears"
    title = "Elliptic gears"
    summary = "A pair of congruent elliptic gears, each turning about a focus, with a varying speed ratio."
    Params = EllipticGearParams

    def check(self, params: EllipticGearParams) -> Sequence[Finding]:
        """Undercut, tips, roots, bore, phase, pressure angle at the shaft, and the mesh proof."""
        from mechwright_elliptic_gears.checks import findings

        return findings(params)

    def solve(self, params: EllipticGearParams, samples: int) -> "Motion":
        """One turn of gear 2 at constant speed."""
        from mechwright_elliptic_gears.motion import motion_of

        return motion_of(params, samples)

    def parts(self, params: EllipticGearParams) -> "Sequence[Part]":
        """The gear, which stands in the mechanism twice.

        Raises
        ------
        DesignError
            ``check`` finds an error; the message is that of the first one.
        """
        from mechwright_elliptic_gears.checks import findings
        from mechwright_elliptic_gears.gear import part_of

        for finding in errors(findings(params)):
            raise DesignError(f"{finding.parameter}: {finding.message}; {finding.remedy}")
        return (part_of(params),)

    def check_cut(
        self, params: EllipticGearParams, cut: "Mapping[str, shapely.Polygon]"
    ) -> Sequence[Finding]:
        """Whether pairs of the gear as cut still mesh, and its key goes in."""
        from mechwright_elliptic_gears.cut import cut_findings
        from mechwright_elliptic_gears.gear import PART

        return tuple(cut_findings(params, cut[PART])) if PART in cut else ()
