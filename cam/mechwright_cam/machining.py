"""Machining: the jobs of a build, their programs, and the proof of each."""

from collections.abc import Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from html import escape
from itertools import chain, pairwise

import shapely

from mechwright.contracts.finding import Finding, Stage, at_stage, errors
from mechwright.contracts.part import Part
from mechwright.designs.design import Design
from mechwright.errors import DesignError, PluginError, ProofError, ToolError
from mechwright.pipeline import Build
from mechwright.pipeline.process import MILL, plates_by
from mechwright.pipeline.result_store import result_store
from mechwright.plugins.host import Host
from mechwright.worker_pool.sharing import shared
from mechwright_cam.controls.contract import Control
from mechwright_cam.exactness import posted
from mechwright_cam.operations.contract import Operation
from mechwright_cam.planning import plan
from mechwright_cam.planning.assign import Assignments
from mechwright_cam.planning.prepare import prepare
from mechwright_cam.planning.setups import carried
from mechwright_cam.program.moves import Program
from mechwright_cam.proof.carried import cut_away
from mechwright_cam.proof.judge import RULES, judge
from mechwright_cam.proof.measuring import prove_lengths
from mechwright_cam.proof.probing import prove_probe
from mechwright_cam.proof.report import Proof
from mechwright_cam.proof.rules import Rule
from mechwright_cam.proof.scene import Scene
from mechwright_cam.setup.job import Job
from mechwright_cam.setup.probing import touches_of, unprobed
from mechwright_cam.setup.setter import measures_tools, tool_touches, unmeasured
from mechwright_cam.shop.library import Library
from mechwright_cam.shop.settings import CamSettings
from mechwright_cam.shop.table import settings_of
from mechwright_cam.slowed import slowed
from mechwright_plane.nest import Nest

SLOWED = 3
"""Rounds in which feeds are lowered to what spindle and mills can do: the first does nearly all."""

PER_POINT, PER_CUT = 2e-4, 6e-4
"""Seconds that a program with its proof takes for each point of the part's outlines, and for each mm that the
smallest tool of a task would go to clear its region: most of 26 parts took half to twice as long."""


@dataclass(frozen=True)
class Machined:
    """A part with its program and the proof of it."""

    job: Job
    program: Program
    files: dict[str, str]
    proof: Proof
    scene: Scene
    """What the proof has looked at, as far as it is worked out."""

    def __repr__(self) -> str:
        return f"<Program {self.name}: {', '.join(self.files)}; {self.proof!r}>"

    def _repr_html_(self) -> str:
        return f"<details><summary>{escape(repr(self))}</summary><pre>{escape(self.text)}</pre></details>"

    @property
    def name(self) -> str:
        """That of the part, and of its side where both are machined."""
        return self.program.name

    @property
    def text(self) -> str:
        """The program's text, all its files one after the other."""
        return "".join(self.files.values())


@dataclass(frozen=True)
class Setups:
    """The jobs of one part, and what its programs are made with.

    Parameters
    ----------
    first
        Place of its first program among those of the design.
    jobs
        The part from its top, and then from its underside, if something is cut there.
    """

    first: int
    jobs: tuple[Job, ...]
    control: Control
    assignments: Assignments
    rules: tuple[Rule, ...]

    def __reduce__(self) -> tuple[object, ...]:
        """Another process gets what is decided about these jobs alone."""
        decided = self.assignments.only(self.jobs)
        return Setups, (self.first, self.jobs, self.control, decided, self.rules)

    @property
    def seconds(self) -> float:
        """How long it takes to make the programs and to prove them, about."""
        points = sum(int(shapely.get_num_coordinates(job.target)) for job in self.jobs)
        tasks = chain.from_iterable(self.assignments.of(job).tasks for job in self.jobs)
        cuts = sum(one.region.area / min(tool.diameter for tool in one.tools) for one in tasks if one.tools)
        return PER_POINT * points + PER_CUT * float(cuts)

    def known(self) -> list[object]:
        """What the programs refer to."""
        return [
            self.control,
            *(one for job in self.jobs for one in (job, job.part, job.settings, *job.tools)),
        ]

    def proven_programs(self) -> list[Machined]:
        """The proven programs; raises as :func:`machine` does."""
        made: list[Machined] = []
        for place, job in enumerate(self.jobs, self.first):
            laid = job
            if job.side == "underside":  # what the first side leaves changes how it is cut, and not by whom
                laid = self.assignments.carry(job, second_setup(made[-1], job))
            made.append(machine(laid, self.control, place, self.assignments, self.rules))
        return made


