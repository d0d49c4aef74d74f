"""Characters that a control reads, and lines that it reads whole: looked at before any word.

Outside of comments a program is ASCII: printable characters, blanks and tabs. What else there is (a digit of
another script, a no-break space, a form feed) looks like a word to some readers and is none to a control.
"""

import re
import unicodedata
from collections.abc import Sequence
from string import ascii_letters

from mechwright.errors import ProgramError
from mechwright_cam.controls.dialect import Dialect

NO_LINE_END = "a carriage return (CR) ends no line; save the program with line feeds (LF, or CR and LF)"
"""Said of lines that end as those of old systems did."""

_ODD = re.compile(r"[^\t\n -~]")
_CONTROL = re.compile(r"[\x00-\x08\x0a-\x1f\x7f-\x9f\u2028\u2029]")
_IN_BRACKETS = re.compile(r"\([^()]*\)?")
_COMMENT = re.compile(r"\([^()]*\)?|;.*")
_BLANKS = {ord(" "): None, ord("\t"): None}
_DIGIT = r"[0-9][ \t]*\.?[ \t]*"
_NUMBER = re.compile(r"[A-Za-z]?[-+]?[0-9.]+")


class Faults:
    """The first line of a program that no control would read as it stands.

    ``at`` is its index, that of the line behind the last if there is none.
    """

    def __init__(self, text: str, lines: Sequence[str], dialect: Dialect) -> None:
        self.at, self.reason = len(lines), ""
        self.dialect = dialect
        most = len(text) if dialect.text.counts_code else dialect.text.longest
        long = dialect.text.digits is not None and re.search(
            f"(?:{_DIGIT}){{{dialect.text.digits + 1}}}", text
        )
        if not long and _ODD.search(text) is None and max(map(len, lines), default=0) <= most:
            return
        for index, line in enumerate(lines):
            self.reason = self._fault(line, most)
            if self.reason:
                self.at = index
                return

    def check(self, index: int) -> None:
        """Raise ProgramError if the program has got to the line, or beyond."""
        if index >= self.at:
            raise ProgramError(f"line {self.at + 1}: {self.reason}")

    def _fault(self, line: str, most: int) -> str:
        name = self.dialect.name
        if "\r" in line:
            return NO_LINE_END
        if _ODD.search(line):
            comment = _COMMENT if self.dialect.text.semicolon_comments else _IN_BRACKETS
            if (odd := _ODD.search(comment.sub("", line))) is not None:
                return f"{_spelt(odd[0])} stands outside of comments, and {name} reads ASCII only there"
            odd = (_ODD if self.dialect.text.ascii_comments else _CONTROL).search(line)
            if odd is not None:
                return f"{_spelt(odd[0])} stands in a comment, and {name} does not take it there"
        if len(line) > most:
            return f"{len(line)} characters; {name} reads at most {most}"
        return "" if self.dialect.text.digits is None else self._dropped(line, self.dialect.text.digits)

    def _dropped(self, line: str, most: int) -> str:
        """What is wrong with a number whose digits behind the first ones count, as the control drops them.

        A tenth of the last decimal that the control keeps does not count, unless nothing else is left.
        """
        for word in _NUMBER.findall(_COMMENT.sub("", line).translate(_BLANKS)):
            kept = cut_digits(word, most)
            try:
                said, read = (float(text.lstrip(ascii_letters)) for text in (word, kept))
            except ValueError:  # two points: no number, and told as such
                continue
            if abs(said - read) > 10.0 ** -(self.dialect.decimals + 1) or bool(read) != bool(said):
                return (
                    f"{word} has more than {most} digits, and {self.dialect.name} drops the others: it reads "
                    f"{kept}; write fewer digits, without zeros at the front"
                )
        return ""


def cut_digits(number: str, most: int) -> str:
    """A number, or a word, as it is read where digits behind the first ones count as 0.

    >>> cut_digits("X-0000000012.5", 8), cut_digits("1.123456789", 8)
    ('X-0000000000.0', '1.123456700')
    """
    count, kept = 0, ""
    for character in number:
        count += character.isdigit()
        kept += "0" if character.isdigit() and count > most else character
    return kept


def _spelt(character: str) -> str:
    """A character by number and name.

    >>> _spelt(chr(0xA0)), _spelt(chr(12))
    ('the character U+00A0 (NO-BREAK SPACE)', 'the character U+000C')
    """
    name = unicodedata.name(character, "")
    return f"the character U+{ord(character):04X}" + (f" ({name})" if name else "")
