"""How the mechanism is put together: page and drawing. Imports what reckons when they are made."""

from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any

from mechwright.output.templates import templates
from mechwright.pipeline import Build, FileName, Page, Wanted

if TYPE_CHECKING:
    from mechwright.contracts.axial_stack import AxialStack
    from mechwright.contracts.part import Part
    from mechwright_cad.assembly_guide.pictures import Pictures
    from mechwright_cad.assembly_order.plan import Plan

SHEETS = ("assembly-drawing.dxf", "assembly-drawing.pdf")
"""The files of the drawing."""

HTML = "assembly.html"


class AssemblyGuide(Page):
    """The exploded view, the parts by their numbers, and the steps with pictures."""

    name = "assembly-guide"
    commands = frozenset({"model", "build"})
    doing = "order of assembly"

    def late(self, build: Build) -> bool:
        """Whether a second process makes solids meanwhile."""
        from mechwright_cad.solid_models import Solids

        return build.made_as_wanted(Solids).in_second_process

    def shown(self, build: Build) -> bool:
        """Whether a build has this page."""
        return bool(self.names(build, build.wanted))

    def names(self, build: Build, wanted: Wanted) -> list[FileName]:
        """The page and the drawing, as :meth:`files` writes them."""
        bodies = sum(len(part.instances) for part in build.parts)
        if wanted.command not in self.commands or bodies < 2:
            return []
        return [
            FileName(HTML, "the assembly guide"),
            *(FileName(name, "the assembly drawing") for name in SHEETS),
        ]

    def files(self, build: Build) -> dict[str, str | bytes]:
        """The page and the drawing; none for a mechanism of fewer than two bodies."""
        if not self.shown(build):
            return {}
        from mechwright_cad.assembly_guide.drawing import assembly_sheet
        from mechwright_cad.assembly_guide.in_space import assembly_scene
        from mechwright_cad.assembly_guide.pictures import Pictures
        from mechwright_cad.assembly_order.plan import plan_of
        from mechwright_cad.bill.items import items
        from mechwright_cad.bill.page import order_of
        from mechwright_cad.sheet.files import files
        from mechwright_cad.sheet.settings import DrawingTable
        from mechwright_cad.sheet.title import TitleBlock
        from mechwright_cad.solid_models import Solids

        plan, name = build.made(plan_of), build.design.name
        numbered = items(build.parts, order_of(build))
        pictures = Pictures(plan, {part.name: number for number, those in numbered.items() for part in those})
        title = TitleBlock(name, build.design.table(DrawingTable))
        sheet = assembly_sheet(pictures, numbered, title)
        masses = build.made_as_wanted(Solids).masses()
        shown = assembly_scene(build, plan, pictures.shifts, masses)
        return {
            HTML: assembly_html(name, plan, numbered, pictures, shown, build.design.stacks),
            **files(sheet, SHEETS, f"{name}: assembly", title),
        }


def assembly_html(
    design: str,
    plan: "Plan",
    numbered: "Mapping[int, Sequence[Part]]",
    pictures: "Pictures",
    shown: "Mapping[str, Any]",
    stacks: "Sequence[AxialStack]" = (),
) -> str:
    """The whole page; ``shown`` is what its viewer shows."""
    from mechwright_cad.assembly_guide.undoing import undone
    from mechwright_cad.assembly_guide.words import Words
    from mechwright_cad.bill.page import HTML as BILL
    from mechwright_cad.viewer import ANIMATION, VIEWER
    from mechwright_cad.viewer.script import script_data

    words = Words(plan, {part.name: number for number, those in numbered.items() for part in those}, stacks)
    steps: list[dict[str, Any]] = []
    for place, step in enumerate(plan.steps, start=1):
        title = words.title(step)
        steps.append(
            {
                "title": title,
                "start": words.names(step.onto) if len(step.onto) == 1 else "",
                "sentences": words.sentences(step),
                "picture": pictures.step(step, f"Step {place}: {title}"),
            }
        )
    parts = [
        {
            "number": number,
            "qty": sum(len(part.instances) for part in those),
            "name": ", ".join(part.name for part in those),
            "what": those[0].bought.designation if those[0].bought else those[0].material,
        }
        for number, those in numbered.items()
        if any(part.instances for part in those)
    ]
    return (
        templates(Path(__file__).parent, VIEWER, ANIMATION)
        .get_template("page.html")
        .render(
            design=design,
            steps=steps,
            torques=bool(plan.torques),
            parts=parts,
            undo=undone(plan, words.name),
            exploded=pictures.exploded(),
            bill=BILL,
            drawing=SHEETS[1],
            turned=plan.turned,
            input=plan.motion.input_name,
            moves=any(len(column) > 1 for pose in shown["poses"].values() for column in pose["columns"]),
            data=script_data(shown),
        )
    )
