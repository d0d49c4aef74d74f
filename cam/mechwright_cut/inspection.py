"""Whether what is cut can be cut, and whether each program is proven."""

from collections.abc import Sequence

from mechwright.contracts.finding import Finding, Stage, at_stage
from mechwright.contracts.part import Part
from mechwright.pipeline import PROGRAMS, Build, Inspection
from mechwright.pipeline.process import Process


class Cuttable(Inspection):
    """What kerf, sheet and process say of the parts."""

    name = "cutting"
    stage = Stage.MACHINING
    order = 21
    doing = "cutting programs"
    share = 5.0

    def findings(self, build: Build) -> Sequence[Finding]:
        """What forbids or hampers cutting; of each plate that is cut, its time and what it loses."""
        from mechwright_cut.cutting import Cutting
        from mechwright_cut.straying import running_findings

        cutting = build.made(Cutting)
        known = {one.name: one for one in build.host.all(Process)}
        notes = [
            Finding.note("cut.process", _summary(part, known[name], build))
            for name, parts in cutting.plates.items()
            for part in parts
            if name in known and not known[name].refuses(part, build)
        ]
        running = at_stage(Stage.MACHINING, running_findings(build))
        return [*cutting.findings, *running, *notes]


def _summary(part: Part, process: Process, build: Build) -> str:
    """A plate's time and losses by its process, in a sentence."""
    seconds = process.seconds(part, build)
    time = "" if seconds is None else f" takes about {max(seconds / 60, 0.1):.1f} min, and"
    lost = "; ".join(process.loses(part, build))
    return f"{part.name}: {process.title}{time} gives {lost}"


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
