"""Solids: whether they collide, and their files; beside drawings and programs where that saves time."""

import sys
from collections.abc import Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from typing import TYPE_CHECKING, cast

from mechwright.cli.beside import Beside
from mechwright.contracts.exporter import Exporter
from mechwright.contracts.finding import Finding, errors
from mechwright.cores import cores
from mechwright.design.design import Design
from mechwright.output.folder import Output

if TYPE_CHECKING:
    from mechwright.contracts.motion import Motion
    from mechwright.contracts.part import Part

Made = tuple[list[Finding], dict[str, bytes]]
"""What collides, and the files, name to content."""


@dataclass(frozen=True)
class Work:
    """What is to be done: a design whose own check has found no error, and where its assembly stands.

    ``known`` are the parts, if they have been made: it takes no work to make them again, but in a second
    process, to which only plates can be sent.
    """

    design: Design
    exporters: Sequence[Exporter]
    motion: "Motion"
    sample: int
    known: "Sequence[Part] | None" = None

    @cached_property
    def parts(self) -> "Sequence[Part]":
        """The parts of the design."""
        return self.design.family.parts(self.design.params) if self.known is None else self.known

    def collisions(self) -> list[Finding]:
        """Which bodies stand in each other while the mechanism moves. Imports the CAD kernel."""
        return collisions(self.design, solids=True, parts=self.parts)

    def solid_files(self) -> dict[str, bytes]:
        """Every part, and the assembly, in every format: file name to content.

        Raises
        ------
        GeometryError
            A part cannot be made or is not right.
        OutputError
            Two files would have one name.
        """
        made = Output()
        placed = any(part.instances for part in self.parts)
        for exporter in self.exporters:
            for part in self.parts:
                made.add(part.name + exporter.suffix, exporter.part(part))
            name = self.design.name
            assembly = exporter.assembly(name, self.parts, self.motion, self.sample) if placed else None
            if assembly is not None:
                made.add("assembly" + exporter.suffix, assembly)
        return made.files

    def build_files(self) -> dict[str, bytes]:
        """The same, and the page on which the mechanism moves, with its solids."""
        return self.solid_files() | motion_page(self.design, solids=True, parts=self.parts)


def collisions(design: Design, *, solids: bool, parts: "Sequence[Part] | None" = None) -> list[Finding]:
    """Which bodies stand in each other while the mechanism moves; ``solids`` imports the CAD kernel."""
    from mechwright_cad.interference import interference_findings

    return interference_findings(design.family, design.params, solids=solids, parts=parts)


def motion_page(design: Design, *, solids: bool, parts: "Sequence[Part] | None" = None) -> dict[str, bytes]:
    """The page on which the mechanism moves; ``solids`` imports the CAD kernel for what is no plate."""
    from mechwright_cad.animation import MOTION, page_of

    page = page_of(design.name, design.family, design.params, solids=solids, parts=parts)
    return {MOTION: page.encode()}


def compared_and_made(work: Work) -> Made:
    """Whether bodies collide; and the files of a build, if none do."""
    met = work.collisions()
    return met, {} if errors(met) else work.build_files()


class SolidWork:
    """The solids of one run, compared and written in this process, or in a second one.

    Parameters
    ----------
    exporters
        One for each format.
    build
        Whether the motion is shown as well, and there is other work meanwhile. The second process is begun
        only if it gains something: if a library that the exporters need is not imported yet, and there is a
        core to do it.
    """

    def __init__(self, exporters: Sequence[Exporter], *, build: bool) -> None:
        self._exporters, self._build = exporters, build
        heavy = sorted({module for exporter in exporters for module in exporter.modules} - set(sys.modules))
        self._second = Beside(heavy) if build and heavy and cores() > 1 else None
        self._work: Work | None = None
        self._made: Made | None = None

    @property
    def beside(self) -> bool:
        """Whether a second process is at it: other work comes first then."""
        return self._second is not None

    def begin(self, design: Design, motion: "Motion", sample: int) -> None:
        """Say what is to be done: a design whose own check has found no error, and where it stands."""
        self._work = Work(design, self._exporters, motion, sample)
        if self._second is not None:
            parts = self._work.parts
            plates = all(part.build is None for part in parts)
            self._second.ask(compared_and_made, replace(self._work, known=parts if plates else None))

    def collisions(self) -> list[Finding]:
        """Which bodies collide, and what else there is to say of that."""
        return self._begun.collisions() if self._second is None else self._result()[0]

    def files(self) -> dict[str, bytes]:
        """File name to content."""
        if self._second is not None:
            return self._result()[1]
        return self._begun.build_files() if self._build else self._begun.solid_files()

    @property
    def _begun(self) -> Work:
        assert self._work is not None  # noqa: S101 - :meth:`begin` comes first
        return self._work

    def _result(self) -> Made:
        if self._made is None:
            assert self._second is not None  # noqa: S101 - both callers have asked
            self._made = cast(Made, self._second.result(tuple))
        return self._made

    def __enter__(self) -> "SolidWork":
        return self

    def __exit__(self, *_: object) -> None:
        if self._second is not None:
            self._second.close()
