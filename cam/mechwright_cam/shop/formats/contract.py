"""The contract of a format of tool libraries, and what a file says of one tool."""

import re
from abc import ABC, abstractmethod
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any, ClassVar

from mechwright_cam.shop.tool import Tool

LONGEST = 40
"""Letters of a tool's name."""


class OmittedToolError(Exception):
    """Why a tool cannot be taken over; it never leaves the room of formats."""


@dataclass
class ToolRecord:
    """What a file says of one tool."""

    label: str
    """What the file calls it, for messages and for its name."""
    keys: dict[str, Any] = field(default_factory=dict)
    """Keys of :class:`~mechwright_cam.shop.tool.Tool` but its name, in mm and degrees."""
    taken: list[str] = field(default_factory=list)
    """What the file does not say and is taken as, such as ``"flutes 2"``."""
    dropped: list[str] = field(default_factory=list)
    """What else of it is not taken over, each with the reason."""
    fault: str = ""
    """Why the tool is left out, and what to do; empty for one that is taken over."""

    @property
    def called(self) -> str:
        """Its name, or how that begins, and T number for messages."""
        name, number = repr(self.label[: 2 * LONGEST].strip()), self.keys.get("number")
        return name if number is None else f"{name} (T{number})"

    def take(self, key: str, value: Any) -> None:
        """Set a key that the file does not say, and tell so."""
        self.keys[key] = value
        self.taken.append(f"{key} {value:g}" if isinstance(value, float) else f"{key} {value}")


class Format(ABC):
    """A format in which other programs keep tools."""

    title: ClassVar[str]
    """What it is called, as in ``"a LinuxCNC tool table"``."""
    suffixes: ClassVar[tuple[str, ...]]
    """Ends of the names of its files, such as ``".tbl"``."""
    fields: ClassVar[Mapping[str, str]]
    """Our key to what the format calls it, where it has it."""

    @abstractmethod
    def read(self, path: Path) -> list[ToolRecord]:
        """The tools of a file; raises OutputError or DesignError where it is none of this format."""

    @abstractmethod
    def files(self, tools: Sequence[Tool], path: Path) -> dict[Path, bytes]:
        """The files that hold the tools; the first is ``path``.

        What the format has no place for is left out. Raises DesignError where there is no such file.
        """

    def companion_files(self, path: Path) -> tuple[Path, ...]:  # noqa: ARG002 - for formats of several files
        """Further files that a library consists of."""
        return ()


def slug(label: str) -> str:
    """A name of ours from any text: lower-case letters, digits, ``- _ .``; empty if nothing is left."""
    return re.sub(r"[^a-z0-9_.]+", "-", label.lower()).strip("-_.")[:LONGEST].rstrip("-_.")


def number(value: object) -> float | None:
    """A finite number that a file may hold as one, or as a text; None for anything else."""
    if isinstance(value, bool) or not isinstance(value, (int, float, str)):
        return None
    try:
        found = float(value)
    except (ValueError, OverflowError):
        return None
    return found if abs(found) < 1e9 else None  # also false for what is no number


def tool_number(value: object) -> int:
    """A T number; raises OmittedToolError."""
    found = number(value)
    if found is None or found != int(found) or not 1 <= found <= 9999:
        told = "has no T number" if value is None else f"T number {value!r} is not one of 1 to 9999"
        raise OmittedToolError(f"{told}; give it that of the machine")
    return int(found)
