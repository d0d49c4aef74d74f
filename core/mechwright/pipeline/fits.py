"""Pins in holes of which nobody says how tightly they go, and pins that have to turn and may jam."""

from collections.abc import Iterator, Sequence
from typing import TYPE_CHECKING

from mechwright.contracts.finding import Finding, Stage, at_stage
from mechwright.pipeline.build import Build
from mechwright.pipeline.inspection import Inspection

if TYPE_CHECKING:
    from mechwright.mechanics.mating.choice import Assembled
    from mechwright.mechanics.mating.rounds import Match


class DeclaredFits(Inspection):
    """Every pair of round faces has limits, and those that turn have play."""

    name = "fits"
    stage = Stage.ASSEMBLY
    order = 11
    doing = "fits"

    def findings(self, build: Build) -> Sequence[Finding]:
        """One for each pair of parts."""
        from mechwright.contracts.bodies import placed
        from mechwright.mechanics.mating.choice import Assembled

        if not build.parts:
            return []
        motion = build.design.solve(2)
        return at_stage(self.stage, fit_findings(Assembled(placed(build.parts, motion), motion)))


def fit_findings(whole: "Assembled") -> Iterator[Finding]:
    """One for each pair of parts, in their order."""
    from mechwright.mechanics.mating.rounds import ROOM

    pairs = {whole.pair(match): match for match in reversed(whole.matches)}
    for match in reversed(pairs.values()):
        pin, hole = whole.bodies[match.pin].part, whole.bodies[match.hole].part
        if match.missing_fits:
            if match.inside.diameter - match.outside.diameter < ROOM:
                yield _missing(whole, match)
        elif not whole.same_group(match) and pin.bought is None and hole.bought is None and match.play[0] < 0:
            yield _jams(whole, match)


def _missing(whole: "Assembled", match: "Match") -> Finding:
    pin, hole = whole.bodies[match.pin].part, whole.bodies[match.hole].part
    silent = pin if match.outside.fit is None else hole
    return Finding.error(
        "fit.missing",
        "",
        f"{pin.name} goes into {hole.name}, {match.text}, and {silent.name} says no limits of its size",
        remedy=f"give the family's part {silent.name} a fit of {match.outside.diameter:g} mm",
    )


def _jams(whole: "Assembled", match: "Match") -> Finding:
    """An error where the pin is tight in the middle of the limits, else a warning."""
    least, greatest = match.play
    make = Finding.error if least + greatest <= 0 else Finding.warning
    pin, hole = whole.bodies[match.pin].part, whole.bodies[match.hole].part
    return make(
        "fit.jams",
        "fits.running",
        f"{pin.name} turns in {hole.name}, {match.text}, with a play of {least:.3f} to {greatest:.3f} mm, so "
        "that it may jam",
        least,
        0.0,
        "mm",
        'set running = "G7" in [fits], or draw it with more clearance',
        proposed=({"fits.running": "G7"},),
    )
