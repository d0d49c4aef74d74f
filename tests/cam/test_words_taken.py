"""Every pair and triple of words of a control's alphabet: each word is taken by one code of the block, or it is refused."""

import math
import random
from collections.abc import Iterator, Sequence
from itertools import combinations

import pytest
from by_control import BY_NAME, CONTROLS, EVERY, interpret
from by_night import NIGHT, examples
from every_word import seen
from hypothesis import given, settings
from hypothesis import strategies as st

from mechwright.errors import ProgramError
from mechwright_cam.controls.words.assign import OWN, RefusedError, Situation, check_codes, owners
from mechwright_cam.controls.words.table import Code, Use, Words

LETTERS = "DFHIJKLPQRSTXYZ"
TRIPLES = 4000
"""So many of each control, but for the night, which asks all."""


def table_of(control: str) -> Words:
    return BY_NAME[control].dialect.words


def alphabet(table: Words) -> list[Code | str]:
    """The codes that are read, and all addresses."""
    return [*(row for row in table.known.values() if row.use is not Use.REFUSED), *LETTERS]


def situations(table: Words) -> list[Situation]:
    """No motion, each kind of motion in force, and G80."""
    motions = [
        None,
        *(word for word in ("G0", "G1", "G2", "G81", "G83", "G84", "G33.1") if word in table.known),
    ]
    return [*map(Situation, motions), Situation(None, cancelled=True)]


def taken_once(table: Words, block: Sequence[Code | str], now: Situation) -> bool:
    """Whether a block is accepted, each word of it by one code that it may belong to; False if it is refused."""
    codes = [word for word in block if isinstance(word, Code)]
    letters = [word for word in block if isinstance(word, str)]
    try:
        check_codes(table, codes)
        taken = owners(table, codes, letters, now, "the control")
    except RefusedError:
        return False
    assert set(taken) == set(letters)
    named = {row.word: row for row in codes}
    moves = [row for row in codes if row.use is Use.MOVES and row.word != "G80"]
    assert len(moves) <= 1 or not table.one_takes_axes
    for letter, word in taken.items():
        if letter in OWN:
            assert word == letter
            continue
        row = named.get(word) or table.known[word]
        assert letter in (*row.takes, *row.first_of)
        assert word in named or (word == now.motion and not moves)
        if letter in "XYZ" and table.axes_need_motion:
            assert not now.cancelled or word in named
        assert not any(letter in other.drops for other in codes)
    groups = [row.group for row in codes if row.group]
    assert len(groups) == len(set(groups))
    return True


def blocks(table: Words, size: int) -> Iterator[tuple[Sequence[Code | str], Situation]]:
    words, now = alphabet(table), situations(table)
    if size < 3 or NIGHT:
        yield from ((block, one) for block in combinations(words, size) for one in now)
        return
    rng = random.Random(size)  # noqa: S311 - nothing secret
    for _ in range(TRIPLES):
        yield rng.sample(words, size), rng.choice(now)


@pytest.mark.parametrize("size", [1, 2, 3])
@pytest.mark.parametrize("control", EVERY)
def test_a_word_is_taken_by_one_code_or_refused(control: str, size: int) -> None:
    table = table_of(control)
    accepted = refused = 0
    for block, now in blocks(table, size):
        if taken_once(table, block, now):
            accepted += 1
        else:
            refused += 1
    assert accepted > 20
    assert refused > 20


def test_the_order_of_words_changes_nothing() -> None:
    for control in CONTROLS:
        table = table_of(control)
        rng = random.Random(5)  # noqa: S311
        for block, now in blocks(table, 3):
            other = list(block)
            rng.shuffle(other)
            assert taken_once(table, block, now) == taken_once(table, other, now)


# -- what is read of them ------------------------------------------------------------------------------------

VALUES = {
    "X": "7.",
    "Y": "3.",
    "Z": "4.5",
    "I": "2.",
    "J": "1.5",
    "K": "0.5",
    "R": "6.",
    "P": "2",
    "Q": "0.5",
    "L": "2",
    "D": "1",
    "H": "7",
    "F": "321.",
    "S": "654",
    "T": "7",
}
HEAD = "G17 G21 G40 G49 G80 G90 G94\nG98\nG54\nS500 M3\nG0 X0. Y0. Z5.\nG1 X1. F100.\n"
TAIL = "\nG80\nG1 X50. Y51. Z6.\nM30\n"


def program(control: str, words: Sequence[str]) -> str:
    """A program with these words in a block; Grbl has no cycles."""
    head = HEAD.replace("G98\n", "\n").replace("G80 ", "") if control == "grbl" else HEAD
    return f"{head}{' '.join(words)}{TAIL}"


def reading(control: str, words: Sequence[str]) -> object:
    """All that is read of such a program; None if it is refused."""
    try:
        found = seen(program(control, words), control)
    except ProgramError:
        return None
    run = interpret(program(control, words), BY_NAME[control], diameters={1: 2.0, 7: 2.0})
    return found, [one.tool for one in run.selected]


def spelt(word: Code | str) -> str:
    return word.word if isinstance(word, Code) else word + VALUES[word]


def shows(control: str, block: Sequence[Code | str]) -> None:
    """Every address of an accepted block shows: without it another thing is read, or the block is refused."""
    words = [spelt(word) for word in block]
    whole = reading(control, words)
    if whole is None or any(word in {"M2", "M30"} for word in words):
        return
    idle = any(isinstance(word, Code) and word.use is Use.IDLE for word in block)
    idle = idle or ("G64" in words and "P" not in block)  # Q alone bounds nothing
    for at, word in enumerate(block):
        if isinstance(word, str) and not idle:
            assert reading(control, words[:at] + words[at + 1 :]) != whole, (control, words, word)


@pytest.mark.parametrize("control", CONTROLS)
def test_an_address_that_is_accepted_shows(control: str) -> None:
    """Each address beside each code."""
    words = alphabet(table_of(control))
    for code in words:
        for letter in LETTERS[:: 1 if NIGHT else 2]:
            if isinstance(code, Code):
                shows(control, (code, letter))


@given(st.sampled_from(CONTROLS), st.data())
@settings(max_examples=examples(150, 5000), deadline=None)
def test_addresses_of_any_three_words_show(control: str, data: st.DataObject) -> None:
    words = alphabet(table_of(control))
    shows(control, data.draw(st.lists(st.sampled_from(words), min_size=2, max_size=3, unique=True)))


# -- numbers -------------------------------------------------------------------------------------------------


@pytest.mark.parametrize("control", CONTROLS)
def test_numbers_keep_to_their_range(control: str) -> None:
    table = table_of(control)
    for one in table.numbers:
        if math.isinf(one.most) or one.letter == "N":
            continue
        with pytest.raises(ProgramError, match=rf"^line 7: {one.letter}\d+: .* takes up to {one.letter}\d+$"):
            interpret(program(control, [f"{one.letter}{one.most + 1:.0f}"]), BY_NAME[control])
