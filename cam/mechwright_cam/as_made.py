"""The parts of a build as its programs leave them, and what the family says of a mechanism of such parts."""

from functools import cached_property

import numpy as np

from mechwright.contracts.as_made import AsMade
from mechwright.contracts.finding import Finding, Severity, Stage
from mechwright.contracts.made_part import MadePart
from mechwright.pipeline import Build
from mechwright.pipeline.as_made import as_made
from mechwright.tolerances import TOLERANCES
from mechwright_cam.machining import Machining
from mechwright_cam.proof.as_made_parts import parts_as_made, placed_in, with_undersides

OPEN = TOLERANCES.leftover
"""A wall is not cut where more than this stays on it, mm: the outline is not closed there."""


class AsMadeParts:
    """What the programs of a build leave, each thing worked out once."""

    def __init__(self, build: Build) -> None:
        self._build = build

    @cached_property
    def parts(self) -> list[MadePart]:
        """One for each copy that a program makes; none where a finding forbids programs."""
        found: list[MadePart] = []
        first: list[MadePart] = []
        for item in self._build.made(Machining).proven_programs:
            if item.job.side == "top":
                placed, first = placed_in(item.scene), parts_as_made(item.scene)
            else:
                del found[-len(first) :]
                first = with_undersides(first, placed, item.scene)
            found += first
        return found

    @cached_property
    def open(self) -> tuple[Finding, ...]:
        """What keeps the parts from being judged: walls that are not cut."""
        return tuple(finding for part in self.parts for finding in not_closed(part))

    @cached_property
    def analysis(self) -> AsMade:
        """What the family says, with what keeps the parts from being judged."""
        if self.open or not self.parts:
            return AsMade(findings=self.open)
        return self._build.made(as_made)


def not_closed(part: MadePart) -> list[Finding]:
    """An error where a wall of the part is not cut, so that it has no outline to judge."""
    for section in part.sections:
        for ring in section.rings:
            off = np.where(ring.corner, 0.0, ring.off)
            worst = int(np.argmax(off))
            if off[worst] > OPEN:
                x, y = ring.points[worst].tolist()
                left = f"{off[worst]:.3f} mm stay" if np.isfinite(off[worst]) else "no cutter comes"
                return [
                    Finding(
                        "made.open",
                        Severity.ERROR,
                        f"cam.part.{part.name}",
                        f"the program leaves {part.label} no closed outline: {left} on its wall at "
                        f"X{x:.3f} Y{y:.3f}, {section.bottom:g} mm deep; the limit is {OPEN:g} mm",
                        float(off[worst]) if np.isfinite(off[worst]) else None,
                        OPEN,
                        "mm",
                        "have that wall finished",
                        Stage.OUTPUT,
                    )
                ]
    return []
