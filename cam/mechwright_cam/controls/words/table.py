"""A control's table of words: what its reader goes by, and what the page on controls shows.

Glossary
--------
code
    A word that does something: G, M, and in other languages a name such as ``SUPA`` or ``L``.
address
    The letter of a word that gives a code its numbers.
to take
    A word belongs to one code of its block. A word that no code takes, or two would, is refused.
"""

import math
from dataclasses import dataclass, field, replace
from enum import Enum
from functools import cached_property
from typing import Any, Literal, NamedTuple

from mechwright_cam.controls.words.groups import G_GROUP, M_GROUP, MOTIONS, tenths


class Use(Enum):
    """What a code does with the words of its block."""

    MOVES = "a motion, which takes words of the blocks behind it, too"
    ONCE = "acts in its block alone, and takes its words before a motion"
    HOLDS = "holds until another code of its group"
    IDLE = "changes no path"
    REFUSED = "known to the control, and not read"


@dataclass(frozen=True, slots=True)
class Code:
    """One code: its words, and what may not stand beside it."""

    word: str
    """As it is written, such as ``"G43.1"``."""
    use: Use
    group: str = ""
    """Codes of one group exclude each other in a block."""
    takes: tuple[str, ...] = ()
    """Addresses of the words that belong to it."""
    needs: str = ""
    """The address without which the control would take what it had last."""
    one_of: tuple[str, ...] = ()
    """Addresses of which it needs one."""
    first_of: tuple[str, ...] = ()
    """Addresses of which it takes the first that stands in the block, and no other."""
    drops: tuple[str, ...] = ()
    """Addresses that the control takes out of the block and does nothing with; refused."""
    excludes: tuple[str, ...] = ()
    """Codes that may not stand beside it, though they are of no group with it."""
    axes: bool = False
    """Whether it counts as one that takes the axes, also where none stands in the block."""
    alone: bool = False
    """Whether it is refused beside a motion: which comes first, nothing says."""
    spindle: int | None = None
    """What it makes of the spindle: 1 clockwise, -1 backwards, 0 stopped; None where it leaves that alone."""
    before_feed: bool = True
    """Whether it acts before a feed beside it; else the machine's builder has set which of them is first."""
    in_cycles: bool = True
    """Whether it may stand while a cycle is in force, without G80."""
    ends_in_plane: bool = False
    """Whether an arc has to name an axis of its plane, so that its centre alone is no full circle."""
    across: bool = False
    """Whether the centre's third distance, across the plane, may stand there as 0."""
    pointless: tuple[str, ...] = ()
    """Addresses that are no lengths here, or lengths in any spelling: a point is not asked for."""
    remedy: str = ""
    """What to do instead of a code that is not read."""
    becomes: str = ""
    """What a code of another language is to the interpreter; empty for the same."""

    @property
    def number(self) -> int:
        """The code in tenths, ``591`` for G59.1; of an M code its number."""
        return tenths(self.word)


def addresses(text: str) -> tuple[str, ...]:
    """Addresses of a text: letters, or names with blanks between them or behind a single one.

    >>> addresses("XYZ"), addresses("X CR"), addresses("DWELL ")
    (('X', 'Y', 'Z'), ('X', 'CR'), ('DWELL',))
    """
    return tuple(text.split() if " " in text else text)


def g(words: str, takes: str = "", **more: Any) -> tuple[Code, ...]:
    """Rows of G codes that are alike: their group and use are those of RS274 unless they are given.

    >>> [(row.word, row.use.name, row.group) for row in g("G0 G17 G10")]
    [('G0', 'MOVES', 'motion'), ('G17', 'HOLDS', 'plane'), ('G10', 'ONCE', 'non-modal')]
    """
    return tuple(_row(word, takes, more) for word in words.split())


def m(words: str, **more: Any) -> tuple[Code, ...]:
    """Rows of M codes that are alike."""
    return tuple(
        Code(word, **{"use": Use.HOLDS, "group": M_GROUP.get(tenths(word), ""), **more})
        for word in words.split()
    )


