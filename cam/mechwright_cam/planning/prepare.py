"""From a design to jobs: its plates, nested where that is wanted, with cutters, stock and holding."""

from collections.abc import Iterator, Sequence
from dataclasses import replace
from functools import cached_property
from pathlib import Path

import shapely

from mechwright.contracts.finding import Finding, Severity, Stage, at_stage, errors
from mechwright.contracts.part import Part
from mechwright.designs.design import Design
from mechwright.errors import DesignError, ToolError
from mechwright.shell import file_word
from mechwright.tolerances import TOLERANCES
from mechwright_cam.plane.offsets import polygons
from mechwright_cam.planning.assign import Assignments
from mechwright_cam.planning.holding_force import holding_findings
from mechwright_cam.planning.in_hand import from_hand
from mechwright_cam.planning.nest_note import nest_notes
from mechwright_cam.planning.nesting import NestNameError, arranged
from mechwright_cam.planning.remarks import merged_tool_findings
from mechwright_cam.planning.setups import lay_out_setups
from mechwright_cam.planning.to_buy import to_buy
from mechwright_cam.planning.uses import uses
from mechwright_cam.setup.job import Job
from mechwright_cam.setup.limits import check_machine
from mechwright_cam.setup.measured import check_measured
from mechwright_cam.setup.nest import Nest
from mechwright_cam.shop.estimates import completed, rigidity_of
from mechwright_cam.shop.library import Library, load_library
from mechwright_cam.shop.settings import CamSettings
from mechwright_cam.shop.shop_table import shop_of
from mechwright_cam.shop.table import settings_of

FINER = (1.0, 0.5)
"""Finest mills for corners, mm, that are tried where the design says none and with the usual one the parts as
cut do not go together, one after the other."""


def library_of(design: Design, materials: Sequence[str] = ()) -> Library:
    """The cutters at hand, with estimates for these materials where they have no data.

    The name of one that is none of them is a mistake in the file.
    """
    settings = settings_of(design)
    shop = shop_of(design)
    library = load_library(settings.tool_library, None if shop is None else shop.library)
    tables = {"cam": settings.cam, **{f"cam.part.{name}": cam for name, cam in settings.parts.items()}}
    for where, cam in tables.items():
        named = {"tools": cam.tools, "cutting": cam.cutting, "measured.lengths": cam.measured.lengths}
        for key, name in ((key, name) for key, names in named.items() for name in names):
            try:
                library.get(name)
            except ToolError as error:
                raise ToolError(f"{design.path}: {where}.{key}: {error}") from error
    estimated = completed(library.tools, materials, settings.cam.machine)
    return replace(library, tools=estimated).cutting(settings.cam.cutting)


