"""What is printed of a design: each part compensated, its mesh, its places on the beds, and its filament.

Imports the CAD kernel where meshes are asked for.
"""

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property

from mechwright.contracts.part import Part
from mechwright.designs.design import Design
from mechwright.errors import DesignError
from mechwright.pipeline import Build
from mechwright_print.compensation.plates import Compensated, compensated
from mechwright_print.job.filament import filament_mass
from mechwright_print.job.laid_out import Placed, laid_out
from mechwright_print.meshes.printed_mesh import PrintedMesh, printed_mesh
from mechwright_print.printer.settings import Printer
from mechwright_print.settings import PrintSettings
from mechwright_print.table import printing_of


def copies(part: Part) -> int:
    """How many of a part are printed."""
    return max(1, len(part.instances))


def printed_parts(design: Design, parts: Sequence[Part]) -> list[Part]:
    """The parts of a design that are printed.

    Raises DesignError for a part that is named and is not there, or is turned or bought.
    """
    settings = printing_of(design).settings
    able = [part for part in parts if part.kind in {"plate", "solid"}]
    _check_names(design, settings, parts)
    if not settings.parts:
        return [part for part in able if part.instances] or able
    return [part for part in able if part.name in settings.parts]


def _check_names(design: Design, settings: PrintSettings, parts: Sequence[Part]) -> None:
    by_name = {part.name: part for part in parts}
    able = ", ".join(part.name for part in parts if part.kind in {"plate", "solid"}) or "none"
    named = [("parts", one) for one in settings.parts] + [("flip", one) for one in settings.flip]
    named += [("holes", key.partition(".")[0]) for key in settings.holes]
    for key, name in named:
        if name not in by_name:
            raise DesignError(f"{design.path}: print.{key}: no part is named {name!r}; there is: {able}")
        if by_name[name].kind not in {"plate", "solid"}:
            raise DesignError(
                f"{design.path}: print.{key}: {name} is {by_name[name].kind}, and stays metal; it can be: {able}"
            )


@dataclass(frozen=True, eq=False)
class JobPart:
    """A part of the job: as compensated, and whether it lies on its top face."""

    made: Compensated
    on_top: bool

    @property
    def part(self) -> Part:
        """As designed."""
        return self.made.part


class PrintJob:
    """The print of a design, each thing worked out once."""

    def __init__(self, build: Build) -> None:
        printing = printing_of(build.design)
        self.settings: PrintSettings = printing.settings
        self.printer: Printer = printing.printer
        self.design = build.design
        self._parts = build.parts

    @cached_property
    def parts(self) -> list[JobPart]:
        """The printed parts; raises as :func:`printed_parts` and :func:`compensated` do."""
        return [
            JobPart(compensated(part, self.settings, self.printer), part.name in self.settings.flip)
            for part in printed_parts(self.design, self._parts)
        ]

    @cached_property
    def meshes(self) -> dict[str, PrintedMesh]:
        """The mesh of each part by its name; raises GeometryError where one cannot be made."""
        correct = self.settings.compensate == "model"
        return {
            one.part.name: printed_mesh(one.made, self.printer, on_top=one.on_top, correct=correct)
            for one in self.parts
        }

    @cached_property
    def beds(self) -> list[list[Placed]]:
        """Where the copies lie; raises DesignError as :func:`laid_out` does."""
        meshes = [(one.part.name, self.meshes[one.part.name], copies(one.part)) for one in self.parts]
        return laid_out(meshes, self.printer.bed, self.settings.gap)

    @cached_property
    def masses(self) -> dict[str, float]:
        """Filament in one copy of each part by its name, g."""
        return {
            one.part.name: filament_mass(
                one.made.model, self.meshes[one.part.name], self.settings, self.printer
            )
            for one in self.parts
        }

    @property
    def metal(self) -> list[Part]:
        """Turned parts: they stay metal, cut from rod."""
        return [part for part in self._parts if part.kind == "turned" and part.instances]

    @property
    def bought(self) -> list[Part]:
        """Parts that are bought."""
        return [part for part in self._parts if part.kind == "bought" and part.instances]
