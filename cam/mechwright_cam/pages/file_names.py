"""The names of what is written of the jobs of a build, before programs are planned."""

from collections.abc import Iterator
from typing import TYPE_CHECKING

from mechwright.pipeline import Build, FileName
from mechwright.pipeline.page import unless_forbidden
from mechwright_cam.planning.nesting import NEST_NAME
from mechwright_cam.setup.probing import PROBE
from mechwright_cam.setup.setter import LENGTHS, measures_tools
from mechwright_plane.nest import Nest

if TYPE_CHECKING:
    from mechwright_cam.machining import Machining
    from mechwright_cam.setup.job import Job


def machined(build: Build) -> "Machining | None":
    """The jobs of a build, with their control; None where a finding forbids its programs."""
    from mechwright_cam.machining import Machining

    return unless_forbidden(build.made(Machining))


def named(machining: "Machining", job: "Job", stem: str, end: str, what: str = "") -> FileName:
    """A file of a job: what it is of, and the key that names it where that is a nest."""
    nest = isinstance(job.part, Nest)
    of = f"{what}{'nest' if nest else 'part'} {job.part.name}"
    if not nest or machining.settings.nest is None:
        return FileName(stem + end, of)
    return FileName(stem + end, of, NEST_NAME, machining.settings.nest.name)


def program_names(machining: "Machining") -> Iterator[FileName]:
    """The files of all programs, and the control's tool table."""
    control, suffix = machining.control, machining.control.suffix
    for job in machining.jobs:
        probes = job.settings.probe.tool is not None and job.side == "top"
        for end, what, there in (
            ("", "the program of ", True),
            (PROBE, "the program that probes the zero of ", probes),
            (LENGTHS, "the program that measures the tools of ", measures_tools(job)),
        ):
            for stem in control.stems(job.part.name + end, job.tools) if there else ():
                yield named(machining, job, stem, suffix, what)
    table, _ = control.tool_table([tool for job in machining.jobs for tool in job.tools])
    if table:
        yield FileName(table, "the tool table")


def drawing_names(machining: "Machining", suffix: str) -> Iterator[FileName]:
    """The drawings of all plates and nests."""
    for part in machining.plates if machining.jobs else ():
        yield FileName(part.name + suffix, f"the drawing of part {part.name}")
    for job in machining.jobs:
        if isinstance(job.part, Nest):
            yield named(machining, job, job.part.name, suffix, "the drawing of ")
