"""The lines of a program in the order of running, and whether a program is more than its lines."""

import re
from collections.abc import Iterator

_USES = re.compile(
    r"^(?:[^(;\n]|\([^)\n]*\))*?[#\[]|^\s*(?:n\d+\s*)?/?o\s*[\d<\[]", re.IGNORECASE | re.MULTILINE
)


def uses_macros(text: str) -> bool:
    """Whether a program has anything that is not plain words.

    >>> uses_macros("G0 X1 (#5)"), uses_macros("G0 X#5"), uses_macros("O100 sub")
    (False, True, True)
    """
    return _USES.search(text) is not None


class Lines:
    """The lines of a program, one after the other; whoever has run some more of them moves ``at`` on."""

    def __init__(self, lines: list[str]) -> None:
        self.lines = lines
        self.at = 0

    def run(self) -> Iterator[tuple[int, str]]:
        """Index and text of each line that the machine has to obey, in the order of running."""
        while self.at < len(self.lines):
            self.at += 1
            yield self.at - 1, self.lines[self.at - 1]