class Machining:
    """What is made of a build for the mill, each thing once."""

    def __init__(self, build: Build) -> None:
        self._build = build

    @cached_property
    def settings(self) -> CamSettings:
        """What holds for the whole job."""
        return settings_of(self._build.design).cam

    @cached_property
    def control(self) -> Control:
        """The control that reads the programs; raises PluginError if it is not installed."""
        return control_of(self._build.design, self._build.host)

    @property
    def rules(self) -> list[Rule]:
        """What every program is judged by: what is built in, and what anybody has installed."""
        return self._build.host.all(Rule)

    @cached_property
    def plates(self) -> list[Part]:
        """The parts that are milled from a plate."""
        return plates_by(self._build.design, self._build.parts, MILL)

    @cached_property
    def _prepared(self) -> tuple[list[Finding], list[Job]]:
        return prepare(self._build.design, self.plates, self.assignments)

    @cached_property
    def assignments(self) -> Assignments:
        """Who cuts what, with the operations that others have registered at hand."""
        return Assignments(self._build.host.all(Operation), self.control)

    @property
    def jobs(self) -> list[Job]:
        """One for each plate or nest, and one more where the underside is milled as well."""
        return self._prepared[1]

    @cached_property
    def nests(self) -> list[Nest]:
        """The plates of several parts."""
        return [job.part for job in self.jobs if isinstance(job.part, Nest)]

    @cached_property
    def findings(self) -> list[Finding]:
        """What control and cutters cannot do, for both sides, and what they leave."""
        control = self.control  # one that is not installed is told before any work
        every = [self.settings, *(job.settings for job in self.jobs)]
        found = [finding for settings in every for finding in control.check(settings)]
        for job in self.jobs:
            found += control.check_tools(job.settings, job.tools)
            if job.settings.more_offsets and not control.several:
                lack = f"{control.title} has no programs for several work offsets here"
                remedy = "leave more_offsets out"
                found.append(Finding.error("cam.more-offsets", "cam.more_offsets", lack, remedy=remedy))
            if why := self._unmeasured(job):
                remedy = "leave the table [cam.setter] out"
                found.append(Finding.error("cam.setter", "cam.setter", why, remedy=remedy))
            if why := self._unprobed(job):
                remedy = "leave tool of [cam.probe] out"
                found.append(Finding.error("cam.probing", "cam.probe.tool", why, remedy=remedy))
        return [*at_stage(Stage.MACHINING, dict.fromkeys(found)), *self._prepared[0]]

    @cached_property
    def proven_programs(self) -> list[Machined]:
        """The proven programs, in the order of the jobs; none where a finding forbids them.

        Raises
        ------
        ToolError
            A cutter that the work needs is not there.
        ProofError
            A program would not cut the right part.
        """
        if errors(self.findings):
            return []
        if {"control", "wear"} <= {job.settings.compensation for job in self.jobs}:
            raise DesignError(
                f'{self._build.path}: cam.compensation: "control" and "wear" in one job would ask D for two '
                "things at once; use one of them"
            )
        parts = self._setups()
        found = shared(
            Setups.proven_programs,
            parts,
            [one.seconds for one in parts],
            Setups.known,
            self._build.progress,
            result_store(),
        )
        made = list(chain.from_iterable(found))
        for job, item in zip(self.jobs, made, strict=True):
            if job.side == "underside" and item.job is not job:
                self.assignments.carry(job, item.job)
        return made

    def _setups(self) -> list[Setups]:
        """The jobs by part: the first side, and what is done from the other."""
        starts = [place for place, job in enumerate(self.jobs) if job.side != "underside"]
        return [
            Setups(first, tuple(self.jobs[first:end]), self.control, self.assignments, tuple(self.rules))
            for first, end in pairwise([*starts, len(self.jobs)])
        ]

    def _unprobed(self, job: Job) -> str:
        """Why the zero of a first side is not probed as it is asked for."""
        if job.settings.probe.tool is None or job.side != "top":
            return ""
        why = self.control.cannot_probe(job.tools) or unprobed(job)
        return f"part {job.part.name}: {why}" if why else ""

    def _unmeasured(self, job: Job) -> str:
        """Why the tools of a first side are not measured as it is asked for."""
        if not measures_tools(job):
            return ""
        why = self.control.cannot_measure(job.tools) or unmeasured(job)
        if not why and job.settings.more_offsets and not self.control.offsets.lengths:
            why = f"{self.control.title} sets the Z of one work offset by a touch, and there are more_offsets"
        return f"part {job.part.name}: {why}" if why else ""

    @cached_property
    def measuring(self) -> dict[str, dict[str, str]]:
        """Name of a part's program to stem and text of those that measure its tools, in order; proven.

        Raises ProofError where one of them does what it may not.
        """
        found = {}
        for item in self.proven_programs:
            if measures_tools(item.job):
                touches = tool_touches(item.job, item.program)
                texts = self.control.measure(touches, item.job.settings.machine)
                numbers = tuple(tool for tool, _ in touches.tools)
                prove_lengths(texts, item.job, self.control, numbers)
                found[item.program.name] = texts
        return found

    @cached_property
    def probing(self) -> dict[str, tuple[str, str]]:
        """Name of a part's program to stem and text of the one that probes its zero; proven.

        Raises ProofError where it does what it may not.
        """
        found = {}
        for item in self.proven_programs:
            job = item.job
            if job.settings.probe.tool is not None and job.side == "top":
                touches = touches_of(job)
                text = self.control.probe(touches, job.settings.machine)
                prove_probe(touches.name, text, job, self.control)
                found[item.program.name] = touches.name, text
        return found

    @cached_property
    def table(self) -> tuple[str, str]:
        """Name and text of the control's table of the tools of all programs; two empty texts without one."""
        tools = {tool.number: tool for item in self.proven_programs for tool in item.program.tools}
        listed = [tools[number] for number in sorted(tools)]
        compensated = (
            item.job.settings for item in self.proven_programs if item.job.settings.compensation != "computer"
        )
        settings = next(compensated, None)
        return self.control.offset_table(listed, settings) if settings else self.control.tool_table(listed)


