"""How far a run of several pieces of work is."""

from collections.abc import Iterable, Mapping
from typing import TYPE_CHECKING

from mechwright.pipeline.build import Build
from mechwright.pipeline.inspection import Inspection
from mechwright.pipeline.page import Page

if TYPE_CHECKING:
    from mechwright.contracts.synthesis import Progress

CHECKING, WRITING = "checking", "writing"
CHECK = 20.0
"""How long the family's own check takes beside a page of text, as the README's example has it."""


def shares(work: Iterable[Page | Inspection]) -> dict[str, float]:
    """The pieces of work of a run, by what they say they are at, and how long each takes beside others."""
    found = {CHECKING: CHECK}
    for one in work:
        found[one.doing] = max(found.get(one.doing, 0.0), one.share)
    return {**found, WRITING: 1.0}


class Steps:
    """Tells how far a run is, each time another piece of work begins and as the build says how far that is.

    Parameters
    ----------
    build
        Its :attr:`Build.progress` is set.
    work
        What the pieces of work are at, to how long each takes beside the others.
    progress
        Who is told.
    """

    def __init__(self, build: Build, work: Mapping[str, float], progress: "Progress") -> None:
        self._work, self._progress = work, progress
        self._whole = sum(work.values())
        self._begun: set[str] = set()
        self._now, self._told = "", 0.0
        build.progress = self._within

    def __call__(self, doing: str) -> None:
        """Another piece of work begins."""
        if doing != self._now:
            self._begun.add(self._now)
            self._now = doing
        self._within(0.0)

    def _within(self, part: float) -> None:
        before = sum(self._work.get(one, 0.0) for one in self._begun - {self._now})
        done = (before + part * self._work.get(self._now, 0.0)) / self._whole
        self._told = max(self._told, done)  # a piece of work may go on after another
        self._progress(self._told, self._now)
