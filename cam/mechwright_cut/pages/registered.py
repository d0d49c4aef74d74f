"""The pages of the room: programs, drawings for a service, proofs, and the page of all that is cut."""

import json
from typing import TYPE_CHECKING

from mechwright.pipeline import Build, FileName, Page, Wanted
from mechwright.pipeline.page import unless_forbidden

if TYPE_CHECKING:
    from mechwright_cut.cutting import Cutting

PAGE, PROOFS = "cut.html", "cut-proof.json"
COMMANDS = frozenset({"cut", "build"})
DOING = "cutting programs"


def _cutting(build: Build) -> "Cutting | None":
    """What is cut; None where nothing is, or a finding forbids it."""
    from mechwright_cut.cutting import Cutting

    cutting = build.made(Cutting)
    return unless_forbidden(cutting) if cutting.plates else None


class CutPrograms(Page):
    """Programs, and drawings for a service."""

    name = "cut-programs"
    commands = COMMANDS
    doing = DOING
    share = 10.0

    def names(self, build: Build, wanted: Wanted) -> list[FileName]:  # noqa: ARG002
        """One for each sheet, or for each part that a service cuts."""
        cutting = _cutting(build)
        if cutting is None:
            return []
        sheets = [FileName(name, f"the cutting program {name}") for name in cutting.program_names]
        return [*sheets, *(FileName(name, f"the drawing {name}") for name in cutting.drawing_names)]

    def files(self, build: Build) -> dict[str, str | bytes]:
        """Text or drawing by file; raises ProofError where a program is not proven."""
        cutting = _cutting(build)
        if cutting is None:
            return {}
        return {**{one.name + one.suffix: one.text for one in cutting.programs}, **cutting.drawings}


class CutSheets(Page):
    """The page of all that is cut, and the proofs."""

    name = "cut-sheets"
    commands = COMMANDS
    doing = DOING

    def names(self, build: Build, wanted: Wanted) -> list[FileName]:  # noqa: ARG002
        """The page, and the proofs of programs."""
        cutting = _cutting(build)
        if cutting is None:
            return []
        proofs = [FileName(PROOFS, "the proofs of cutting programs")] if cutting.program_names else []
        return [FileName(PAGE, "the page of what is cut"), *proofs]

    def files(self, build: Build) -> dict[str, str]:
        """The page, and every check of every program by name."""
        from mechwright_cut.pages.sheet_page import cut_html

        cutting = _cutting(build)
        if cutting is None:
            return {}
        found = {PAGE: cut_html(cutting, build.design.name)}
        if cutting.programs:
            proofs = {one.name: one.proof.as_dict() for one in cutting.programs}
            found[PROOFS] = json.dumps(proofs, indent=2) + "\n"
        return found
