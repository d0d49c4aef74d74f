"""The contract of a page: files that are made of a build."""

from abc import abstractmethod
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Annotated, ClassVar, Protocol, TypeVar

from mechwright.contracts.file_names import hold_files
from mechwright.contracts.finding import Finding, errors
from mechwright.contracts.guard import pieces
from mechwright.contracts.plugin import Plugin
from mechwright.output.folder import Content
from mechwright.pipeline.build import Build, Wanted

if TYPE_CHECKING:
    from mechwright.plugins.host import Host


@dataclass(frozen=True)
class FileName:
    """The name of a file before the file is made.

    Parameters
    ----------
    name
        Of the file.
    of
        What it is of, in a few words, such as ``"part wheel"``.
    key, text
        The key of the design file that names it, and what that says; empty where no key does.
    """

    name: str
    of: str
    key: str = ""
    text: str = ""


def _hold_files(files: Mapping[str, Content], *_: object) -> Mapping[str, Content]:
    """The same files; pieces are asked for under the guard."""
    hold_files(files)
    return {
        name: content if isinstance(content, (str, bytes)) else pieces(content, f"{name!r}")
        for name, content in files.items()
    }


PageFiles = Annotated[Mapping[str, Content], _hold_files]
"""Files by their names."""


class Page(Plugin):
    r"""Files of one kind, such as a table of the motion or the setup sheets.

    The same build gives the same bytes. Example of a whole page::

        class Masses(Page):
            name = "masses"
            commands = frozenset({"model", "build"})

            def files(self, build):
                lines = [f"{part.name},{part.thickness}" for part in build.parts]
                return {"masses.csv": "\\n".join(lines) + "\\n"}
    """

    kind = "page"
    plural = "pages"
    commands: ClassVar[frozenset[str]]
    """Names of the commands that write it."""
    doing: ClassVar[str] = ""
    """What is made, for a progress bar; pages of the same words are one step of it."""
    share: ClassVar[float] = 1.0
    """How long that step takes beside others, such as a page of text, which takes 1."""

    def warm(self, build: Build) -> None:
        """Start what takes long before the design is even read; by default nothing."""

    def begin(self, build: Build) -> None:
        """Start work that can go on beside other work, as the design is found sound; by default nothing."""

    def late(self, build: Build) -> bool:  # noqa: ARG002 - for those whose work goes on beside
        """Whether its files are best asked for last, because work for them goes on beside other work."""
        return False

    def names(self, build: Build, wanted: Wanted) -> Sequence[FileName]:  # noqa: ARG002 - for those who know them
        """The files that it may write where ``wanted`` is asked for, named before any work; by default none.

        A check compares the names of all pages. Where there are some, :meth:`files` writes no others.
        """
        return ()

    @abstractmethod
    def files(self, build: Build) -> PageFiles:
        """File name to content; a long one may come in pieces of bytes, which are asked for as it is written.

        Raises
        ------
        MechwrightError
            It cannot be made; nothing of the whole run is written then.
        """


class Judged(Protocol):
    """What programs and drawings are written of, with what speaks against it."""

    @property
    def findings(self) -> Sequence[Finding]:
        """What speaks against it."""


J = TypeVar("J", bound=Judged)


def unless_forbidden(judged: J) -> J | None:
    """The same; None where a finding of it forbids its files, so that pages neither name nor write any."""
    return None if errors(judged.findings) else judged


def pages_of(host: "Host", command: str) -> list[Page]:
    """The pages that a command writes."""
    return [page for page in host.all(Page) if command in page.commands]
