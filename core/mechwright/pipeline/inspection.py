"""The contract of an inspection: a judgement of a whole build by a room that knows more than the family."""

from abc import abstractmethod
from collections.abc import Sequence
from typing import ClassVar

from mechwright.contracts.finding import Finding, Stage
from mechwright.contracts.plugin import Plugin
from mechwright.pipeline.build import Build


class Inspection(Plugin):
    """Finds what speaks against a build: bodies that meet, cutters that do not reach.

    An inspection is asked by every run that comes to its stage, ``check`` among them, when the family itself
    has found no error; its errors stop the run.
    """

    kind = "inspection"
    plural = "inspections"
    limited = True
    stage: ClassVar[Stage]
    """What its findings are about."""
    needs: ClassVar[frozenset[str]] = frozenset()
    """What has to be made for it and takes long: :data:`~mechwright.pipeline.work.SOLIDS`, ``PROGRAMS``."""
    process: ClassVar[str] = ""
    """Name of the process that it is about, such as ``"mill"``: commands of other processes do not ask it."""
    order: ClassVar[int] = 100
    """Inspections of lower order are told first."""
    doing: ClassVar[str] = ""
    """What it is at, for a progress bar."""
    share: ClassVar[float] = 1.0
    """How long that takes beside others, such as a page of text, which takes 1."""

    @classmethod
    def fault(cls) -> str:
        """Whether it says when it is asked in the way of an earlier version."""
        if hasattr(cls, "commands"):
            return "it says commands; its stage says which runs ask it, leave commands out"
        return super().fault()

    def late(self, build: Build) -> bool:  # noqa: ARG002 - for those whose work goes on beside
        """Whether it works beside other work and is best asked last; it is told in its order all the same."""
        return False

    def outlook(self, build: Build) -> Sequence[Finding]:  # noqa: ARG002 - for those who know something
        """What can be said before what it needs is made; by default nothing."""
        return ()

    @abstractmethod
    def findings(self, build: Build) -> Sequence[Finding]:
        """What it finds."""
