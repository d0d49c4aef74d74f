"""What may stand beside plain words in a line: a comment at its end, and words of state.

Many programs state in every line what is so anyway, or tell at the end of each what it does. Both are taken
out before plain lines are read, and kept: comments as remarks, words of state for the machine to compare.

Glossary
--------
words of state
    G17, G20, G21, G40, G54 to G59, G90, G91, G94 and M3 to M9, of which a line may have several.
"""

import re

import numpy as np

from mechwright.errors import ProgramError
from mechwright_cam.controls.dialect import Dialect
from mechwright_cam.controls.reading.blocks import Block, read_block
from mechwright_cam.controls.reading.run import Ints

_STATE = r"(?:G(?:17|2[01]|40|5[4-9]|9[014])|M0?[345789])(?![ \t]*[0-9.])"
_EITHER = re.compile(r"[(;Mm]|[Gg][1-9][0-9]")
"""What lines of either kind have, and few others."""
_ONE_COMMENT = re.compile(r"([^();]*)\(([^()]*)\)[ \t]*")
_TO_THE_END = re.compile(r"([^();]*);(.*)")
_LATE_NUMBER = re.compile(r"[^\sNn].*[Nn]")


class CommentsAndStates:
    r"""Comments and words of state of a program's lines, and the text without them.

    Lines in which they are anything but plain to the control stay as they are.

    Attributes
    ----------
    text
        The program without them; every line keeps its number.
    comments
        The comments by index of their line.
    kind
        (n,) which words of state each line has, as an index into ``states``; 0 for none.
    states
        What the words of state of a line say, each once.

    Examples
    --------
    >>> dialect = Dialect()
    >>> found = CommentsAndStates(["G1 X1 (to the edge)", "G1 G90 X2 M3", "X3"], dialect)
    >>> found.text.split("\n"), found.comments, found.kind.tolist()
    (['G1 X1 ', 'G1   X2  ', 'X3'], {0: 'to the edge'}, [0, 1, 0])
    >>> found.states[1].g, found.states[1].m
    ([900], [3])
    """

    def __init__(self, lines: list[str], dialect: Dialect) -> None:
        self.dialect = dialect
        self.comments: dict[int, str] = {}
        self.kind: Ints = np.zeros(len(lines), dtype=np.int64)
        self.states = [Block(0)]
        self._known: dict[tuple[str, ...], int] = {}
        self._words = re.compile(_STATE, 0 if dialect.text.capitals else re.IGNORECASE)
        self.text = "\n".join(lines)
        found = [match.start() for match in _EITHER.finditer(self.text)]
        if not found:
            return
        ends = np.cumsum([len(line) + 1 for line in lines])
        kept = list(lines)
        for index in np.unique(np.searchsorted(ends, found, side="right")).tolist():
            if len(lines[index]) <= dialect.text.longest:
                kept[index] = self._without(index, lines[index])
        self.text = "\n".join(kept)

    def _without(self, index: int, line: str) -> str:
        """The line without what stands beside its plain words, which is kept; or as it is."""
        code, comment = line, None
        if "(" in line or ";" in line:
            parts = _ONE_COMMENT.fullmatch(line)
            if parts is None and self.dialect.text.semicolon_comments:
                parts = _TO_THE_END.fullmatch(line)
            if parts is None or any(character in line for character in self.dialect.text.forbidden):
                return line
            code, comment = parts[1], parts[2].strip()
            if comment.lower().startswith(self.dialect.text.active_comments):
                return line
        words = tuple(self._words.findall(code))
        if words:
            kind = self._kind(words)
            bare = self._words.sub(" ", code)
            if not kind or _LATE_NUMBER.search(code):
                return line
            code, self.kind[index] = bare, kind
        if comment is not None:
            self.comments[index] = comment
        return code

    def _kind(self, words: tuple[str, ...]) -> int:
        """The index of these words of state, 0 if they exclude each other."""
        if words not in self._known:
            self._known[words] = 0
            try:
                block = read_block(0, " ".join(words), self.dialect)
            except ProgramError:
                return 0
            self._known[words] = len(self.states)
            self.states.append(block)
        return self._known[words]
