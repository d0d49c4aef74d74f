"""Which code of a block takes which of its words: each is taken once, or the block is refused."""

from collections.abc import Collection, Iterable, Mapping, Sequence
from dataclasses import dataclass

from mechwright_cam.controls.words.table import Code, Use, Words

AXES = frozenset("XYZ")
PLACES = AXES | frozenset("@^")
CENTRES = frozenset("IJKR")
ARCS = frozenset({"G2", "G3"})
OWN = frozenset("FST")
"""Addresses that are codes themselves: a feed, a speed, a tool."""
CANCEL = "G80"


class RefusedError(ValueError):
    """What is wrong with the words of a block, in one line."""


@dataclass(frozen=True, slots=True)
class Situation:
    """What of the machine's state decides who takes a word."""

    motion: str | None = None
    """The motion in force."""
    cancelled: bool = False
    """Whether G80 is in force."""


def owners(
    words: Words, codes: Sequence[Code], letters: Collection[str], now: Situation, name: str
) -> dict[str, str]:
    """Each address of a block, and the code that takes it; F, S and T are codes of their own.

    Parameters
    ----------
    words
        The control's table.
    codes
        Rows of the codes of the block.
    letters
        Addresses of its other words.
    name
        The control's, for messages.

    Raises
    ------
    RefusedError
        A word that nothing takes, that two codes would take, or that the control drops.

    Examples
    --------
    >>> from mechwright_cam.controls.words.linuxcnc import WORDS
    >>> at = Situation("G1")
    >>> owners(WORDS, [WORDS.known["G64"]], "XPF", at, "LinuxCNC")
    {'F': 'F', 'P': 'G64', 'X': 'G1'}
    >>> owners(WORDS, [WORDS.known["G64"], WORDS.known["G2"]], "XIP", at, "LinuxCNC")
    Traceback (most recent call last):
    mechwright_cam...RefusedError: G64 beside G2: both take P; write each in a line of its own
    """
    check_axes(words, codes, letters, now, name)
    taken: dict[str, str] = {letter: letter for letter in letters if letter in OWN}
    mover = next((row for row in codes if row.use is Use.MOVES and row.word != CANCEL), None)
    for row in codes:
        if row is not mover:
            for letter in _wanted(row, letters):
                if letter in taken:
                    raise _both(taken[letter], row.word, letter)
                taken[letter] = row.word
    if mover is None and now.motion is not None and not _takes_axes(words, codes):
        own = words.known.get(now.motion)
        moved_by = (PLACES | CENTRES if now.motion in ARCS else PLACES) - taken.keys()
        mover = own if own is not None and moved_by & set(letters) & set(own.takes) else None
    if mover is not None:
        gone = _takes_axes(words, codes)
        for letter in mover.takes:
            if letter not in letters:
                continue
            if letter not in taken:
                if letter not in AXES or not gone:
                    taken[letter] = mover.word
            elif letter not in AXES:
                raise _both(taken[letter], mover.word, letter)
    for row in codes:
        if row.alone and mover is not None:
            raise RefusedError(
                f"{row.word} beside {mover.word}: which of them comes first, nothing says; write each in a "
                "line of its own"
            )
    check_taken(letters, taken, now, codes)
    return taken


def check_taken(
    letters: Iterable[str], taken: Mapping[str, str], now: Situation, codes: Sequence[Code]
) -> None:
    """Raise RefusedError for a word that no code takes."""
    for letter in letters:
        if letter not in taken:
            moves = any((row.use is Use.MOVES and row.word != CANCEL) or row.axes for row in codes)
            if letter in PLACES and now.motion is None and not moves:
                raise RefusedError("an axis without a motion; write G0, G1, G2, G3 or a cycle")
            raise RefusedError(f"{letter} means nothing in this line")


def check_axes(
    words: Words, codes: Sequence[Code], letters: Collection[str], now: Situation, name: str
) -> None:
    """Raise RefusedError for axis words that the control drops, or refuses in the state it is in."""
    for row in codes:
        if any(letter in letters for letter in row.drops):
            raise RefusedError(
                f"{name} drops X, Y and Z beside {row.word}; write {row.word} in a line of its own"
            )
    if not words.axes_need_motion or AXES.isdisjoint(letters):
        return
    named = [row.word for row in codes if row.use is Use.MOVES]
    if CANCEL in named or (now.cancelled and not named):
        raise RefusedError(f"{name} takes no X, Y or Z while G80 is in force; write G0 in a line before")


def check_codes(words: Words, codes: Sequence[Code]) -> None:
    """Raise RefusedError for codes that may not stand in one block."""
    for at, row in enumerate(codes):
        for other in codes[:at]:
            if row is other or (row.group and row.group == other.group):
                raise RefusedError(f"{other.word} and {row.word} exclude each other ({row.group or 'twice'})")
            if row.word in other.excludes or other.word in row.excludes:
                raise RefusedError(f"{other.word} and {row.word} exclude each other; write a line for each")
    takers = [row.word for row in codes if row.axes]
    if words.one_takes_axes and len(takers) > 1:
        raise RefusedError(f"{takers[0]} and {takers[1]} both take the axes; write a line for each")


def _wanted(row: Code, letters: Collection[str]) -> list[str]:
    """The addresses of a block that a code takes whatever stands beside it."""
    first = next((letter for letter in row.first_of if letter in letters), None)
    return [letter for letter in row.takes if letter in letters] + ([first] if first else [])


def _takes_axes(words: Words, codes: Sequence[Code]) -> bool:
    """Whether a code has the axes of the block, though it names none of them."""
    return words.one_takes_axes and any(row.axes and row.use is not Use.MOVES for row in codes)


def _both(one: str, other: str, letter: str) -> RefusedError:
    return RefusedError(f"{one} beside {other}: both take {letter}; write each in a line of its own")