def _row(word: str, takes: str, more: dict[str, Any]) -> Code:
    """A row of a G code, whose addresses are given as texts."""
    code = tenths(word)
    group = G_GROUP.get(code, "")
    use = Use.MOVES if code in MOTIONS else Use.ONCE if group == "non-modal" else Use.HOLDS
    for key in ("one_of", "first_of", "drops", "pointless"):
        if key in more:
            more = {**more, key: tuple(more[key])}
    return Code(word, **{"use": use, "group": group, "takes": addresses(takes), **more})


Point = Literal["free", "never", "needed", "inches"]
"""Whether a number has a decimal point: as one likes, never, always as it may mean thousandths without, or
always in inches."""


@dataclass(frozen=True, slots=True)
class Address:
    """The numbers of one address."""

    letter: str
    least: float = -math.inf
    most: float = math.inf
    point: Point = "free"
    parts: bool = True
    """Whether it may have decimals at all."""


FREE = Address("")
"""An address whose numbers are not bounded."""
LENGTHS = "IJKQRXYZ"
"""Addresses that are lengths, or may be."""


class OffsetTable(NamedTuple):
    """One use of G10: its L, the letters of the values that it writes, and the least and greatest P."""

    number: int
    letters: str
    first: int = 1
    last: float = math.inf


@dataclass(frozen=True)
class Words:
    """A control's table: its codes, its addresses, and what holds for whole blocks."""

    codes: tuple[Code, ...] = ()
    """In any order; a later row of a word stands for an earlier one."""
    numbers: tuple[Address, ...] = ()
    """Addresses whose numbers are bounded; all others are free."""
    tables: tuple[OffsetTable, ...] = ()
    """What the control writes by G10."""
    one_takes_axes: bool = False
    """Whether the control refuses a block with two codes that take the axes; else the one that acts once has
    them."""
    axes_need_motion: bool = False
    """Whether the control refuses every axis word while G80 is in force, beside any code."""
    one_m: bool = False
    """Whether a block may have one M code only, as the control would drop the others."""
    polar: bool = False
    """Whether @ and ^ are addresses."""
    known: dict[str, Code] = field(init=False, compare=False, repr=False)
    """Word to its row."""

    def __post_init__(self) -> None:
        object.__setattr__(self, "known", {row.word: row for row in self.codes})

    @cached_property
    def g(self) -> dict[int, Code]:
        """G codes in tenths to their rows."""
        return self._numbered("G")

    @cached_property
    def m(self) -> dict[int, Code]:
        """M codes to their rows."""
        return self._numbered("M")

    def _numbered(self, letter: str) -> dict[int, Code]:
        rows = (row for row in self.known.values() if row.word[0] == letter and row.word[1:2].isdigit())
        return {row.number: row for row in rows}

    @cached_property
    def _addresses(self) -> dict[str, Address]:
        return {one.letter: one for one in self.numbers}

    @property
    def cycles_apart(self) -> bool:
        """Whether cycles are no motions: behind G80 the motion before the cycle is in force again."""
        return "G80" in self.known and not self.known["G80"].group

    def of(self, letter: str) -> Address:
        """What the numbers of an address may be."""
        return self._addresses.get(letter, FREE)

    def but(self, *rows: Code, **changes: Any) -> "Words":
        """The same with other rows, and with other facts about blocks."""
        kept = {row.word: row for row in (*self.codes, *rows)}
        return replace(self, codes=tuple(kept.values()), **changes)

    def without(self, words: str) -> "Words":
        """The same without some words."""
        gone = set(words.split())
        return replace(self, codes=tuple(row for row in self.codes if row.word not in gone))

    def bounded(self, *numbers: Address) -> "Words":
        """The same with other addresses."""
        kept = {one.letter: one for one in (*self.numbers, *numbers)}
        return replace(self, numbers=tuple(kept.values()))

    def with_tools(self, highest: float) -> "Words":
        """The same whose tools are numbered up to ``highest``."""
        own = self.of("T")
        return self.bounded(replace(own, letter="T", most=min(highest, own.most)))
