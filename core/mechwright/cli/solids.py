"""Solids: whether they collide, and their files; beside drawings and programs where that saves time."""

import sys
from collections.abc import Sequence
from typing import TYPE_CHECKING, cast

from mechwright.cli.beside import Beside, cores
from mechwright.design import Design
from mechwright.files import Output
from mechwright.findings import Finding, errors
from mechwright.output import Exporter

if TYPE_CHECKING:
    from mechwright.motion import Motion

    Work = tuple[Design, Sequence[Exporter], Motion, int]

Made = tuple[list[Finding], dict[str, bytes]]
"""What collides, and the files, name to content."""


def collisions(design: Design, *, solids: bool) -> list[Finding]:
    """Which bodies stand in each other while the mechanism moves; ``solids`` imports the CAD kernel."""
    from mechwright_cam.interference import interference_findings

    return interference_findings(design.family, design.params, solids=solids)


def solid_files(
    design: Design, exporters: Sequence[Exporter], motion: "Motion", sample: int
) -> dict[str, bytes]:
    """Every part, and the assembly at one sample of the motion, in every format: file name to content.

    Raises
    ------
    GeometryError
        A part cannot be made or is not right.
    OutputError
        Two files would have one name.
    """
    made = Output()
    parts = design.family.parts(design.params)
    placed = any(part.instances for part in parts)
    for exporter in exporters:
        for part in parts:
            made.add(part.name + exporter.suffix, exporter.part(part))
        assembly = exporter.assembly(design.name, parts, motion, sample) if placed else None
        if assembly is not None:
            made.add("assembly" + exporter.suffix, assembly)
    return made.files


def motion_page(design: Design, *, solids: bool) -> dict[str, bytes]:
    """The page on which the mechanism moves; ``solids`` imports the CAD kernel for what is no plate."""
    from mechwright_cam.animation import MOTION, page_of

    return {MOTION: page_of(design.name, design.family, design.params, solids=solids).encode()}


def compared_and_made(design: Design, exporters: Sequence[Exporter], motion: "Motion", sample: int) -> Made:
    """Whether bodies collide; and the files of a build, if none do."""
    met = collisions(design, solids=True)
    if errors(met):
        return met, {}
    return met, solid_files(design, exporters, motion, sample) | motion_page(design, solids=True)


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
        self._work = design, self._exporters, motion, sample
        if self._second is not None:
            self._second.ask(compared_and_made, *self._work)

    def collisions(self) -> list[Finding]:
        """Which bodies collide, and what else there is to say of that."""
        return collisions(self._begun[0], solids=True) if self._second is None else self._result()[0]

    def files(self) -> dict[str, bytes]:
        """File name to content."""
        if self._second is not None:
            return self._result()[1]
        page = motion_page(self._begun[0], solids=True) if self._build else {}
        return solid_files(*self._begun) | page

    @property
    def _begun(self) -> "Work":
        assert self._work is not None  # noqa: S101 - :meth:`begin` comes first
        return self._work

    def _result(self) -> "Made":
        if self._made is None:
            assert self._second is not None  # noqa: S101 - both callers have asked
            self._made = cast(Made, self._second.result(tuple))
        return self._made

    def __enter__(self) -> "SolidWork":
        return self

    def __exit__(self, *_: object) -> None:
        if self._second is not None:
            self._second.close()
