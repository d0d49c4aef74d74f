"""A checker of whole machines: what is written of one against its parts, its solids and its order of assembly.

:func:`machine_of` makes a design, or opens one with the files that a command has written; :func:`faults` says
in words what is wrong. No fault is found twice by the same means: limits are read from the papers, round faces
and volumes from STEP files, steps are replayed.

Glossary
--------
papers
    All that is written: drawings, sheets, pages, lists.
pair
    A round face inside of another one whose diameter is nearly its own.
"""

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from pathlib import Path

from cam.assembly_check import faults as order_faults
from machine_list import list_faults
from machine_papers import drawing_faults, guide_faults, sheet_faults, tolerance_faults
from machine_solids import Solid, pair_faults, read_solids, solid_faults
from machine_stacks import stack_faults

from mechwright.contracts.axial_stack import AxialStack
from mechwright.contracts.finding import Finding
from mechwright.contracts.part import Part
from mechwright.machine.made import settings_of
from mechwright.pipeline import Build, Run, Wanted
from mechwright.pipeline.page import pages_of
from mechwright.pipeline.work import WORK
from mechwright.plugins.host import host
from mechwright_cad.assembly_order.inspections import unretained
from mechwright_cad.assembly_order.plan import Plan, plan_of


@dataclass(frozen=True)
class Machine:
    """A design with its order of assembly and the files that were written of it."""

    parts: tuple[Part, ...]
    plan: Plan
    stacks: tuple[AxialStack, ...]
    files: Mapping[str, bytes]
    found: tuple[Finding, ...] = ()
    has_frame: bool = True

    @cached_property
    def solids(self) -> Mapping[str, Sequence[Solid]]:
        """The solids of each STEP file, by its name without ending."""
        return {
            name.removesuffix(".step"): read_solids(content)
            for name, content in self.files.items()
            if name.endswith(".step")
        }

    def without(self, *names: str) -> "Machine":
        """The same without some files."""
        return replace(self, files={name: one for name, one in self.files.items() if name not in names})

    def rewritten(self, name: str, old: str, new: str) -> "Machine":
        """The same with words of a file exchanged, all of them; they have to be there."""
        text = self.files[name].decode()
        assert old in text, f"{name} has no {old!r}"
        return replace(self, files={**self.files, name: text.replace(old, new).encode()})


def machine_of(path: Path, command: str = "model") -> Machine:
    """A design, made as a command makes it, with drawings of its plates.

    Raises RefusedError for one that is refused.
    """
    with Build(path, host(), Wanted(command, formats=("dxf",) if command == "model" else ())) as build:
        run = Run(build, WORK[command])
        made = run.make(pages_of(build.host, command))
        plan = build.made(plan_of)
        files = {
            name: content if isinstance(content, bytes) else b"".join(content)
            for name, content in made.files.items()
        }
        framed = settings_of(build).frame != "none"
        return Machine(tuple(build.parts), plan, build.design.stacks, files, tuple(run.findings), framed)


def faults(machine: Machine) -> list[str]:
    """All that is wrong with a machine, in words."""
    return list(dict.fromkeys(_faults(machine)))


def _faults(machine: Machine) -> Iterator[str]:
    parts, plan, files = machine.parts, machine.plan, machine.files
    yield from list_faults(parts, plan, files, machine.solids)
    yield from solid_faults(parts, plan, machine.solids)
    yield from pair_faults(plan, machine.solids)
    yield from drawing_faults(parts, files)
    yield from sheet_faults(parts, files)
    yield from guide_faults(parts, plan, files)
    yield from tolerance_faults(plan, files)
    yield from stack_faults(parts, machine.stacks, files)
    yield from _steps(machine)


TOLD = {"units fall": "assembly.held", "has no support": "assembly.press"}
"""Words of a fault of the order to the code of the warning that tells a fitter of it."""


def _steps(machine: Machine) -> Iterator[str]:
    """Steps that one fitter cannot do and of which nothing is told, and bodies that nothing retains.

    Without a frame shafts and what is on them are held by somebody else.
    """
    codes = {one.code for one in machine.found}
    known = {words for words, code in TOLD.items() if code in codes}
    known |= set() if machine.has_frame else {"units fall"}
    yield from (one for one in order_faults(machine.plan) if not any(words in one for words in known))
    if machine.has_frame:
        yield from (one.message for one in unretained(machine.plan.order))