def control_of(design: Design, host: Host) -> Control:
    """The control that a design names; raises PluginError if it is not installed."""
    try:
        cam = settings_of(design).cam
        return host.get(Control, cam.control).speaking(cam.post.units or "mm")
    except PluginError as error:
        raise PluginError(f"{design.path}: cam.control: {error}") from error


def second_setup(first: Machined, job: Job) -> Job:
    """The second setup of a part, with what the first one has left of the plate."""
    return replace(job, gone=carried(cut_away(first.scene), first.job, job))


def machine(
    job: Job,
    control: Control,
    place: int = 0,
    assignments: Assignments | None = None,
    rules: Sequence[Rule] = RULES,
) -> Machined:
    """Plan a program, post it, slow what the spindle has no power for, and prove the posted text.

    Who cuts what is taken from ``assignments``, if it has been decided. Programs of one design that have
    numbers are told apart by their ``place``.

    Raises
    ------
    ToolError
        A cutter that the work needs is not there.
    ProofError
        The program would not cut the right part.
    """
    if job.settings.outsides == "faster":
        return _faster(job, control, place, assignments, rules)
    cam = job.settings
    tools = Library(job.tools).measured(cam.measured.lengths).tools
    if tools != job.tools:
        job = replace(job, tools=tools)
    stated = {
        "program_number": cam.post.program_number + place,
        "tool_change": cam.post.tool_change or control.by_hand,
    }
    posting = cam.post.model_copy(update=stated)
    program = replace(plan(job, assignments), machine=cam.machine, posting=posting, measured=cam.measured)
    program, files, scene = posted(program, job, control)
    for _ in range(SLOWED):
        gentler = slowed(program, scene)
        if gentler is None:
            break
        program, files, scene = posted(gentler, job, control, scene)
    proof = judge(scene, rules)
    proof.require()
    return Machined(job, program, files, proof, scene)


def _faster(
    job: Job, control: Control, place: int, assignments: Assignments | None, rules: Sequence[Rule]
) -> Machined:
    """The program with the channels of outsides cut in the way that takes less time, as both are simulated.

    Bounded engagement is tried first; where it cannot be, or its program is no better, the full width stands.
    """
    made: list[Machined] = []
    for way in ("contour", "adaptive"):
        settings = job.settings.model_copy(update={"outsides": way})
        tried = replace(job, settings=settings)
        try:
            made.append(machine(tried, control, place, assignments, rules))
        except (ToolError, ProofError, DesignError):
            if not made:
                raise
    return min(made, key=lambda one: one.proof.time_estimate_s)
