"""What is printed of a design: each part compensated, its mesh, its places on the beds, and its filament.

Imports the CAD kernel where meshes are asked for.
"""

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING

from mechwright.contracts.part import Part
from mechwright.designs.design import Design
from mechwright.errors import DesignError
from mechwright.pipeline import Build
from mechwright.pipeline.process import ProcessSettings, ProcessTable, plates_by, plates_of
from mechwright_print.compensation.plates import Compensated, compensated
from mechwright_print.printer.settings import Printer
from mechwright_print.settings import PRINT, PrintSettings
from mechwright_print.table import is_printed, printing_of

if TYPE_CHECKING:
    from mechwright_print.meshes.laid_out import Placed
    from mechwright_print.meshes.printed_mesh import PrintedMesh

PRINTABLE = frozenset({"plate", "solid"})
"""Kinds of parts that are printed; what is turned or bought stays metal."""


def copies(part: Part) -> int:
    """How many of a part are printed."""
    return max(1, len(part.instances))


def printed_parts(design: Design, parts: Sequence[Part]) -> list[Part]:
    """The parts of a design that are printed: plates of this process, or all where it says nothing of it.

    Parts of free form go along where plates are printed by default. Raises DesignError for a part that
    ``[print]`` names and that is not there, or stays metal.
    """
    _check_names(design, printing_of(design).settings, parts)
    said: ProcessSettings = design.table(ProcessTable)
    own = plates_by(design, parts, PRINT)
    chosen = bool(own) or said.default == PRINT
    plates = own if chosen else plates_of(parts)
    bodies = [part for part in parts if part.kind == "solid"] if said.default == PRINT or not chosen else []
    able = [part for part in (*plates, *bodies) if part.kind in PRINTABLE]
    return [part for part in able if part.instances] or able


def is_asked(design: Design, parts: Sequence[Part]) -> bool:
    """Whether a design says anything of printing, in its table or as a process."""
    return is_printed(design) or bool(plates_by(design, parts, PRINT))


def _check_names(design: Design, settings: PrintSettings, parts: Sequence[Part]) -> None:
    by_name = {part.name: part for part in parts}
    able = ", ".join(part.name for part in parts if part.kind in PRINTABLE) or "none"
    named = [("flip", one) for one in settings.flip]
    named += [("holes", key.partition(".")[0]) for key in settings.holes]
    for key, name in named:
        if name not in by_name:
            raise DesignError(f"{design.path}: print.{key}: no part is named {name!r}; there is: {able}")
        if by_name[name].kind not in PRINTABLE:
            raise DesignError(
                f"{design.path}: print.{key}: {name} is {by_name[name].kind}, and stays metal; it can be: "
                f"{able}"
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

    def of(self, part: Part) -> JobPart:
        """A part of the design as this job prints it, whether it does or not."""
        for one in self.parts:
            if one.part.name == part.name:
                return one
        return JobPart(compensated(part, self.settings, self.printer), part.name in self.settings.flip)

    def seconds(self, part: Part) -> float:
        """How long one copy takes at the printer's flow, s; travels and small, slow layers add to it."""
        one = self.of(part)
        from mechwright_print.job.filament import filament_mass

        mesh = None if part.outline is not None else self.meshes.get(part.name) or self.mesh_of(one)
        grams = filament_mass(one.made.model, mesh, self.settings, self.printer)
        return grams / self.printer.grams_per_mm3 / self.printer.flow

    def mesh_of(self, one: JobPart) -> "PrintedMesh":
        """The mesh of a part; raises GeometryError where it cannot be made."""
        from mechwright_print.meshes.printed_mesh import printed_mesh

        correct = self.settings.compensate == "model"
        return printed_mesh(one.made, self.printer, on_top=one.on_top, correct=correct)

    @cached_property
    def meshes(self) -> "dict[str, PrintedMesh]":
        """The mesh of each part by its name; raises GeometryError where one cannot be made."""
        return {one.part.name: self.mesh_of(one) for one in self.parts}

    @cached_property
    def beds(self) -> "list[list[Placed]]":
        """Where the copies lie; raises DesignError as :func:`laid_out` does."""
        from mechwright_print.meshes.laid_out import laid_out

        meshes = [(one.part.name, self.meshes[one.part.name], copies(one.part)) for one in self.parts]
        return laid_out(meshes, self.printer.bed, self.settings.gap)

    @cached_property
    def masses(self) -> dict[str, float]:
        """Filament in one copy of each part by its name, g."""
        from mechwright_print.job.filament import filament_mass

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
