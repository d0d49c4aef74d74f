"""Faults of whole lines: some that are lost, moved or inserted, up to an operation or one of its passes."""

import re
from collections.abc import Iterator
from itertools import pairwise

from program_faults import Fault, Lines, Rng, code, keeper, moves, number, pick, words

FAULTS: dict[str, Fault] = {}
fault = keeper(FAULTS)

OPERATION = re.compile(r"[(;] ?operation: ([^()]*)", re.IGNORECASE)


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


def _line_of(pattern: str) -> Fault:
    def made(lines: Lines, rng: Rng) -> tuple[int, str, Lines] | None:
        index = pick([k for k in moves(lines) if re.search(pattern, code(lines[k]))], rng)
        return None if index is None else (index, f"without {lines.pop(index)!r}", lines)

    return made


for name, pattern in (
    ("retract", r"G53|G28|G30|SUPA"),
    ("lift", r"^(N\d+ )?(G0 )?Z[\d.]+$"),
    ("distances", r"^(N\d+ )?G9[01]$"),
    ("length offset", r"G43|G49$|D1"),
    ("tool change", r"T\d+"),
    ("spindle", r"M[35]$"),
    ("coolant", r"M[789]$"),
    ("stop", r"M[01]$"),
    ("safe start", r"G17"),
    ("end", r"M30"),
    ("end of cycle", r"G80$"),
):
    FAULTS[f"line lost: {name}"] = _line_of(pattern)


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
                if re.search(r"[(;]|G53|G28|G30|G43\.1|G10|SUPA", lines[k]):
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
