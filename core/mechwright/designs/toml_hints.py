"""What was probably meant by a line that is no TOML."""

import re

_LINE = re.compile(r"\(at line (\d+), column \d+\)")
_COMMA = re.compile(r"=\s*[+-]?\d+(,)\d+\s*(?:#.*)?$")
_WORD = re.compile(r"=\s*([A-Za-z][\w.-]*(?: [\w.-]+)*)\s*(?:#.*)?$")
_NO_TEXT = {"true", "false", "inf", "nan"}


def toml_hint(text: str, reason: str) -> str:
    """What to do about a line that is no TOML, as ``reason`` of tomllib names it; empty where nobody knows.

    >>> toml_hint("crank = 12,5", "Expected newline (at line 1, column 11)")
    'line 1 has a decimal comma; write a point: crank = 12.5'
    >>> toml_hint("branch = open", "Invalid value (at line 1, column 10)")
    'line 1 has a text without quotes; write branch = "open"'
    """
    found = _LINE.search(reason)
    lines = text.splitlines()
    if found is None or not 0 < int(found[1]) <= len(lines):
        return ""
    number = int(found[1])
    line = lines[number - 1]
    if comma := _COMMA.search(line):
        meant = f"{line[: comma.start(1)]}.{line[comma.end(1) :]}".split("#")[0].strip()
        return f"line {number} has a decimal comma; write a point: {meant}"
    word = _WORD.search(line)
    if word and word[1] not in _NO_TEXT:
        return f'line {number} has a text without quotes; write {line[: word.start(1)].strip()} "{word[1]}"'
    if line.split("#")[0].count('"') % 2:
        return f"line {number} lacks a quote; a text stands between two of them"
    return ""
