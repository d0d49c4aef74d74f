"""The solids of a build: whether they collide, their files, and the page on which they move.

All of it takes the CAD kernel, which takes long to import; in ``build`` a second process does it beside
drawings and programs, where there is a core for that.
"""

import sys
from collections.abc import Sequence
from concurrent.futures import Future
from dataclasses import dataclass, replace
from functools import cached_property
from typing import TYPE_CHECKING

from mechwright.contracts.exporter import Exporter
from mechwright.contracts.file_names import free_name
from mechwright.contracts.finding import Finding, errors
from mechwright.contracts.holes import joined
from mechwright.designs.design import Design
from mechwright.errors import GeometryError, MechwrightError
from mechwright.output.folder import Output
from mechwright.pipeline import SOLIDS, Build, FileName, Wanted
from mechwright.plugins.host import Host
from mechwright.worker_pool.budget import available_cores
from mechwright.worker_pool.pool import WorkerPool

if TYPE_CHECKING:
    from mechwright.contracts.motion import Motion
    from mechwright.contracts.part import Part

SolidResults = tuple[list[Finding], dict[str, bytes], dict[str, float]]
"""What collides; the files, name to content; and the mass of one of each part, g."""


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
        return self.design.parts() if self.known is None else self.known

    def files(self) -> dict[str, bytes]:
        """Every part, and the assembly, in every format: file name to content.

        Raises GeometryError for a part that cannot be made, OutputError where two files would have one name.
        """
        made = Output()
        for exporter in self.exporters:
            contents = [(part.name, exporter.part(part)) for part in self.parts]
            contents.append((assembly_stem(self.parts), self._assembly(exporter)))
            written = [(name, content) for name, content in contents if content is not None]
            for name, content in written:
                made.add(name + exporter.suffix, content)
            if not written:
                raise GeometryError(
                    f"{exporter.name} holds whole mechanisms, and no part of this design has a place in one"
                )
        return {name: content for name, content in made.files.items() if isinstance(content, bytes)}

    def _pose(self, samples: int) -> "tuple[Motion, int]":
        """The motion with so many samples at least, and the one of the assembly."""
        if self.motion.samples >= samples or self.sample > 0 or not self.design.family.moves:
            return self.motion, self.sample
        return self.design.solve(samples), 0

    def _assembly(self, exporter: Exporter) -> bytes | None:
        if not any(part.instances for part in self.parts):
            return None
        try:
            configured = exporter.configured(self.design.tables)
            return configured.assembly(self.design.name, self.parts, *self._pose(configured.samples))
        except MechwrightError as error:
            family = self.design.family.name
            raise GeometryError(
                f"{exporter.name} cannot hold a mechanism of the family {family}: {error}"
            ) from error


def assembly_stem(parts: "Sequence[Part]") -> str:
    """Of the files of the whole: assembly, with a number behind it where a part has that name."""
    return free_name("assembly", [part.name for part in parts])


def exporters_of(host: Host, wanted: Wanted) -> list[Exporter]:
    """The formats that are written; raises PluginError for one that is not installed."""
    named = ["step", *(name for name in wanted.formats if name != "step")]
    if wanted.command == "build":  # drawings are written with the programs
        named = [name for name in named if name != "dxf"]
    return [host.get(Exporter, name) for name in named]


def solid_names(build: Build, wanted: Wanted) -> list[FileName]:
    """The files of :class:`Solids` before they are made."""
    parts = build.parts
    whole = assembly_stem(parts) if any(part.instances for part in parts) else ""
    found = []
    for exporter in exporters_of(build.host, wanted):
        own = [
            FileName(part.name + exporter.suffix, f"part {part.name}")
            for part in parts
            if exporter.takes(part)
        ]
        found += (
            [*own, FileName(whole + exporter.suffix, "the assembly")]
            if whole and exporter.takes_assemblies
            else own
        )
    return found


def collisions(design: Design, parts: "Sequence[Part]", *, solids: bool) -> list[Finding]:
    """Which bodies stand in each other while the mechanism moves; ``solids`` imports the CAD kernel.

    What is pressed or screwed into a hole is meant to.
    """
    from mechwright_cad.interference import interference_findings

    met = [joined(part) for part in parts]
    return interference_findings(design, met, solids=solids)


