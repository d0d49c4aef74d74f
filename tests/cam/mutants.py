"""Single faults in the text of a program, as slips of the hand, of an editor or of a post make them.

Each fault takes the lines of a program and gives them back with one thing wrong, or nothing where the program has
no place for it. ``trace`` says what a machine would do, so that a fault which changes nothing can be told.
``benchmarks/mutations.py`` makes thousands of them.
"""

import re
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from itertools import pairwise

import numpy as np

Rng = np.random.Generator
WORD = re.compile(r"([A-Z])([-+]?(?:\d+\.?\d*|\.\d+))")
OPERATION = re.compile(r"\(operation: (.*)\)", re.IGNORECASE)
MOTION = ("G0", "G1", "G2", "G3")


@dataclass(frozen=True)
class Mutant:
    """A program with one fault: its kind, the first line that is wrong (from 1), what was done, its text."""

    kind: str
    line: int
    change: str
    text: str


Lines = list[str]
Fault = Callable[[Lines, Rng], tuple[int, str, Lines] | None]
FAULTS: dict[str, Fault] = {}


def fault(name: str) -> Callable[[Fault], Fault]:
    def keep(made: Fault) -> Fault:
        FAULTS[name] = made
        return made

    return keep


def mutant(text: str, kind: str, rng: Rng) -> Mutant | None:
    """The program with one fault of a kind at a random place; None if it has none."""
    lines = text.split("\n")
    made = FAULTS[kind](list(lines), rng)
    if made is None or made[2] == lines:
        return None
    line, change, wrong = made
    return Mutant(kind, line + 1, change, "\n".join(wrong))


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
        if "(" in line or line.startswith("O"):
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


def _one_word(letters: str, change: Callable[[float, Rng], float], *, nonzero: bool = False) -> Fault:
    def made(lines: Lines, rng: Rng) -> tuple[int, str, Lines] | None:
        found = pick(words(lines, letters, nonzero=nonzero), rng)
        if found is None:
            return None
        index, match = found
        return replaced(lines, index, match, match[1] + number(change(float(match[2]), rng)))

    return made


def _by(amount: float) -> Callable[[float, Rng], float]:
    return lambda value, rng: value + amount * rng.choice((-1, 1))


for letter in "XYZIJR":
    for amount in (0.03, 0.1, 1, 10):
        FAULTS[f"{letter} off by {amount:g}"] = _one_word(letter, _by(amount))
    FAULTS[f"{letter} sign"] = _one_word(letter, lambda value, rng: -value, nonzero=True)
for factor in (0.01, 0.1, 10, 100):
    FAULTS[f"F times {factor:g}"] = _one_word("F", lambda value, rng, f=factor: value * f)
for factor in (0.1, 0.5, 2, 10):
    FAULTS[f"S times {factor:g}"] = _one_word("S", lambda value, rng, f=factor: value * f)
for factor in (0.1, 10, 1000):
    FAULTS[f"Q times {factor:g}"] = _one_word("Q", lambda value, rng, f=factor: value * f)
    FAULTS[f"P times {factor:g}"] = _one_word("P", lambda value, rng, f=factor: value * f)


@fault("point lost")
def _point(lines: Lines, rng: Rng) -> tuple[int, str, Lines] | None:
    found = pick([w for w in words(lines, "XYZIJRF", nonzero=True) if "." in w[1][2]], rng)
    return found and replaced(lines, *found, found[1][1] + found[1][2].replace(".", ""))


@fault("digit lost")
def _digit(lines: Lines, rng: Rng) -> tuple[int, str, Lines] | None:
    found = pick([w for w in words(lines, "XYZIJRFS") if len(w[1][2].split(".")[0].strip("-+")) > 1], rng)
    if found is None:
        return None
    index, match = found
    at = match[2].index(match[2].lstrip("-+"))
    return replaced(lines, index, match, match[1] + match[2][:at] + match[2][at + 1 :])


