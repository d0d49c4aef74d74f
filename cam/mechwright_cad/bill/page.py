"""The bill of materials as CSV, and as a page. Imports jinja2 and what reckons when the page is made."""

from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING

from mechwright.output.csv_text import csv_text
from mechwright.output.templates import templates
from mechwright.pipeline import Build, FileName, Page, RawStock, Wanted
from mechwright.pipeline.page import pages_of
from mechwright_cad.sheet.page import PartDrawings

if TYPE_CHECKING:
    from mechwright_cad.bill.lines import Line

STEM = "bill-of-materials"
"""Of both files."""

CSV, HTML = f"{STEM}.csv", f"{STEM}.html"


class BillOfMaterials(Page):
    """``bill-of-materials.csv`` and ``bill-of-materials.html``."""

    name = STEM
    commands = frozenset({"model", "build"})
    doing = "bill of materials"

    def late(self, build: Build) -> bool:
        """Whether a second process weighs the parts."""
        from mechwright_cad.solid_models import Solids

        return build.made_as_wanted(Solids).in_second_process

    def names(self, build: Build, wanted: Wanted) -> list[FileName]:  # noqa: ARG002
        """Both files."""
        return [FileName(name, "the bill of materials") for name in (CSV, HTML)] if build.parts else []

    def files(self, build: Build) -> dict[str, str]:
        """Both files; none for a mechanism without parts."""
        from mechwright.machine.made import electrics_for
        from mechwright_cad.assembly_order.plan import plan_of
        from mechwright_cad.bill.items import numbers_of
        from mechwright_cad.bill.lines import lines_of
        from mechwright_cad.bill.supplies import supplies_of
        from mechwright_cad.solid_models import Solids

        if not build.parts:
            return {}
        plan, order = build.made(plan_of), order_of(build)
        numbers = numbers_of(build.parts, order)
        known = [one for one in build.host.all(RawStock) if build.wanted.command in one.commands]
        blanks = [blank for one in known for blank in one.blanks(build)]
        feedstock = [each for one in known for each in one.feedstock(build)]
        masses = build.made_as_wanted(Solids).masses()
        seats = plan.order.seats
        bonded = [
            plan.bodies[match.pin].part.name
            for match in seats.matches
            if seats.kind(match) == "bonded" or seats.may_lack_interference(match)
        ]
        supplies = supplies_of(plan.bodies, plan.joints, numbers, bonded=bonded, sample=plan.sample)
        supplies += [each for one in known for each in one.supplies(build, numbers)]
        lines = lines_of(
            build.parts,
            masses,
            blanks,
            drawings_of(build),
            order,
            plan.torques,
            supplies,
            build.made(electrics_for),
            feedstock,
        )
        return {CSV: bill_csv(lines), HTML: bill_html(build.design.name, lines)}


def order_of(build: Build) -> list[str]:
    """Names of the parts as they come to hand when the mechanism is put together."""
    from mechwright_cad.assembly_order.plan import plan_of

    plan = build.made(plan_of)
    return list(dict.fromkeys(plan.bodies[k].part.name for k in plan.sequence))


def drawings_of(build: Build) -> dict[str, list[str]]:
    """Names of the drawings that are written, by part; with its program a plate has its outline besides."""
    drawings = [one for one in pages_of(build.host, build.wanted.command) if isinstance(one, PartDrawings)]
    found = {
        part.name: [part.name + end for end in one.suffixes]
        for one in drawings
        for part in build.parts
        if one.is_shown(part)
    }
    if build.wanted.command == "build":
        from mechwright.pipeline.process import MILL, plates_by

        for part in plates_by(build.design, build.parts, MILL):
            if part.kind == "plate":
                found.setdefault(part.name, []).append(f"{part.name}.dxf")
    return found


def bill_csv(lines: "list[Line]") -> str:
    """The lines under the names of their columns; masses to a hundredth of a gram."""
    from mechwright_cad.bill.lines import COLUMNS

    rows = ([getattr(line, column) for column in COLUMNS] for line in lines)
    said = ([f"{value:.2f}" if isinstance(value, float) else value for value in row] for row in rows)
    return csv_text([COLUMNS, *said])


def bill_html(design: str, lines: "list[Line]") -> str:
    """The same for people, with its sums."""
    kinds = {
        kind: [line for line in lines if line.kind == kind]
        for kind in ("made", "bought", "stock", "supply", "electrical")
    }
    bodies = [line for line in lines if line.kind in {"made", "bought"}]
    return (
        templates(Path(__file__).parent)
        .get_template("page.html")
        .render(
            design=design,
            csv=CSV,
            kinds=kinds,
            count=sum(line.qty for line in bodies),
            mass=sum(line.mass_g for line in bodies),
            raw=sum(line.mass_g for line in kinds["stock"]),
            bars=bars_of(kinds["stock"]),
        )
    )


SAW = 3.0
"""Width of a saw cut, mm."""


def bars_of(lines: "Sequence[Line]") -> list[tuple[str, float]]:
    """Round bars of each kind and the length of all pieces with their saw cuts, m."""
    found: dict[str, float] = {}
    for line in lines:
        bar, _, sawn = line.order.partition(", sawn ")
        if "round " in bar:
            found[bar] = found.get(bar, 0.0) + line.qty * (float(sawn.split()[0]) + SAW) / 1000
    return list(found.items())
