"""Where the structures of a program begin and end: what its O-words say before any of them is run.

Nothing of that changes while a program runs, so each question is answered once, however often a loop asks it.

Glossary
--------
O-word
    A line such as ``O100 while [#1 lt 5]``; the label ties the lines of one structure together.
"""

import re
from bisect import bisect_left

from mechwright_cam.controls.reading.values import COMMENT

BEGIN = frozenset({"sub", "if", "repeat", "while", "do"})
"""Words with which something begins that has a label."""
BARE = frozenset({"sub", "else", "endif", "do", "endwhile", "endrepeat", "break", "continue"})
"""Words that nothing stands behind."""
_O_WORD = re.compile(
    r"(?:n[0-9]+)?o([0-9]+|<[^<>]+>)"
    r"(sub|endsub|return|call|do|while|endwhile|if|elseif|else|endif|repeat|endrepeat|break|continue|$)(.*)"
)
_WORKED_OUT = re.compile(r"(?:n[0-9]+)?o((?:#|\[).*)call(.*)")
"""A call whose label is a value."""
NO_ENDS = frozenset({"call", "return", "break", "continue", "m98", "m99"})
"""Words with which nothing begins or ends."""
ENDSUB, ENDIF, ENDREPEAT, ENDWHILE = (frozenset({f"end{it}"}) for it in ("sub", "if", "repeat", "while"))
BRANCHES = frozenset({"elseif", "else", "endif"})
_STARTS = frozenset("oOmMnN(;%")
"""With what a line of an O-word, of M98 or of the program's end begins."""
_M98 = re.compile(r"(?:n[0-9]+)?m0*9([89])(?![0-9.])(.*)")


def _o_word(line: str) -> tuple[str, str, str] | str:
    """Label, word and the rest of an O-word, M98 or M99; what another line says, without blanks."""
    code = "".join((COMMENT.sub("", line) if "(" in line or ";" in line else line).split()).lower()
    if match := _O_WORD.fullmatch(code):
        return str(int(match[1])) if match[1].isdigit() else match[1], match[2], match[3]
    if match := _WORKED_OUT.fullmatch(code):
        return match[1], "call", match[2]
    if match := _M98.fullmatch(code):
        return "", f"m9{match[1]}", match[2]
    return code


