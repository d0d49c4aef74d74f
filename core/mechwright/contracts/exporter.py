"""The contract of an exporter: what writes parts in one file format."""

from abc import abstractmethod
from collections.abc import Mapping
from typing import TYPE_CHECKING, Any, ClassVar, Self

from mechwright.contracts.plugin import Plugin

if TYPE_CHECKING:
    from collections.abc import Sequence

    from mechwright.contracts.motion import Motion
    from mechwright.contracts.part import Part


class Exporter(Plugin):
    """Writes parts, or the mechanism of them, in one file format. The same parts give the same bytes."""

    kind = "exporter"
    plural = "formats"
    piecewise = frozenset({"part", "assembly"})

    suffix: ClassVar[str]
    """Ending of its files."""
    samples: ClassVar[int] = 2
    """Samples of the motion that :meth:`assembly` needs at least: more than its ends where the file moves."""
    modules: ClassVar[tuple[str, ...]] = ()
    """Names of modules that it imports when it writes and that take long to import: where they are not
    imported yet, ``build`` may let it write in a second process, beside other work. A copy made by pickle
    has to write the same bytes."""

    def takes(self, part: "Part") -> bool:  # noqa: ARG002 - used by formats that leave parts out
        """Whether :meth:`part` gives a file of a part; known before any work."""
        return True

    @property
    def takes_assemblies(self) -> bool:
        """Whether :meth:`assembly` gives a file; by default where a class has one of its own."""
        return type(self).assembly is not Exporter.assembly

    def configured(self, tables: Mapping[str, Any]) -> Self:  # noqa: ARG002 - used by formats with settings
        """The exporter with what a design's tables say of its format; itself, the default, without settings.

        Raises DesignError for settings that do not go together.
        """
        return self

    @abstractmethod
    def part(self, part: "Part") -> bytes | None:
        """One part by itself, in its own coordinates; None if the format holds whole mechanisms alone."""

    def assembly(
        self,
        name: str,  # noqa: ARG002 - used by formats that hold assemblies
        parts: "Sequence[Part]",  # noqa: ARG002
        motion: "Motion",  # noqa: ARG002
        sample: int = 0,  # noqa: ARG002
    ) -> bytes | None:
        """All instances in their poses at one sample of the motion; None if the format holds single parts."""
        return None
