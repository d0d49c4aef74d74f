"""Whether what is cut can be cut, and whether each program is proven."""

from collections.abc import Sequence

from mechwright.contracts.finding import Finding, Stage
from mechwright.pipeline import PROGRAMS, Build, Inspection


class Cuttable(Inspection):
    """What kerf, sheet and process say of the parts."""

    name = "cutting"
    stage = Stage.MACHINING
    order = 21
    doing = "cutting programs"
    share = 5.0

    def findings(self, build: Build) -> Sequence[Finding]:
        """What forbids or hampers cutting."""
        from mechwright_cut.cutting import Cutting

        return build.made(Cutting).findings


class ProvenCuts(Inspection):
    """Whether each program is proven."""

    name = "cutting-proofs"
    stage = Stage.MACHINING
    needs = frozenset({PROGRAMS})
    order = 36
    doing = "cutting programs"
    share = 10.0

    def findings(self, build: Build) -> Sequence[Finding]:
        """Nothing; raises as :attr:`mechwright_cut.cutting.Cutting.programs` does."""
        from mechwright_cut.cutting import Cutting

        _ = build.made(Cutting).programs
        return ()