@fault("X and Y exchanged")
def _exchanged(lines: Lines, rng: Rng) -> tuple[int, str, Lines] | None:
    index = pick([k for k in moves(lines) if re.search(r"X.*Y", lines[k]) and "(" not in lines[k]], rng)
    if index is None:
        return None
    old = lines[index]
    lines[index] = old.replace("X", "?").replace("Y", "X").replace("?", "Y")
    return index, f"{old!r} -> {lines[index]!r}", lines


@fault("line deleted")
def _deleted(lines: Lines, rng: Rng) -> tuple[int, str, Lines] | None:
    index = pick(moves(lines), rng)
    return index, f"without {lines.pop(index)!r}", lines


@fault("lines deleted")
def _several(lines: Lines, rng: Rng) -> tuple[int, str, Lines] | None:
    first = pick(moves(lines), rng)
    last = min(first + int(rng.integers(2, 25)), len(lines) - 1)
    gone = lines[first:last]
    return first, f"without {len(gone)} lines from {gone[0]!r} to {gone[-1]!r}", lines[:first] + lines[last:]


@fault("lines swapped")
def _swapped(lines: Lines, rng: Rng) -> tuple[int, str, Lines] | None:
    index = pick([k for k in moves(lines) if k + 1 < len(lines) and code(lines[k + 1]).strip()], rng)
    lines[index : index + 2] = lines[index : index + 2][::-1]
    return index, f"swapped {lines[index + 1]!r} and {lines[index]!r}", lines


@fault("line doubled")
def _doubled(lines: Lines, rng: Rng) -> tuple[int, str, Lines] | None:
    index = pick(moves(lines), rng)
    lines.insert(index, lines[index])
    return index, f"twice {lines[index]!r}", lines


@fault("cut short")
def _short(lines: Lines, rng: Rng) -> tuple[int, str, Lines] | None:
    index = pick(moves(lines)[10:], rng)
    return index and (index - 1, f"ends after {lines[index - 1]!r}", lines[:index])


def _code(old: str, *new: str) -> Fault:
    def made(lines: Lines, rng: Rng) -> tuple[int, str, Lines] | None:
        found = pick(codes(lines, old), rng)
        return found and replaced(lines, *found, pick(list(new), rng))

    return made


for old, new in (
    *(
        ("G0", "G1"),
        ("G1", "G0"),
        ("G2", "G3"),
        ("G3", "G2"),
        ("G1", ""),
        ("G0", ""),
        ("G2", "G1"),
        ("G3", ""),
    ),
    *(("M3", ""), ("M3", "M4"), ("M6", ""), ("M8", ""), ("M8", "M7"), ("M9", ""), ("M5", ""), ("M0", "M1")),
    *(
        ("M0", ""),
        ("M1", ""),
        ("M30", ""),
        ("M30", "M0"),
        ("G90", "G91"),
        ("G91", "G90"),
        ("G90", ""),
        ("G91", ""),
    ),
    *(("G17", "G18"), ("G17", "G19"), ("G17", ""), ("G21", "G20"), ("G21", ""), ("G54", "G55"), ("G54", "")),
    *(("G55", "G54"), ("G40", ""), ("G41", "G42"), ("G42", "G41"), ("G41", ""), ("G42", ""), ("G43", "")),
    *(("G43", "G49"), ("G49", ""), ("G80", ""), ("G94", ""), ("G64", ""), ("G91.1", ""), ("G91.1", "G90.1")),
    *(
        ("G94", "G93"),
        ("G94", "G95"),
        ("G98", "G99"),
        ("G99", "G98"),
        ("G98", ""),
        ("G81", "G83"),
        ("G82", "G81"),
    ),
    *(
        ("G83", "G81"),
        ("G73", "G83"),
        ("G83", "G73"),
        ("G81", "G82"),
        ("G53", ""),
        ("G28", "G30"),
        ("G28", ""),
    ),
    *(("G43.1", ""), ("G53", "G28")),
):
    FAULTS[f"{old} {'-> ' + new if new else 'lost'}"] = _code(old, new)


