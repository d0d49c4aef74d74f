"""One run of a build: its inspections up to a stage, the cheap ones first, then the files of its pages."""

import re
from collections.abc import Callable, Iterable, Mapping, Sequence
from pathlib import Path
from typing import TYPE_CHECKING

from mechwright.contracts.finding import Finding, Findings, Stage, errors
from mechwright.contracts.refused import RefusedError
from mechwright.errors import DesignError, GeometryError, KinematicsError, MechwrightError, ToolError
from mechwright.output.folder import Content, Output
from mechwright.pipeline.build import Build
from mechwright.pipeline.inspection import Inspection
from mechwright.pipeline.page import Page
from mechwright.pipeline.steps import CHECKING, Steps, shares
from mechwright.pipeline.work import Work

if TYPE_CHECKING:
    from mechwright.contracts.synthesis import Progress

REFUSED = "build.refused"
"""Code of the finding that something cannot be made: no cutter, no solid, a program that is not proven."""

_REFUSALS = (DesignError, GeometryError, KinematicsError, ToolError)
"""Errors that are a design's, and no fault of a plugin, of a file or of ours."""

_KEY = re.compile(r"[a-z_]+(\.[\w-]+)+")


class Run:
    """What is found of a build, and what is made of it.

    Every command that judges a design goes through here. Inspections that need nothing come first, and all of
    them are asked; what takes long is made where they find no error.

    Parameters
    ----------
    build
        The build; its wishes say whose pages are made.
    work
        How far the run goes, and what it makes.
    progress
        Told how far it is.
    """

    def __init__(self, build: Build, work: Work, progress: "Progress | None" = None) -> None:
        self.build, self.work = build, work
        asked = (one for one in build.host.all(Inspection) if _is_asked(one, work))
        self.inspections = sorted(asked, key=lambda one: one.order)
        self.part_errors: list[Finding] = []
        """That the parts cannot be made."""
        self.raised: MechwrightError | None = None
        """The first error that is told as a finding."""
        self._pages: list[Page] = []
        self._progress = progress or (lambda done, what: None)  # noqa: ARG005
        self._found: dict[str, Sequence[Finding]] = {}
        self._steps: Steps | None = None

    @property
    def made_later(self) -> list[Inspection]:
        """Inspections that have to wait for what the run makes."""
        return [one for one in self.inspections if one.needs and one.needs <= self.work.makes]

    @property
    def found(self) -> list[tuple[Inspection, Sequence[Finding]]]:
        """What each inspection that was asked has found, in the order in which it is told."""
        return [(one, self._found[one.name]) for one in self.inspections if one.name in self._found]

    @property
    def findings(self) -> Findings:
        """All of it: what the family says, that parts cannot be made, and what inspections find."""
        inspected = (one for _, found in self.found for one in found)
        return Findings([*self.build.findings, *self.part_errors, *inspected])

    def is_stopped(self) -> bool:
        """Whether something that is found forbids the run."""
        return bool(errors(self.findings, self.work.stage))

    def look(self, *, every: bool = True) -> None:
        """Ask what can be said before anything is made; nothing where the family finds an error.

        Without ``every`` only up to the first inspection that finds an error.
        """
        self.step(CHECKING)
        if self.is_stopped() or not self._has_parts():
            return
        later = self.made_later
        for one in self.inspections:
            if one not in later and (every or not self.is_stopped()):
                self._ask(one)
        if self.is_stopped() and every:
            for one in later:
                self._ask(one, made=False)

    def _has_parts(self) -> bool:
        """Whether the parts can be made, where the run comes to them."""
        if self.part_errors or Stage.PARTS.is_after(self.work.stage):
            return not self.part_errors
        try:
            _ = self.build.parts
        except _REFUSALS as error:
            self.raised = error
            self.part_errors.append(refused(error, self.build.path, Stage.PARTS))
        return not self.part_errors

    def make(self, pages: Sequence[Page] = ()) -> Output:
        """Look, ask what needs something that is made, and make the files of some pages.

        Raises
        ------
        RefusedError
            Findings forbid it.
        MechwrightError
            Something cannot be made.
        """
        self._pages, build = list(pages), self.build
        for page in pages:
            page.warm(build)
        if not self.is_stopped() and self._has_parts():
            for page in pages:
                page.begin(build)
        self.look()
        self.require()
        asked = self.made_later
        late = [one for one in asked if one.late(build)]
        made = Output()
        try:
            for one in asked:
                if one not in late:
                    self._ask(one)
                    self.require()
            self._make((page for page in pages if not page.late(build)), made)
        except MechwrightError:
            for one in late:  # what is asked late is told first all the same
                self._ask(one)
            self.require()
            raise
        for one in late:
            self._ask(one)
        self.require()
        self._make((page for page in pages if page.late(build)), made)
        return made

    def require(self) -> None:
        """Do nothing where nothing that is found forbids the run; raises RefusedError with what does."""
        if stopping := errors(self.findings, self.work.stage):
            raise RefusedError(self.build.path, stopping)

    def ask(self, one: Inspection, build: Build) -> Sequence[Finding]:
        """What an inspection finds of a build such as this one, as this run asks it."""
        return self._question(one)(build)

    def _question(self, one: Inspection) -> Callable[[Build], Sequence[Finding]]:
        return one.findings if one.needs <= self.work.makes else one.outlook

    def _ask(self, one: Inspection, *, made: bool = True) -> None:
        self.step(one.doing)
        ask = self._question(one) if made else one.outlook
        try:
            self._found[one.name] = self.build.made_as_wanted(ask)
        except _REFUSALS as error:
            self.raised = self.raised or error
            said = refused(error, self.build.path, one.stage)
            known = {(each.code, each.message) for each in self.findings}  # what two ask for is told once
            self._found[one.name] = [] if (said.code, said.message) in known else [said]

    def _make(self, pages: Iterable[Page], made: Output) -> None:
        known = self.build.made_as_wanted(_kept)
        for page in pages:
            self.step(page.doing)
            files = known[page.name] if page.name in known else page.files(self.build)
            if all(isinstance(content, str | bytes) for content in files.values()):  # pieces come once
                known[page.name] = files
            for name, content in files.items():
                made.add(name, content)

    def step(self, doing: str) -> None:
        """Tell that another piece of work begins."""
        if self._steps is None:
            self._steps = Steps(self.build, shares([*self.inspections, *self._pages]), self._progress)
        self._steps(doing)


def refused(error: MechwrightError, path: Path, stage: Stage) -> Finding:
    """The finding that something cannot be made: an error in its own words.

    >>> refused(GeometryError("d.toml: cam.mark: no free place; leave it out"), Path("d.toml"), Stage.PARTS)
    <Finding error [build.refused] cam.mark: no free place; leave it out>
    """
    words = str(error).removeprefix(f"{path}: ")
    key, _, rest = words.partition(": ")
    if not rest or not _KEY.fullmatch(key):
        key, rest = "", words
    message, _, remedy = rest.rpartition("; ")
    return Finding.error(REFUSED, key, message or remedy, remedy=remedy if message else "", stage=stage)


def _is_asked(one: Inspection, work: Work) -> bool:
    """Whether an inspection is about what a run comes to."""
    return not one.stage.is_after(work.stage) and (not work.process or one.process in {"", work.process})


def _kept(build: Build) -> dict[str, Mapping[str, Content]]:  # noqa: ARG001 - one for the wishes of each build
    """The files of pages by the names of these, as far as they have been made."""
    return {}
