"""What was probably meant by a line that is no TOML."""

import re
from collections.abc import Callable

_LINE = re.compile(r"\(at line (\d+), column \d+\)")
_KEY = re.compile(r"\s*([\w.-]+)\s*=")
_QUOTES = "“”„‟«»‘’‚"
"""Quotation marks of print, which word processors set."""
_MARKS = re.compile(rf"=\s*[{_QUOTES}]([^{_QUOTES}]*)[{_QUOTES}]?\s*(?:#.*)?$")
_COMMENT = re.compile(r"\s*(//|;|%|\(|\*|--|/\*)")
_BEHIND = re.compile(r"\s(//|/\*|--)")
_COLON = re.compile(r"^\s*([\w.-]+)\s*:=?\s*([^=#]*?)\s*(?:#.*)?$")
_END = re.compile(r"^([^#]*?)\s*[;,]\s*(?:#.*)?$")
_BLANK = re.compile(r"^\s*([\w.-]+)\s+([+-]?[\d.]+)\s*(?:#.*)?$")
_COMMA = re.compile(r"=\s*[+-]?\d+(,)\d+\s*(?:#.*)?$")
_WITH_UNIT = re.compile(r'=\s*([+-]?\d+(?:[.,]\d+)?(?:/\d+)?)\s*(["°%A-Za-zµ][\w°/^*²³·]*)\s*(?:#.*)?$')
_FRACTION = re.compile(r"=\s*([+-]?\d+)\s*/\s*(\d+)\s*(?:#.*)?$")
_ZEROS = re.compile(r"=\s*([+-]?)0+(\d[\d.]*)\s*(?:#.*)?$")
_POINT = re.compile(r"=\s*([+-]?)(\d*)\.(\d*)\s*(?:#.*)?$")
_WORD = re.compile(r"=\s*([A-Za-z][\w.-]*(?: [\w.-]+)*)\s*(?:#.*)?$")
_TRUTHS = {"true": "true", "yes": "true", "on": "true", "false": "false", "no": "false", "off": "false"}
_NO_TEXT = {"true", "false", "inf", "nan"}
_LONGEST = 1000
"""Characters of a line that somebody typed: blanks by the thousand are sought through again and again."""
_UNITS = {'"': "in", "°": "deg"}
"""Signs of units as a text in TOML says them."""


def toml_hint(text: str, reason: str) -> str:
    """What to do about a line that is no TOML, as ``reason`` of tomllib names it; empty where nobody knows.

    >>> toml_hint("crank = 12,5", "Expected newline (at line 1, column 11)")
    'line 1 has a decimal comma; write a point: crank = 12.5'
    >>> toml_hint("branch = open", "Invalid value (at line 1, column 10)")
    'line 1 has a text without quotes; write branch = "open"'
    >>> toml_hint("crank = 30 mm", "Expected newline (at line 1, column 12)")
    'line 1 has a unit without quotes; write crank = "30 mm"'
    """
    found = _LINE.search(reason)
    lines = text.splitlines()
    if found is None or not 0 < int(found[1]) <= len(lines):
        return ""
    number = int(found[1])
    line = lines[number - 1]
    if len(line) > _LONGEST:
        return ""
    if "overwrite" in reason and (twice := _twice(lines, number)):
        return twice
    # What else is wrong is told first, and the line written without its end.
    for one in dict.fromkeys((_uncommented(line).rstrip().rstrip(";,").rstrip(), line)):
        for hint in _HINTS:
            if said := hint(one):
                return f"line {number} {said}"
    return ""


def _twice(lines: list[str], number: int) -> str:
    """Where the key of a line stood before, in the same table."""
    key = _KEY.match(lines[number - 1])
    for before in range(number - 1, 0, -1):
        line = lines[before - 1]
        if line.lstrip().startswith("["):
            break
        other = _KEY.match(line)
        if key and other and other[1] == key[1]:
            return f"{key[1]} stands on line {before} already; leave out one of the two"
    return ""


def _start(line: str) -> str:
    """The key of a line and its equals sign."""
    return f"{line.partition('=')[0].strip()} ="


def _uncommented(line: str) -> str:
    """A line without a comment of another language behind its last text."""
    text = line.rfind('"') + 1
    behind = _BEHIND.search(line, text)
    return line[: behind.start()] if behind else line


def _comment(line: str) -> str:
    found = _COMMENT.match(line)
    if found:
        return f"begins with {found[1]}; a comment begins with #"
    end = line[len(_uncommented(line)) :].strip()
    return f"has a comment that begins with {end[:2]}; write # before it" if end else ""


def _marks(line: str) -> str:
    found = _MARKS.search(line)
    return f'has quotes as in print; write {_start(line)} "{found[1]}"' if found else ""


def _colon(line: str) -> str:
    found = _COLON.match(line)
    return f"has a colon; write {found[1]} = {found[2]}" if found else ""


def _end(line: str) -> str:
    found = _END.match(line)
    return f"has a sign at its end that does not belong there; write {found[1].strip()}" if found else ""


def _blank(line: str) -> str:
    found = _BLANK.match(line)
    return f"lacks an equals sign; write {found[1]} = {found[2]}" if found else ""


def _comma(line: str) -> str:
    comma = _COMMA.search(line)
    if comma is None:
        return ""
    meant = f"{line[: comma.start(1)]}.{line[comma.end(1) :]}".split("#")[0].strip()
    return f"has a decimal comma; write a point: {meant}"


def _unit(line: str) -> str:
    found = _WITH_UNIT.search(line)
    if found is None:
        return ""
    unit = _UNITS.get(found[2], found[2])
    return f'has a unit without quotes; write {_start(line)} "{found[1].replace(",", ".")} {unit}"'


def _fraction(line: str) -> str:
    found = _FRACTION.search(line)
    if found is None or not int(found[2]):
        return ""
    return f"has a fraction; write {_start(line)} {int(found[1]) / int(found[2]):.6g}"


def _zeros(line: str) -> str:
    found = _ZEROS.search(line)
    return f"has a zero in front; write {_start(line)} {found[1]}{found[2]}" if found else ""


def _point(line: str) -> str:
    found = _POINT.search(line)
    if found is None or not (found[2] or found[3]) or (found[2] and found[3]):
        return ""
    meant = f"{found[1]}{found[2] or 0}.{found[3] or 0}"
    return f"lacks a digit beside the point; write {_start(line)} {meant}"


def _word(line: str) -> str:
    word = _WORD.search(line)
    if word is None or word[1] in _NO_TEXT:
        return ""
    if truth := _TRUTHS.get(word[1].lower()):
        return f"has a word for true or false; write {_start(line)} {truth}"
    return f'has a text without quotes; write {_start(line)} "{word[1]}"'


def _quote(line: str) -> str:
    odd = line.split("#")[0].count('"') % 2
    return "lacks a quote; a text stands between two of them" if odd else ""


_HINTS: tuple[Callable[[str], str], ...] = (
    _comment,
    _marks,
    _comma,
    _unit,
    _fraction,
    _zeros,
    _point,
    _word,
    _quote,
    _colon,
    _end,
    _blank,
)
"""The likeliest first: each says what is wrong with a line and what to write, or nothing."""
