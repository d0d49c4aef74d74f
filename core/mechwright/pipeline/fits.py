"""Pins in holes of which nobody says how tightly they go."""

from collections.abc import Iterator, Sequence

from mechwright.contracts.finding import Finding, Stage
from mechwright.pipeline.build import Build
from mechwright.pipeline.inspection import Inspection


class DeclaredFits(Inspection):
    """Pairs of round faces, of which one belongs to a bought part that has no limits for it."""

    name = "fits"
    stage = Stage.ASSEMBLY
    order = 11
    doing = "fits"

    def findings(self, build: Build) -> Sequence[Finding]:
        """An error for each pair of parts."""
        return tuple(_findings(build))


def _findings(build: Build) -> Iterator[Finding]:
    from mechwright.contracts.bodies import placed
    from mechwright.mechanics.mating.choice import Assembled
    from mechwright.mechanics.mating.rounds import ROOM

    motion = build.design.solve(2)
    whole = Assembled(placed(build.parts, motion), motion)
    told: set[tuple[str, str]] = set()
    for match in whole.matches:
        pin, hole = whole.bodies[match.pin].part, whole.bodies[match.hole].part
        pair, clearance = (pin.name, hole.name), match.inside.diameter - match.outside.diameter
        if not match.unsaid or clearance >= ROOM or pair in told:
            continue
        told.add(pair)
        silent = pin if match.outside.fit is None else hole
        yield Finding.error(
            "fit.missing",
            "",
            f"{pin.name} goes into {hole.name}, {match.text}, and {silent.name} says no limits of its size",
            remedy=f"give the family's part {silent.name} a fit of {match.outside.diameter:g} mm",
            stage=Stage.ASSEMBLY,
        )
