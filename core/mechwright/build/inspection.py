"""The contract of an inspection: a judgement of a whole build by a room that knows more than the family."""

from abc import abstractmethod
from collections.abc import Sequence
from typing import ClassVar

from mechwright.build.build import Build
from mechwright.contracts.finding import Finding, Stage
from mechwright.contracts.plugin import Plugin


class Inspection(Plugin):
    """Finds what speaks against a build: bodies that meet, cutters that do not reach.

    An inspection is asked when the family itself has found no error; its errors stop the command.
    """

    kind = "inspection"
    plural = "inspections"
    commands: ClassVar[frozenset[str]]
    """Names of the commands that ask it."""
    stage: ClassVar[Stage]
    """What its findings are about: in a command that ends before, they are told and stop nothing."""
    order: ClassVar[int] = 100
    """Inspections of lower order are told first."""
    doing: ClassVar[str] = ""
    """What it is at, for a progress bar."""
    share: ClassVar[float] = 1.0
    """How long that takes beside others, such as a page of text, which takes 1."""

    def late(self, build: Build) -> bool:  # noqa: ARG002 - for those whose work goes on beside
        """Whether it works beside other work and is best asked last; it is told in its order all the same."""
        return False

    @abstractmethod
    def findings(self, build: Build) -> Sequence[Finding]:
        """What it finds."""
