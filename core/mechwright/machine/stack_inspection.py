"""Whether the axial stacks of a build close with the play that is meant."""

import math
from collections.abc import Iterator, Sequence

from mechwright.contracts.axial_stack import AxialStack
from mechwright.contracts.finding import Finding, Stage, at_stage
from mechwright.mechanics.tolerance.axial_stacks import nearest_nominal
from mechwright.pipeline.build import Build
from mechwright.pipeline.inspection import Inspection
from mechwright.tolerances import TOLERANCES


class AxialStacks(Inspection):
    """Stacks of lengths that pinch, or leave more play than is meant, with all tolerances at their worst."""

    name = "axial-stacks"
    stage = Stage.ASSEMBLY
    order = 16
    doing = "axial stacks"

    def findings(self, build: Build) -> Sequence[Finding]:
        """An error for each stack that does not close."""
        return at_stage(self.stage, stack_findings(build.design.stacks))


def stack_findings(stacks: Sequence[AxialStack]) -> Iterator[Finding]:
    """An error for each stack whose least or greatest play is outside of what is meant."""
    for one in stacks:
        low, high = one.play
        if low < one.least - TOLERANCES.closure:
            yield _fault(one, "stack.pinched", low, one.least, "closes to", "at least")
        elif high > one.greatest + TOLERANCES.closure:
            yield _fault(one, "stack.loose", high, one.greatest, "opens to", "at most")


def _fault(one: AxialStack, code: str, play: float, limit: float, does: str, bound: str) -> Finding:
    works, changed = nearest_nominal(one), one.changed
    if works is None:
        widest = max(one.lengths, key=lambda part: part.half)
        remedy = (
            f"narrow its tolerances, or put in shim rings after measuring; the widest is {widest.name}, "
            f"{widest.lower:g} to {widest.upper:g} mm"
        )
    else:
        # Rounded outwards, so that the length that is named does close.
        rounded = (math.ceil if works > changed.nominal else math.floor)(round(1000 * works, 6)) / 1000
        remedy = f"make {changed.name} {rounded:g} mm, now {changed.nominal:g}"
    return Finding.error(
        code,
        one.key,
        f"{one.name} {does} {play:.3f} mm with all lengths at their limits; {bound} {limit:g} mm are meant",
        play,
        limit,
        "mm",
        remedy,
    )