class Preparation:
    """The plates of a design on their way to jobs: nested where wanted, with cutters, stock and holding.

    Parameters
    ----------
    design
        The design.
    parts
        Its parts; those that are no plates are passed over.
    assignments
        Who cuts what.
    """

    def __init__(self, design: Design, parts: Sequence[Part], assignments: Assignments) -> None:
        self.design, self.assignments = design, assignments
        self.settings, self.shop, self.plates = settings_of(design), shop_of(design), list(parts)
        self.library = library_of(design, sorted({part.material for part in self.plates}))

    @cached_property
    def cut(self) -> list[Part]:
        """The plates as they are cut.

        Raises DesignError where a nest is not possible, or ``[cam.part.NAME]`` names no plate and no nest.
        """
        path = self.design.path
        cut = arranged(path, self.settings, self.plates, self.library, self.assignments, self.shop)
        known = sorted({part.name for part in (*self.plates, *cut)})
        for name in self.settings.parts:
            if name not in known:
                raise DesignError(
                    f"{path}: cam.part.{name}: no plate part has this name; "
                    f"there is: {', '.join(known) or 'none'}"
                )
        return cut

    def laid(self) -> tuple[list[Finding], list[Job]]:
        """What is found, and the jobs; finer mills than the usual ones are tried for the sake of corners."""
        findings, jobs = self._laid(None)
        for finest in FINER:
            left = _left_in_corners(findings)
            if left and any(finest < self._finest(part) for part in self.cut):
                found, laid = self._laid(finest)
                if len(_left_in_corners(found)) < len(left):
                    said = f"{left[0].message}; {_chosen(jobs, laid)}"
                    found.append(Finding("cam.corner-mill", Severity.NOTE, "cam.corner_mill", said))
                    findings, jobs = found, laid
        if all(FINER[-1] < self._finest(part) for part in self.cut):
            findings = [_without_mills(one) for one in findings]  # they have been tried
        return findings, jobs

    def _laid(self, finest: float | None) -> tuple[list[Finding], list[Job]]:
        """The jobs of plates, and all that is found of them, with ``finest`` as the finest mill for corners.

        None leaves it to the design, and so does a part for which the design says one.
        """
        findings: list[Finding] = [*_incomplete(self.library, self.design.path)]
        jobs: list[Job] = []
        for part in self.cut:
            cam = self.settings.of(part.name)
            if finest is not None and finest < self._finest(part):
                cam = cam.model_copy(update={"corner_mill": finest})
            found, laid = self._of_part(part, cam)
            findings += dict.fromkeys(found)  # two features may have the same to say
            if not errors(found):
                jobs += laid
        findings += [*check_measured(jobs), *dict.fromkeys(worn(jobs))]
        tops = [job for job in jobs if job.side == "top"]
        if len(tops) == len(self.cut):
            findings = merged_tool_findings(findings, _used(jobs, self.assignments))
            findings += self._as_cut(tops)
            findings += [*self._unused_data(jobs), *_estimated(jobs, self.assignments)]
            findings += nest_notes(self.settings, jobs)
        return findings, jobs

    def _of_part(self, part: Part, cam: CamSettings) -> tuple[list[Finding], list[Job]]:
        """The jobs of one plate out of what is in hand, and what is found of it."""
        own = self.library.cutting(cam.cutting).measured(cam.measured.lengths)
        laid, found = lay_out_setups(part, cam, own, self.assignments)
        if self.shop is not None and laid and not errors(found):
            blank, more = from_hand(laid[0], self.shop, self.design)
            if blank is not None:
                cam = cam.model_copy(update={"stock": blank})
                laid, found = lay_out_setups(part, cam, own, self.assignments)
            found += more
        found += [finding for job in laid for finding in (*check_machine(job), *holding_findings(job))]
        if self.shop is not None and errors(found):
            buy = to_buy(part, cam, own, self.assignments, self.shop)
            found += [] if buy is None else [buy]
        return found, laid

    def _finest(self, part: Part) -> float:
        """The finest mill that may be chosen for corners of a part, mm; 0 where the design says it."""
        cam = self.settings.of(part.name)
        return 0.0 if cam.tools or "corner_mill" in cam.model_fields_set else cam.corner_mill

    def _as_cut(self, tops: Sequence[Job]) -> list[Finding]:
        """What the family says of the parts as the cutters leave them.

        The copies of a part in a nest may be left different by their neighbours: the family sees all.
        """
        family, params = self.design.family, self.design.params
        copies: dict[str, list[shapely.Polygon]] = {}
        for job in tops:
            for name, outline in parts_as_cut(job, self.assignments):
                copies.setdefault(name, []).append(outline)
        findings: list[Finding] = []
        for number in range(max(map(len, copies.values()), default=0)):
            cut = {name: found[min(number, len(found) - 1)] for name, found in copies.items()}
            findings += [f for f in family.check_cut(params, cut) if f not in findings]
        return findings

    def _unused_data(self, jobs: Sequence[Job]) -> Iterator[Finding]:
        """Cutting data in the design for tools that no job has."""
        settings = self.settings
        named = dict.fromkeys(
            name for cam in (settings.cam, *settings.parts.values()) for name in cam.cutting
        )
        used = {tool.name for job in jobs for tool in job.tools}
        for name in named:
            if name not in used:
                message = f"{name} is not used here, so its cutting data change nothing"
                yield Finding("cam.cutting-unused", Severity.NOTE, f"cam.cutting.{name}", message)


def prepare(
    design: Design, parts: Sequence[Part], assignments: Assignments | None = None
) -> tuple[list[Finding], list[Job]]:
    """Choose cutters and lay the plates among the parts into their stock.

    Gives what the cutters cannot do, with what the family says of the parts as they leave them, and a job for
    each part, with one more where the underside is milled as well; fewer if a finding is an error.
    """
    preparation = Preparation(design, parts, assignments or Assignments())
    try:
        findings, jobs = preparation.laid()
    except NestNameError as error:
        findings, jobs = [error.finding], []
    return at_stage(Stage.MACHINING, findings), jobs


def _left_in_corners(findings: Sequence[Finding]) -> list[Finding]:
    """The errors that a finer mill may cure."""
    return [one for one in errors(findings) if any("cam.corner_mill" in change for change in one.proposed)]


def _without_mills(finding: Finding) -> Finding:
    """A finding without the proposals of finer mills."""
    return replace(
        finding, proposed=tuple(change for change in finding.proposed if "cam.corner_mill" not in change)
    )


