"""The contract of who knows what raw stock the parts of a build take: plates, filament, supplies."""

from abc import abstractmethod
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import ClassVar

from mechwright.contracts.plugin import Plugin
from mechwright.pipeline.build import Build
from mechwright.standards.supply import Supply


@dataclass(frozen=True)
class Blank:
    """A piece of raw stock: what it is for, how many, of what, and how large, mm."""

    parts: tuple[str, ...]
    count: int
    material: str
    size: tuple[float, float, float]


@dataclass(frozen=True)
class Feedstock:
    """Material from which parts are built up, such as filament.

    Parameters
    ----------
    material
        As it is sold: ``"PLA"``.
    masses
        Name of a part to what one piece takes, g.
    order
        How it is ordered, without its mass.
    note
        How it is laid down.
    """

    material: str
    masses: Mapping[str, float]
    order: str
    note: str = ""


class RawStock(Plugin):
    """Says what raw stock a process takes; the bill of materials lists it.

    For a plate that no process has spoken for, the bill adds its own allowance to the finished size.
    """

    kind = "raw stock"
    plural = "raw stocks"
    commands: ClassVar[frozenset[str]]
    """Names of the commands in which it knows."""

    @abstractmethod
    def blanks(self, build: Build) -> Sequence[Blank]:
        """One for each plate, in the order in which they are cut."""

    def feedstock(self, build: Build) -> Sequence[Feedstock]:  # noqa: ARG002 - for processes that build up
        """One for each material from which parts are built up; by default none."""
        return ()

    def supplies(self, build: Build, items: Mapping[str, int]) -> Sequence[Supply]:  # noqa: ARG002
        """What the process takes besides; by default nothing.

        Parameters
        ----------
        build
            Whose parts are made.
        items
            Name of a part to the number of its item, for notes.
        """
        return ()