class OWords:
    """The O-words of a program's lines; all methods raise ValueError for what LinuxCNC refuses.

    Attributes
    ----------
    words
        Label, word, and what stands behind it, by index of the line; M98 and M99 are words without a label.

    Examples
    --------
    >>> found = OWords(["o1 repeat [3]", "G1 X1", "o1 endrepeat"])
    >>> found.words[0], found.find(0, frozenset({"endrepeat"})), found.find_back(2, "repeat")
    (('1', 'repeat', '[3]'), 2, 0)
    """

    def __init__(self, lines: list[str]) -> None:
        self.words: dict[int, tuple[str, str, str]] = {}
        self._places: dict[str, list[int]] = {}
        """Lines of each label where something begins or ends, in order."""
        self._twin: dict[int, int] = {}
        """Of each line where something begins the first that begins the same: a subroutine of its label, or
        anything else of its label in its subroutine, or in the main program."""
        self._first: dict[tuple[str, str, bool], int] = {}
        self._subs: list[int] = []
        self._checked: set[int] = set()
        self._found: dict[tuple[int, frozenset[str]], int] = {}
        self._behind: dict[tuple[int, frozenset[str]], int | None] = {}
        percents, inside = 0, ""
        told: dict[str, tuple[str, str, str] | str] = {}  # a call may stand there a hundred thousand times
        for index, line in enumerate(lines):
            if line.lstrip()[:1] not in _STARTS:
                continue
            if line not in told:
                told[line] = _o_word(line)
            said = told[line]
            if isinstance(said, str):
                percents += said == "%"
                if percents == 2:
                    break
                continue
            self.words[index] = said
            label, word, _ = said
            if word in NO_ENDS:
                continue
            self._places.setdefault(label, []).append(index)
            if word == "sub":
                self._subs.append(index)
                inside = label
            if word in BEGIN:
                place = (label, "sub" if word == "sub" else inside, word == "sub")
                self._twin[index] = self._first.setdefault(place, index)
            inside = "" if word == "endsub" else inside
        self._starts: dict[tuple[str, str], int] = {}
        """The first line of each label with a word by which it may be called."""
        for label, places in self._places.items():
            for word in ("sub", ""):
                first = next((place for place in places if self.words[place][1] == word), None)
                if first is not None:
                    self._starts[label, word] = first

    def check(self, index: int) -> None:
        """Refuse what LinuxCNC does: words behind an O-word, a second use of a label, an end of nothing."""
        if index in self._checked:
            return
        label, word, rest = self.words[index]
        if rest and word in BARE:
            raise ValueError(f"{rest[:12]!r} stands behind O{label} {word}")
        if word in BEGIN and not (word == "while" and self.ends_do(index)):
            twin = self._twin[index]
            if twin != index:
                raise ValueError(f"O{label} begins something in line {twin + 1} already; use another number")
        if word == "endif" and self._before(index, frozenset({"if"})) is None:
            raise ValueError(f"O{label} has no if")
        if word == "sub":
            end = self.find(index, ENDSUB)
            if bisect_left(self._subs, end) > bisect_left(self._subs, index) + 1:
                raise ValueError(f"a subroutine is defined inside of O{label}; define one after the other")
        self._checked.add(index)

    def ends_do(self, index: int) -> bool:
        """Whether a while is the end of do ... while."""
        before = self._before(index, frozenset({"do", "while"}))
        return before is not None and self.words[before][1] == "do"

    def start(self, label: str, word: str) -> int:
        """The first line of the subroutine of a label, which has the word."""
        if (label, word) not in self._starts:
            raise ValueError(f"there is no subroutine {label} in this file; no other is read")
        return self._starts[label, word]

    def end_of_loop(self, index: int) -> int:
        """The line that closes the loop, which is no repeat, of a break or continue."""
        label, word, _ = self.words[index]
        begun = self._before(index, BEGIN)
        if begun is None or self.words[begun][1] not in {"while", "do"}:
            raise ValueError(f"O{label} {word} stands in no while or do of this number")
        return self.find(index, frozenset({"endwhile", "while"}))

    def find(self, index: int, wanted: frozenset[str]) -> int:
        """The next line of the same label that has one of the words."""
        known = self._found.get((index, wanted))
        if known is None:
            known = self._found[index, wanted] = self._find(index, wanted)
        return known

    def _find(self, index: int, wanted: frozenset[str]) -> int:
        label = self.words[index][0]
        places = self._places.get(label, [])
        for at in range(bisect_left(places, index + 1), len(places)):
            word = self.words[places[at]][1]
            if word in wanted:
                return places[at]
            if word in {"if", "repeat", "do"} and wanted != ENDSUB:
                raise ValueError(
                    f"O{label} begins something in line {places[at] + 1} as well; use another number"
                )
        raise ValueError(f"O{label} has no {' or '.join(sorted(wanted))}")

    def find_back(self, index: int, wanted: str) -> int:
        """The last line of the same label before, that has the word."""
        place = self._before(index, frozenset({wanted}))
        if place is None:
            raise ValueError(f"O{self.words[index][0]} has no {wanted}")
        return place

    def _before(self, index: int, wanted: frozenset[str]) -> int | None:
        """The last line before another, of the same label, that has one of the words."""
        if (index, wanted) not in self._behind:
            places = self._places.get(self.words[index][0], [])
            before = (places[at] for at in range(bisect_left(places, index) - 1, -1, -1))
            self._behind[index, wanted] = next((k for k in before if self.words[k][1] in wanted), None)
        return self._behind[index, wanted]
