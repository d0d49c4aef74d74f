"""The mechanism with its plates as their programs leave them, whichever processes make them."""

from collections.abc import Sequence
from dataclasses import replace

from mechwright.contracts.as_made import AsMade
from mechwright.contracts.finding import Finding, Stage, at_stage
from mechwright.contracts.made_part import MadePart
from mechwright.pipeline.build import Build
from mechwright.pipeline.inspection import Inspection
from mechwright.pipeline.process import Process, plates_of, process_of
from mechwright.pipeline.work import PROGRAMS


def produced_plates(build: Build) -> dict[str, list[MadePart]]:
    """The copies of each plate as made, by its name; empty where one of them is not known."""
    known = {one.name: one for one in build.host.all(Process)}
    found: dict[str, list[MadePart]] = {}
    for part in plates_of(build.parts):
        process = known.get(process_of(build.design, part.name))
        copies = () if process is None else process.produced(part, build)
        if not copies:
            return {}
        found[part.name] = list(copies)
    return found


def as_made(build: Build) -> AsMade:
    """What the family says of its mechanism with plates as made; nothing where one of them is not known.

    Raises what making their programs does.
    """
    plates = build.made(produced_plates)
    if not plates:
        return AsMade()
    design = build.design
    said = design.family.as_made(design.params, plates)
    return replace(said, findings=tuple(at_stage(Stage.OUTPUT, said.findings)))


class RunningAsMade(Inspection):
    """What the family says of the mechanism with its plates as made."""

    name = "running-as-made"
    stage = Stage.OUTPUT
    needs = frozenset({PROGRAMS})
    order = 41
    limited = False
    doing = "parts as made"
    share = 50.0

    def findings(self, build: Build) -> Sequence[Finding]:
        """What keeps it from being put together, or from turning."""
        return build.made(as_made).findings