def plate_collisions(build: Build) -> list[Finding]:
    """Which plates of a build collide; no CAD kernel is needed for it."""
    return collisions(build.design, build.parts, solids=False)


def motion_page(design: Design, parts: "Sequence[Part]", *, solids: bool) -> dict[str, bytes]:
    """The page on which the mechanism moves; ``solids`` imports the CAD kernel for what is no plate."""
    from mechwright_cad.animation import MOTION, PAGE_SAMPLES, motion_html

    motion = design.solve(PAGE_SAMPLES)
    return {MOTION: motion_html(design.name, design.family.title, parts, motion, solids=solids).encode()}


def masses(parts: "Sequence[Part]") -> dict[str, float]:
    """The mass of one of each part by its name, g; imports the CAD kernel."""
    from mechwright_cad.solids.inertia import mass_moments

    return {part.name: float(1000 * mass_moments(part)[3, 3]) for part in parts}


def collisions_and_files(work: Work) -> SolidResults:
    """Whether bodies collide; if none do, the files of a build with its page, and what its parts weigh."""
    met = collisions(work.design, work.parts, solids=True)
    if errors(met):
        return met, {}, {}
    page = motion_page(work.design, work.parts, solids=True) if work.design.family.moves else {}
    return met, work.files() | page, masses(work.parts)


class Solids:
    """The solids of one build, compared and written in this process, or in a second one.

    The second process is begun only if it gains something: if there is other work meanwhile, if a library
    that the exporters need is not imported yet, and if there is a core to do it.
    """

    def __init__(self, build: Build) -> None:
        self._build = build
        self._exporters = exporters_of(build.host, build.wanted)
        self._second: WorkerPool | None = None
        self._answer: Future[SolidResults] | None = None

    def warm(self) -> None:
        """Begin the second process, if it gains something."""
        modules = {module for exporter in self._exporters for module in exporter.modules}
        heavy = sorted(modules - set(sys.modules))
        if heavy and available_cores() > 1 and self._second is None:
            self._second = WorkerPool([available_cores()], heavy, quiet=True)
            self._build.when_closed(self._second.close)

    @property
    def in_second_process(self) -> bool:
        """Whether a second process is at it: other work comes first then."""
        return self._second is not None

    @cached_property
    def _work(self) -> Work:
        build = self._build
        motion, sample = build.pose
        return Work(build.design, self._exporters, motion, sample, build.parts)

    def begin(self) -> None:
        """Give the second process its work: a design whose own check has found no error."""
        if self._second is not None and self._answer is None:
            plates = all(part.build is None for part in self._build.parts)
            work = self._work if plates else replace(self._work, known=None)
            self._answer = self._second.submit(collisions_and_files, work)

    def collisions(self) -> list[Finding]:
        """Which bodies collide, and what else there is to say of that."""
        if self._second is not None:
            return self._result[0]
        return collisions(self._build.design, self._build.parts, solids=True)

    def files(self) -> dict[str, bytes]:
        """Every part, and the assembly, in every format."""
        from mechwright_cad.animation import MOTION

        if self._second is not None:
            return {name: content for name, content in self._result[1].items() if name != MOTION}
        return self._work.files()

    def masses(self) -> dict[str, float]:
        """The mass of one of each part by its name, g."""
        return masses(self._build.parts) if self._second is None else self._result[2]

    def page(self) -> dict[str, bytes]:
        """The page on which the mechanism moves."""
        from mechwright_cad.animation import MOTION

        if self._second is not None:
            return {MOTION: self._result[1][MOTION]}
        build = self._build
        if SOLIDS in build.wanted.extent.makes:
            return motion_page(build.design, build.parts, solids=True)
        try:
            return motion_page(build.design, build.parts, solids=False)
        except MechwrightError as error:  # the mechanism moves all the same
            build.leave_out(f"{MOTION} shows joints and lines, no bodies", error)
            return motion_page(build.design, (), solids=False)

    @cached_property
    def _result(self) -> SolidResults:
        """The answer of the second process; this one does what fails there, and raises its error."""
        assert self._second is not None  # noqa: S101 - all callers have asked
        assert self._answer is not None  # noqa: S101 - begun before
        with self._second:
            try:
                return self._second.result(self._answer)
            except Exception:  # noqa: BLE001,RUF100
                return collisions_and_files(self._work)
