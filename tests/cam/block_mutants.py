"""Every single fault that the words of a block allow, for every kind of block of a program.

A kind of block is its G and M codes and the letters of its other words, such as ``G1 X Z F``. Each is removed,
doubled, swapped with the one behind it, and each of its words gets another digit, another letter and another
sign; and each word of state is put in at each kind of place. Which line of a kind is taken, and which digit it
gets, is drawn.
"""

import re
from collections.abc import Iterator

from line_faults import STATES
from mutants import Mutant
from program_faults import WORD, Rng, code, pick

LETTERS = "DFGHIJKLMNPQRSTXYZ"
PLACES = {
    "before the first motion": r"\bG0?[01]\b",
    "before a tool": r"\bT\d",
    "in a cut": r"\bG?[123]?.*[XY][-\d].*",
    "before a retract": r"\bG(53|28)\b",
    "before the end": r"\bM30\b",
}
"""Kinds of place where a state matters, each before a line like this."""


def kind_of(line: str) -> str:
    """The kind of a line's block; empty for a line without code."""
    words = [f"{m[1]}{m[2]}" if m[1] in "GM" else m[1] for m in WORD.finditer(code(line))]
    return " ".join(word for word in words if word != "N")


def kinds(lines: list[str]) -> dict[str, list[int]]:
    """The lines of each kind of block, by index."""
    found: dict[str, list[int]] = {}
    for index, line in enumerate(lines):
        if not line.startswith(("%", "O", "(")) and (kind := kind_of(line)):
            found.setdefault(kind, []).append(index)
    return found


def faults(kind: str) -> list[str]:
    """The names of all faults that a kind of block allows."""
    words = [f"{fault} of {word}" for word in kind.split() for fault in ("digit", "letter", "sign")]
    return ["removed", "doubled", "swapped", *words]


def wrong(lines: list[str], kind: str, fault: str, rng: Rng) -> Mutant:
    """A program with a fault in one of the blocks of a kind, drawn."""
    lines, index = list(lines), pick(kinds(lines)[kind], rng)
    old = lines[index]
    match fault.split(" of "):
        case ["removed"]:
            del lines[index]
        case ["doubled"]:
            lines.insert(index, old)
        case ["swapped"]:
            lines[index : index + 2] = lines[index : index + 2][::-1]
        case [change, word]:
            found = next(m for m in WORD.finditer(old) if word in {m[1], m[0]})
            lines[index] = old[: found.start()] + _other(change, found, rng) + old[found.end() :]
    return Mutant(f"{kind}: {fault}", index + 1, f"{old!r} -> {lines[index : index + 1]}", "\n".join(lines))


def _other(change: str, word: re.Match[str], rng: Rng) -> str:
    """The word with another digit, letter or sign."""
    letter, number = word[1], word[2]
    if change == "letter":
        return pick([c for c in LETTERS if c != letter], rng) + number
    if change == "sign":
        return letter + (number[1:] if number[0] == "-" else f"-{number.lstrip('+')}")
    at = pick([k for k, c in enumerate(number) if c.isdigit()], rng)
    return letter + number[:at] + pick([d for d in "0123456789" if d != number[at]], rng) + number[at + 1 :]


def inserted(lines: list[str], state: str, place: str, rng: Rng) -> Mutant | None:
    """A program with a word of state in a line of its own; None if it has no such place."""
    fits = [k for k, line in enumerate(lines) if re.search(PLACES[place], code(line))]
    index = fits[0] if fits and place == "before the first motion" else pick(fits, rng)
    if index is None:
        return None
    text = "\n".join([*lines[:index], state, *lines[index:]])
    return Mutant(f"{state} {place}", index + 1, f"{state} before {lines[index]!r}", text)


def every(lines: list[str], rng: Rng) -> Iterator[Mutant]:
    """All mutants of one program, one for each kind of block and fault, and each state and place."""
    for kind in kinds(lines):
        for fault in faults(kind):
            yield wrong(lines, kind, fault, rng)
    for state in STATES:
        for place in PLACES:
            if (made := inserted(lines, state, place, rng)) is not None:
                yield made
