"""A chain as a family: whatever is asked of a mechanism is asked of its stages and put together."""

from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING, Any, ClassVar

from mechwright.contracts.family import Family
from mechwright.contracts.finding import Finding
from mechwright.contracts.parameters import Parameters
from mechwright.mechanics.chain.params import ChainParams, Families
from mechwright.mechanics.chain.wanted import ChainRequirement

if TYPE_CHECKING:
    import shapely

    from mechwright.contracts.as_made import AsMade
    from mechwright.contracts.made_part import MadePart
    from mechwright.contracts.motion import Motion
    from mechwright.contracts.mounting import Mounting
    from mechwright.contracts.part import Part
    from mechwright.contracts.rule_list import Rules
    from mechwright.contracts.synthesis import Progress, Synthesis


class Chain(Family[ChainParams]):
    """Mechanisms of which each turns the next.

    It is made for the families of its stages, in their order, and is registered nowhere: a design file with
    tables ``[[stage]]`` is one.
    """

    name = "chain"
    title = "Chain of mechanisms"
    summary = "Mechanisms of which each turns the next, the output shaft of one the input shaft of the other."
    Params = ChainParams

    requirements: ClassVar[Mapping[str, type[Parameters]]] = {"least": ChainRequirement}

    def __init__(self, families: Families, base: ChainParams | None = None) -> None:
        """Of these families; ``base`` is the chain of a requirement's own stages."""
        self.families, self.base = families, base

    def rules(self) -> "Rules[Any]":
        """What each stage's family finds under the loads of the chain, and how the stages go together."""
        from mechwright.mechanics.chain.checks import rules_of

        return rules_of(self.families)

    def solve(self, params: ChainParams, samples: int) -> "Motion":
        """As many turns of the input as bring all stages back."""
        from mechwright.mechanics.chain.assembly import assembled

        return assembled(params, self.families, samples)

    def parts(self, params: ChainParams) -> "Sequence[Part]":
        """Those of all stages, and the shafts between them."""
        from mechwright.mechanics.chain.assembly import parts_of

        return parts_of(params, self.families)

    def mounting(self, params: ChainParams) -> "Mounting":
        """Where the shafts of all stages stand; raises MountingError where no frame holds them."""
        from mechwright.mechanics.chain.mounting import mounting_of

        return mounting_of(params, self.families)

    def synthesise(
        self, kind: str, requirement: Parameters, progress: "Progress"
    ) -> "Synthesis[ChainParams]":
        """The chain of a requirement's stages with the least of a figure, over some of their numbers."""
        from mechwright.mechanics.chain.seeking import sought

        if not isinstance(requirement, ChainRequirement) or self.base is None:
            return super().synthesise(kind, requirement, progress)
        return sought(requirement, self.base, self.families, progress)

    def settings(self, params: ChainParams) -> Mapping[str, ChainParams]:
        """Those of each stage."""
        from mechwright.mechanics.chain.made import settings_of

        return settings_of(params, self.families)

    def check_cut(self, params: ChainParams, cut: "Mapping[str, shapely.Polygon]") -> Sequence[Finding]:
        """What the family of each stage says of its parts as cut."""
        from mechwright.mechanics.chain.made import cut_findings

        return tuple(cut_findings(params, self.families, cut))

    def as_made(self, params: ChainParams, made: "Mapping[str, Sequence[MadePart]]") -> "AsMade":
        """What the family of each stage says of it with its parts as made."""
        from mechwright.mechanics.chain.made import as_made

        return as_made(params, self.families, made)
