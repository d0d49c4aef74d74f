"""What the core knows of programs: they are texts, and each is proven. Who makes them knows more."""

from collections.abc import Mapping, Sequence
from typing import Any, Protocol


class Judgement(Protocol):
    """What the proof of a program says."""

    @property
    def ok(self) -> bool:
        """Whether the program cuts the right part."""

    @property
    def failures(self) -> Sequence[Any]:
        """The checks that it does not pass."""

    def as_dict(self) -> dict[str, Any]:
        """Plain data, as ``proof.json`` has it."""


class Proven(Protocol):
    """A program and its proof."""

    @property
    def name(self) -> str:
        """That of its part, and of its side where both are machined."""

    @property
    def files(self) -> Mapping[str, str]:
        """Stem of the file to its text, in the order in which they are run."""

    @property
    def text(self) -> str:
        """All files one after the other."""

    @property
    def proof(self) -> Judgement:
        """What the proof says."""
