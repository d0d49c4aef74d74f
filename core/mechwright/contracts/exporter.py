"""Contracts of what writes files: posts and exporters."""

from abc import ABC, abstractmethod
from typing import TYPE_CHECKING, ClassVar

from mechwright.contracts.family import HOOK_API

if TYPE_CHECKING:
    from collections.abc import Sequence

    from mechwright.contracts.motion import Motion
    from mechwright.contracts.part import Part


class Exporter(ABC):
    """Writes parts in one file format. The same parts give the same bytes."""

    api: ClassVar[int] = HOOK_API
    name: ClassVar[str]
    """Name on the command line (``"step"``)."""
    suffix: ClassVar[str]
    """Ending of its files."""
    modules: ClassVar[tuple[str, ...]] = ()
    """Names of modules that it imports when it writes and that take long to import: where they are not
    imported yet, ``build`` may let it write in a second process, beside other work. A copy made by pickle
    has to write the same bytes."""

    @abstractmethod
    def part(self, part: "Part") -> bytes:
        """One part by itself, in its own coordinates."""

    def assembly(
        self,
        name: str,  # noqa: ARG002 - used by formats that hold assemblies
        parts: "Sequence[Part]",  # noqa: ARG002
        motion: "Motion",  # noqa: ARG002
        sample: int = 0,  # noqa: ARG002
    ) -> bytes | None:
        """All instances in their poses at one sample of the motion; None if the format holds single parts."""
        return None
