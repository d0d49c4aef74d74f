"""Faults of single words: a number that is off, a word that is lost, a code for another."""

import re
from collections.abc import Callable

from program_faults import Fault, Lines, Rng, codes, keeper, moves, number, pick, replaced, words

FAULTS: dict[str, Fault] = {}
fault = keeper(FAULTS)


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
    *(("G710", "G700"), ("G710", ""), ("SUPA", ""), ("D0", ""), ("D1", "D0"), ("G60", "")),
):
    FAULTS[f"{old} {'-> ' + new if new else 'lost'}"] = _code(old, new)


def _without(letters: str) -> Fault:
    def made(lines: Lines, rng: Rng) -> tuple[int, str, Lines] | None:
        found = pick(words(lines, letters), rng)
        return found and replaced(lines, *found, "")

    return made


for letter in "XYZIJRFSQPHDT":
    FAULTS[f"{letter} lost"] = _without(letter)


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