def _without(letters: str) -> Fault:
    def made(lines: Lines, rng: Rng) -> tuple[int, str, Lines] | None:
        found = pick(words(lines, letters), rng)
        return found and replaced(lines, *found, "")

    return made


for letter in "XYZIJRFSQPHDT":
    FAULTS[f"{letter} lost"] = _without(letter)


def _line_of(pattern: str) -> Fault:
    def made(lines: Lines, rng: Rng) -> tuple[int, str, Lines] | None:
        index = pick([k for k in moves(lines) if re.search(pattern, code(lines[k]))], rng)
        return None if index is None else (index, f"without {lines.pop(index)!r}", lines)

    return made


for name, pattern in (
    ("retract", r"G53|G28|G30"),
    ("lift", r"^(N\d+ )?(G0 )?Z[\d.]+$"),
    ("distances", r"^(N\d+ )?G9[01]$"),
    ("length offset", r"G43|G49$"),
    ("tool change", r"T\d+"),
    ("spindle", r"M[35]$"),
    ("coolant", r"M[789]$"),
    ("stop", r"M[01]$"),
    ("safe start", r"G17"),
    ("end", r"M30"),
    ("end of cycle", r"G80$"),
):
    FAULTS[f"line lost: {name}"] = _line_of(pattern)


def _other(letter: str, lines: Lines, rng: Rng) -> tuple[int, re.Match[str], str] | None:
    """A word of a letter, and another number that the program's comments give its tools."""
    found = pick(words(lines, letter), rng)
    known = set(re.findall(r"^\(T(\d+) ", "\n".join(lines), re.MULTILINE))
    if found is None:
        return None
    others = sorted(known - {found[1][2]}) or ["24"]
    return *found, pick(others, rng)


for letter in "THD":

    def _another(lines: Lines, rng: Rng, letter: str = letter) -> tuple[int, str, Lines] | None:
        found = _other(letter, lines, rng)
        return found and replaced(lines, found[0], found[1], letter + found[2])

    FAULTS[f"another {letter}"] = _another


@fault("another T and H")
def _tool(lines: Lines, rng: Rng) -> tuple[int, str, Lines] | None:
    found = _other("T", lines, rng)
    if found is None:
        return None
    index, match, other = found
    old = match[2]
    made = replaced(lines, index, match, f"T{other}")
    following = [k for k, _ in words(lines, "T") if k > index]
    last = following[0] if following else len(lines)
    for k in range(index, last):
        if "(" not in lines[k]:
            lines[k] = re.sub(rf"\b([HD]){old}\b", rf"\g<1>{other}", lines[k])
    return made


def operations(lines: Lines) -> list[tuple[int, int]]:
    """First and last line of each operation, its comment and the end of the next one's excluded."""
    starts = [k for k, line in enumerate(lines) if OPERATION.search(line)]
    ends = [*starts[1:], next((k for k, line in enumerate(lines) if "M30" in code(line)), len(lines))]
    return list(zip(starts, ends, strict=True))


for axis in "XYZ":
    for amount in (0.03, 0.1, 1, 10):

        def _moved(lines: Lines, rng: Rng, axis: str = axis, amount: float = amount):
            span = pick(operations(lines), rng)
            if span is None:
                return None
            off = amount * rng.choice((-1, 1))
            for k in range(*span):
                if "(" in lines[k] or re.search(r"G53|G28|G30|G43\.1|G10", lines[k]):
                    continue
                lines[k] = re.sub(
                    rf"{axis}([-+]?[\d.]+)", lambda m: axis + number(float(m[1]) + off), lines[k]
                )
            return span[0], f"{axis} off by {off:g} all through {lines[span[0]]}", lines

        FAULTS[f"operation {axis} off by {amount:g}"] = _moved