def _chosen(before: Sequence[Job], after: Sequence[Job]) -> str:
    """Which mills were chosen for the sake of corners."""
    known = {mill.name for job in before for mill in job.mills}
    new = {mill.name: mill.diameter for job in after for mill in job.mills if mill.name not in known}
    names = sorted(new, key=lambda name: -new[name])
    return f"so {' and '.join(names)} {'is' if len(names) == 1 else 'are'} taken for their corners"


def worn(jobs: Sequence[Job]) -> Iterator[Finding]:
    """What the wear of finishing mills is to a job: within D's limits, or with no place at all."""
    for job in jobs:
        cam = job.settings
        for tool in job.end_mills:
            off = abs(tool.wear_diameter) / 2
            if cam.compensation == "computer" and off > TOLERANCES.leftover:
                message = (
                    f"{tool.name} is worn by {off:g} mm as a radius, and paths are those of a new one: no "
                    "program is proven in which it comes to walls"
                )
                remedy = 'use cam.compensation = "wear", and D allows for it, or put in a new cutter'
                yield Finding.warning(
                    "cam.wear", "cam.compensation", message, off, TOLERANCES.leftover, "mm", remedy
                )
            elif cam.compensation != "computer" and off > cam.wear_limit:
                message = f"the wear of {tool.name} is beyond what D may differ by, as a radius"
                remedy = "raise wear_limit, or put in a new cutter"
                where = "cam.wear_limit"
                yield Finding.error("cam.wear", where, message, off, cam.wear_limit, "mm", remedy)


def _used(jobs: Sequence[Job], assignments: Assignments) -> set[str]:
    """Names of the tools that do something in some job."""
    return {use.tool.name for job in jobs for use in uses(job, assignments.of(job))}


def _estimated(jobs: Sequence[Job], assignments: Assignments) -> Iterator[Finding]:
    """Tools that cut with data which nobody has given."""
    found: dict[str, dict[str, None]] = {}
    for job in jobs:
        for use in uses(job, assignments.of(job)):
            if use.tool.is_estimated(job.part.material):
                found.setdefault(job.part.material, {})[use.tool.name] = None
    for name, tools in found.items():
        machine = jobs[0].settings.machine
        message = (
            f"speeds and depths of {', '.join(tools)} in {name} are estimates for a machine of class "
            f"{rigidity_of(machine)}: watch the first cut"
        )
        remedy = "give what works in [cam.cutting.NAME], or in the tool's table of the shop file"
        yield Finding("cam.estimated", Severity.NOTE, "cam.cutting", message, remedy=remedy)


def _incomplete(library: Library, path: Path) -> Iterator[Finding]:
    """That a library of another program is not taken over as it is."""
    if library.told:
        message = (
            f"of the library not all is taken over as it stands ({len(library.told)} remarks); "
            f"mechwright tools {file_word(path)} lists them"
        )
        yield Finding("cam.tool-library", Severity.NOTE, "cam.tool_library", message)


def cut_outlines(job: Job, assignments: Assignments | None = None) -> tuple[shapely.Polygon, ...]:
    """The target as the chosen cutters leave it: corners that none of them reaches stay filled.

    There is one for the part, or one for each part of a nest, work coordinates. Each wall is judged with the
    cutter that finishes it, as its task says.
    """
    tasks = (assignments or Assignments()).of(job).every()
    edges = [(task, task.operation.edge(task, job)) for task in tasks]
    walls = [edge for task, edge in edges if task.is_outside and edge is not None]
    holes = [edge for task, edge in edges if not task.is_outside and edge is not None]
    opened, cut = shapely.union_all(holes), []
    for plate in polygons(job.target):
        own = [wall for wall in walls if shapely.intersects(wall, plate)]
        outside = own[0] if own else shapely.Polygon(plate.exterior)
        left = polygons(outside.difference(opened) if holes else outside)
        cut.append(max(left, key=lambda part: float(part.area)))
    return tuple(cut)


def parts_as_cut(job: Job, assignments: Assignments | None = None) -> list[tuple[str, shapely.Polygon]]:
    """Name of each part of a job, and what the cutters leave of it, in its own coordinates."""
    outlines = cut_outlines(job, assignments)
    cut = [shapely.transform(outline, lambda points: points + job.origin) for outline in outlines]
    if isinstance(job.part, Nest):
        return [(one.part.name, one.back(left)) for one, left in zip(job.part.placed, cut, strict=True)]
    return [(job.part.name, cut[0])]
