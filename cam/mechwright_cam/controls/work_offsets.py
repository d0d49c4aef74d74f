"""Work offsets: which there are, and how they are set."""

import re
from dataclasses import dataclass


@dataclass(frozen=True)
class WorkOffsets:
    """A row of work offsets."""

    name: str
    """The name that people see."""
    pattern: str
    """How its offsets are spelt, with the number as a group."""
    words: str
    """The words that set one, with ``{}`` for its place in the row."""
    before: int = 0
    """The number before that of the first in the row."""

    def has(self, offset: str) -> bool:
        """Whether the row has an offset.

        >>> G54_TO_G59.has("G59"), G54_TO_G59.has("G59.1")
        (True, False)
        """
        return re.fullmatch(self.pattern, offset) is not None

    def setting(self, offset: str) -> str:
        """The words that set one of its offsets, without the axes.

        >>> G54_TO_G59.setting("G55"), FANUC_OFFSETS.setting("G54.1 P7")
        ('G10 L2 P2', 'G10 L20 P7')
        """
        match = re.fullmatch(self.pattern, offset)
        assert match is not None  # noqa: S101 - the caller has looked it up
        return self.words.format(int(match[1]) - self.before)


G54_TO_G59 = WorkOffsets("G54 to G59", r"G(5[4-9])", "G10 L2 P{}", 53)
LINUXCNC_OFFSETS = WorkOffsets("G59.1 to G59.3", r"G59\.([1-3])", "G10 L2 P{}", -6)
FANUC_OFFSETS = WorkOffsets("G54.1 P1 to P48", r"G54\.1 P([1-9]|[123]\d|4[0-8])", "G10 L20 P{}")
HAAS_OFFSETS = WorkOffsets("G154 P1 to P99", r"G154 P([1-9]\d?)", "G10 L20 P{}")
