"""The words of Klartext blocks: which are read, as what, and what is said of the others."""

import math
import re

from mechwright.errors import ProgramError
from mechwright_cam.controls.reading.blocks import fail
from mechwright_cam.controls.reading.characters import NO_LINE_END
from mechwright_cam.controls.words.groups import STOPPING
from mechwright_cam.controls.words.klartext import LONGEST, MOST_M, WORDS
from mechwright_cam.controls.words.table import Code, Use

NAME = "HEIDENHAIN"
AT_THE_END = frozenset({0, 1, 2, 5, 9, 30})
"""M functions that act when the move of their block is done."""
MACHINE_PLACE = "M91"
NUMBER = r"[+-]?(?:\d+(?:[.,]\d*)?|[.,]\d+)"
"""A number, with a point or a comma."""
FULL_TURN = 360.0
SMALLEST_TURN = 1e-4
"""The last decimal of an angle, degrees."""
_WORD = re.compile(rf"([A-Z]+)(?:({NUMBER})|(?<=DR)([+-]))?(?= |$)")
_NAMED = re.compile(r"[A-Z]*")


def check_length(number: int, text: str) -> None:
    """Raise ProgramError for a line that is longer than a block."""
    if "\r" in text:
        raise fail(number, NO_LINE_END)
    if len(text) > LONGEST:
        raise fail(number, f"{len(text)} characters; {NAME} reads {LONGEST} in a block")


def plain(value: str) -> str:
    """A number as the interpreter reads it."""
    return value.replace(",", ".").removeprefix("+")


def worked_out(value: float) -> str:
    """A number that was worked out."""
    return f"{value:.9f}".rstrip("0").rstrip(".")


def turns_of(angle: float) -> tuple[int, float]:
    """The arcs of a helix, and the angle by which its end is turned from its start, degrees.

    >>> turns_of(2880.0), turns_of(-90.0), turns_of(720.5)
    ((8, 0.0), (1, -90.0), (3, 0.5))
    """
    whole, part = divmod(abs(angle), FULL_TURN)
    if FULL_TURN - part < SMALLEST_TURN / 2:
        whole, part = whole + 1, 0.0
    if whole and part < SMALLEST_TURN / 2:
        return int(whole), 0.0
    return int(whole) + 1, math.copysign(part, angle)


def words_of(number: int, code: str, row: Code) -> dict[str, str]:
    """Name and value of each word behind the first: R0 as G40, DR as G2 or G3, M functions together.

    ``row`` is that of the block, whose words are read and no others.
    """
    words: dict[str, str] = {}
    takes = row.takes
    first, *pieces = code.replace("F MAX", "FMAX").split()
    if not (first.isalpha() or first == "-"):
        raise refused(number, first)
    for piece in pieces:
        match = _WORD.fullmatch(piece)
        if match is None:
            raise refused(number, piece)
        name, value = match[1], plain(match[2] or "")
        if name == "M" and "M" in takes and value.isdigit():
            words["M"] = f"{words.get('M', '')} M{int(value)}".strip()
            continue
        if name == "FMAX" and not value:
            name, value = "F", "MAX"
        elif name == "R" and "RADIUS" in takes and float(value or "0"):
            name = "RADIUS"
        elif (name, value) == ("R", "0"):
            value = "G40"
        elif name == "DR" and match[3]:
            value = "G3" if match[3] == "+" else "G2"
        elif not value or name in {"R", "DR", "RADIUS"}:
            raise refused(number, piece)
        if name not in takes:
            raise _not_there(number, piece, name, row)
        if name in words:
            raise fail(number, f"two {name} words in a block; take one out")
        words[name] = value
    return words


_ADDRESSES = frozenset(name for row in WORDS.codes for name in row.takes)


def _not_there(number: int, piece: str, name: str, row: Code) -> ProgramError:
    """The error of a word that another block takes, or none."""
    other = WORDS.known.get(name)
    if name not in _ADDRESSES or (other is not None and other.use is Use.REFUSED):
        return refused(number, piece)
    if row.word == "M":
        return fail(number, f"{piece} beside M functions; write L before them")
    return fail(number, f"{piece} means nothing in a block {row.word}; take it out")


def functions_of(number: int, code: str, *, moving: bool) -> str:
    """M functions as the interpreter has them; M91 stays for who moves."""
    found = code.split()
    if len(found) > MOST_M:
        raise fail(number, f"more than {MOST_M} M functions in a block")
    said = []
    for word in found:
        row = WORDS.known.get(word)
        if row is None or row.use is Use.REFUSED or (row.word == MACHINE_PLACE and not moving):
            raise refused(number, word)
        if row.word == MACHINE_PLACE:
            said.append(word)
            continue
        if moving and row.number in AT_THE_END - STOPPING:
            raise fail(number, f"{word} beside a move acts at its end; write it in a block behind it")
        said.append(row.becomes or word)
    return " ".join(said)


def refused(number: int, word: str) -> ProgramError:
    """The error of a word that is not read, with what to do instead."""
    if (worked := re.match(r"([A-Z]+)[+-]?Q[LRS]?\d", word)) is not None:
        return fail(number, f"{word} is a Q parameter; write {worked[1]} with a plain number")
    found = _NAMED.match(word)
    row = WORDS.known.get(word) or WORDS.known.get(found[0] if found else word)
    what = row.remedy if row is not None and row.remedy else "post the program without it"
    return fail(number, f"{word} is no word that is read in programs for {NAME}; {what}")


_DWELL = re.compile(rf"(?:DWELL|V\.ZEIT) ?({NUMBER})")
_TOLERANCE = re.compile(rf"(?:T ?({NUMBER}))?")


def dwell_of(number: int, rest: str) -> str:
    """The second block of cycle 9 as the interpreter has it."""
    match = _DWELL.fullmatch(rest)
    if match is None:
        raise fail(number, "CYCL DEF 9.1 needs DWELL and its seconds")
    return f"G4 P{plain(match[1])}"


def tolerance_of(number: int, rest: str) -> str:
    """The second block of cycle 32 as the interpreter has it."""
    match = _TOLERANCE.fullmatch(rest)
    if match is None:
        raise fail(number, "CYCL DEF 32.1 is read with T alone, how far the control may leave the path")
    if match[1] is None:
        return "G64"
    if not float(plain(match[1])) > 0:
        raise fail(number, "T of CYCL DEF 32.1 has to be above 0; without T the machine's setting holds")
    return f"G64 P{plain(match[1])} Q0"