@fault("operation lost")
def _operation(lines: Lines, rng: Rng) -> tuple[int, str, Lines] | None:
    """The moves of an operation; tool changes, stops and what the next one needs stay."""
    span = pick(operations(lines), rng)
    if span is None:
        return None
    kept = [
        k for k in range(*span) if "(" in lines[k] or re.search(r"[TSMHOG]\d*(?<!G[0123])\b", code(lines[k]))
    ]
    kept = [
        k for k in kept if "(" in lines[k] or re.search(r"M\d|T\d|G43|G49|G5\d|G28|G90|G80", code(lines[k]))
    ]
    gone = span[1] - span[0] - len(kept)
    text = lines[: span[0]] + [lines[k] for k in kept] + lines[span[1] :]
    return span[0], f"without {gone} moves of {lines[span[0]]}", text


def repeats(lines: Lines) -> Iterator[tuple[int, int]]:
    """Stretches that come twice, one after the other: spring passes."""
    for length in range(4, 40):
        for k in range(len(lines) - 2 * length + 1):
            if lines[k + 1 : k + length] == lines[k + length + 1 : k + 2 * length] and all(
                code(line).strip() for line in lines[k : k + 2 * length]
            ):
                yield k + length, k + 2 * length


@fault("pass lost")
def _pass(lines: Lines, rng: Rng) -> tuple[int, str, Lines] | None:
    span = pick(list(repeats(lines)), rng)
    return span and (span[0], f"without {span[1] - span[0]} lines", lines[: span[0]] + lines[span[1] :])


@fault("level lost")
def _level(lines: Lines, rng: Rng) -> tuple[int, str, Lines] | None:
    """All lines between two places where Z goes further down."""
    low = [(k, float(m[2])) for k, m in words(lines, "Z") if "G53" not in lines[k] and "G28" not in lines[k]]
    downs = [k for (_, a), (k, b) in pairwise(low) if b < a and b < 0]
    pairs = [(a, b) for a, b in pairwise(downs) if b - a < 40]
    span = pick(pairs, rng)
    return span and (span[0], f"without lines from {lines[span[0]]!r}", lines[: span[0]] + lines[span[1] :])


@fault("tab lost")
def _tab(lines: Lines, rng: Rng) -> tuple[int, str, Lines] | None:
    """The way up over a tab, sideways, and down again."""
    low = [(k, float(m[2])) for k, m in words(lines, "Z") if "G53" not in lines[k] and "G28" not in lines[k]]
    ups = [
        (k, m) for (_, a), (k, b), (m, c) in zip(low, low[1:], low[2:], strict=False) if a < b < 0 and c < b
    ]
    span = pick(ups, rng)
    if span is None:
        return None
    for k in span:
        lines[k] = re.sub(r" ?Z[-+\d.]+", "", lines[k])
    return span[0], f"no tab at {lines[span[0]]!r}", lines


def _inserted(word: str) -> Fault:
    def made(lines: Lines, rng: Rng) -> tuple[int, str, Lines] | None:
        """The word in a line of its own, in front of one that holds a code."""
        index = pick(moves(lines)[1:], rng)
        lines.insert(index, word)
        return index, f"{word} before {lines[index + 1]!r}", lines

    return made


STATES = (*(f"G{n}" for n in range(100)), *(f"M{n}" for n in range(100)))
"""Words that change the machine's state on some control or other."""
STATES += (
    "G43.1 Z0.",
    "G54.1 P2",
    "G59.3",
    "G61.1",
    "G90.1",
    "G91.1",
    "G92.1",
    "G5.1 Q1",
    "G10 L2 P1 X0.",
    "G4 P1",
)
for state in STATES:
    FAULTS[f"inserted {state}"] = _inserted(state)


# What a machine does, without regard to the text that says so.
