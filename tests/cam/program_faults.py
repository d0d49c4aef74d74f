"""What a fault in the text of a program is, and where in its lines there is a place for one.

A fault takes the lines of a program and gives them back with one thing wrong, or nothing where the program has no
place for it.
"""

import re
from collections.abc import Callable

import numpy as np

Rng = np.random.Generator
WORD = re.compile(r"([A-Z])([-+]?(?:\d+\.?\d*|\.\d+))")
Lines = list[str]
Fault = Callable[[Lines, Rng], tuple[int, str, Lines] | None]


def keeper(faults: dict[str, Fault]) -> Callable[[str], Callable[[Fault], Fault]]:
    """A decorator that keeps a fault by the name that it is given."""

    def named(name: str) -> Callable[[Fault], Fault]:
        def keep(made: Fault) -> Fault:
            faults[name] = made
            return made

        return keep

    return named


def code(line: str) -> str:
    """The line without its comments."""
    return re.sub(r"\(.*?\)|;.*", "", line)


def words(lines: Lines, letters: str, *, nonzero: bool = False) -> list[tuple[int, re.Match[str]]]:
    """All words of some letters, outside of comments."""
    found = []
    for index, line in enumerate(lines):
        if "(" in line or ";" in line or line.startswith("O"):
            continue
        for match in WORD.finditer(line):
            if match[1] in letters and not (nonzero and float(match[2]) == 0):
                found.append((index, match))
    return found


def codes(lines: Lines, *names: str) -> list[tuple[int, re.Match[str]]]:
    """All G or M words of some names."""
    found = []
    for index, line in enumerate(lines):
        if "(" in line or line.startswith(("O", ";")):
            continue
        for name in names:
            if match := re.search(rf"{re.escape(name)}(?![\d.])", line):
                found.append((index, match))
    return found


def moves(lines: Lines) -> list[int]:
    """Lines that hold a code."""
    return [k for k, line in enumerate(lines) if code(line).strip() and not line.startswith(("%", "O"))]


def replaced(lines: Lines, index: int, match: re.Match[str], new: str) -> tuple[int, str, Lines]:
    old = lines[index]
    lines[index] = re.sub(r"  +", " ", old[: match.start()] + new + old[match.end() :]).strip()
    return index, f"{old!r} -> {lines[index]!r}", lines


def pick(items: list, rng: Rng):
    return items[int(rng.integers(len(items)))] if items else None


def number(value: float) -> str:
    """As every control reads it: with a point."""
    text = f"{value:.4f}".rstrip("0")
    return "0." if text in {"-0.", "0."} else text
