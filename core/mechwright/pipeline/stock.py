"""The contract of who knows what plates are sawn off for the parts of a build."""

from abc import abstractmethod
from collections.abc import Sequence
from dataclasses import dataclass
from typing import ClassVar

from mechwright.contracts.plugin import Plugin
from mechwright.pipeline.build import Build


@dataclass(frozen=True)
class Blank:
    """A piece of raw stock: what it is for, how many, of what, and how large, mm."""

    parts: tuple[str, ...]
    count: int
    material: str
    size: tuple[float, float, float]


class RawStock(Plugin):
    """Says what plates a process takes; the bill of materials lists them.

    For a plate that no process has spoken for, the bill adds its own allowance to the finished size.
    """

    kind = "raw stock"
    plural = "raw stocks"
    commands: ClassVar[frozenset[str]]
    """Names of the commands in which it knows."""

    @abstractmethod
    def blanks(self, build: Build) -> Sequence[Blank]:
        """One for each plate, in the order in which they are cut."""
