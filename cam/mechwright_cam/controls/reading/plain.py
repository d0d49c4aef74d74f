"""Plain lines of a program, read all at once.

Nearly all lines of a program say where to go next and nothing else. Such lines are found and turned into
numbers for the whole text, without a step per line; what they mean is for the machine, and every other line
is read word by word (:mod:`mechwright_cam.controls.reading.blocks`).

Glossary
--------
plain line
    Words of N, G0 to G3, X, Y, Z, I, J, R, F and S, each at most once and N before all others; or an empty
    line. Comments and words of state are taken out before, see
    :mod:`mechwright_cam.controls.reading.comments_and_states`.
motion line
    A plain line that needs nothing but the motion in force to be run: a straight move with an axis and no
    centre, or an arc with a centre or a radius.
"""

import re
from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from mechwright.arrays import Array
from mechwright_cam.controls.dialect import Dialect
from mechwright_cam.controls.reading.blocks import LARGEST_NUMBER, Block
from mechwright_cam.controls.reading.comments_and_states import CommentsAndStates
from mechwright_cam.controls.reading.run import Ints

Bools = NDArray[np.bool_]

LETTERS = "NGXYZIJRFS"
"""Letters of a plain line; words stand in columns of this order."""
N, G, X, Y, Z, I, J, R, F, S = range(len(LETTERS))
AT_ONCE = 1024
"""So many plain lines at once become numbers of Python, where lines are run one by one."""
DECIMALS = 10
"""So many decimals of a value that a program works out count."""
_LETTER, _DIGIT, _POINT, _SIGN, _BLANK, _END = range(1, 7)
_KINDS = 8  # kinds of character, 0 for any other, rounded up
_MAY_FOLLOW = {
    _LETTER: (_DIGIT, _POINT, _SIGN),
    _SIGN: (_DIGIT, _POINT),
    _DIGIT: (_DIGIT, _POINT, _LETTER, _BLANK, _END),
    _POINT: (_DIGIT, _LETTER, _BLANK, _END),
    _BLANK: (_BLANK, _LETTER, _END),
    _END: (_END, _BLANK, _LETTER),
}
_SIGNED_N = re.compile(rb"[Nn][-+]")
_INCHES = re.compile(r"[Gg]\s*0*20(?![0-9.])")
_TWO_POINTS = re.compile(rb"\.\d*\.")


def _table(groups: dict[bytes, int], other: int = 0) -> bytes:
    table = bytearray([other]) * 256
    for characters, value in groups.items():
        for character in characters:
            table[character] = value
    return bytes(table)


_NAMES = LETTERS.encode()
_KIND = _table(
    {_NAMES + _NAMES.lower(): _LETTER, b"0123456789": _DIGIT, b".": _POINT, b"+-": _SIGN, b" ": _BLANK}
    | {b"\n": _END}
)
_CAPITALS = bytes(0 if chr(c).islower() and c < 128 else kind for c, kind in enumerate(_KIND))
"""The same where words have to be written in capitals."""
_PAIR_IS_WRONG = _table(
    {bytes(_KINDS * first + second for second in seconds): 0 for first, seconds in _MAY_FOLLOW.items()}, 1
)
_NUMBERS = _table({b"0123456789.+-": 1})
_ONLY_NUMBERS = bytes(c if _NUMBERS[c] else ord(" ") for c in range(256))
_POINT_MARK, _END_MARK = len(LETTERS), len(LETTERS) + 1
_COLUMN = _table(
    {bytes((upper, lower)): k for k, (upper, lower) in enumerate(zip(_NAMES, _NAMES.lower(), strict=True))}
    | {b".": _POINT_MARK, b"\n": _END_MARK}
)
_DROPPED = bytes(set(range(256)) - set(_NAMES + _NAMES.lower() + b".\n"))


def spelt(value: float) -> str:
    """A value that has been worked out, as a program has it."""
    return f"{value:.{DECIMALS}f}".rstrip("0").rstrip(".") if value else "0"


@dataclass(slots=True)
class Row:
    """The words of a plain line, already worked out."""

    index: int
    """Of the line in the text, from 0."""
    columns: tuple[int, ...] | None
    """Columns of the words, by :data:`LETTERS`; None for the plain line as it stands in the text."""
    values: list[float]

    @property
    def text(self) -> str:
        """The line as a program has it."""
        return " ".join(
            f"{LETTERS[c]}{spelt(v)}" for c, v in zip(self.columns or (), self.values, strict=True)
        )


class Rows:
    """Lines as words in columns.

    Attributes
    ----------
    plain
        (n,) whether each line is plain.
    words
        (10, n) numbers by letter, in the order of :data:`LETTERS`; NaN where there is none, or where the line
        is not plain.
    number
        (n,) number of each line in the text, from 1.
    comments
        Index and text of the comments of plain lines, in order.
    kind
        (n,) which words of state stand beside those of each line, an index into ``states``; 0 for none.
    states
        What those words say, by kind.
    """

    plain: Bools
    words: Array
    number: Ints
    comments: Sequence[tuple[int, str]]
    kind: Ints
    states: Sequence[Block]

    def __len__(self) -> int:
        return int(self.plain.size)

    @cached_property
    def has_word(self) -> Bools:
        """(10, n) whether each line has the word."""
        return ~np.isnan(self.words)

    @cached_property
    def _ends(self) -> tuple[Ints, Ints]:
        """(n,) the next line that is no motion line, where the motion is straight and where it is an arc."""
        has = self.has_word
        axis, centre = has[X : Z + 1].any(axis=0), has[I : J + 1].any(axis=0)
        empty = ~has[G : F + 1].any(axis=0)
        straight, bent = empty | (axis & ~centre & ~has[R]), empty | (centre ^ has[R])
        # The motion is known from the last G of the same stretch of plain lines.
        number = np.arange(len(self))
        last = np.maximum.accumulate(np.where(has[G] | ~self.plain, number, -1))
        g = np.where(last >= 0, self.words[G, last], np.nan)  # NaN after a line that is not plain
        goes = np.where(g >= 2, bent, straight)
        first, second = (
            np.where(self.plain & np.where(np.isnan(g), unknown, goes), len(self), number)
            for unknown in (straight, bent)
        )
        return _next(first), _next(second)

    @cached_property
    def stated(self) -> list[tuple[int, int]]:
        """Index and kind of the lines with words of state."""
        lines = np.flatnonzero(self.kind)
        return list(zip(lines.tolist(), self.kind[lines].tolist(), strict=True))

    def until(self, line: int, arc: bool) -> int:
        """Index of the first line from ``line`` on that is no motion line; ``arc`` is the motion in force."""
        return int(self._ends[arc][line])


class WorkedOut(Rows):
    """Rows that a program has worked out, and plain lines of its text between them."""

    def __init__(self, rows: Sequence[Row], text: "PlainLines") -> None:
        self.number = np.array([row.index for row in rows], dtype=np.int64) + 1
        self.words = text.words[:, self.number - 1]
        at = np.repeat(np.arange(len(rows)), [len(row.values) for row in rows])
        column = np.array([column for row in rows for column in row.columns or ()], dtype=np.int64)
        value = np.array([value for row in rows for value in row.values], dtype=np.float64)
        wrong = ~(np.abs(value) <= LARGEST_NUMBER) | _meaningless(column, value)
        self.states = text.states
        self.kind = np.where([row.columns is None for row in rows], text.kind[self.number - 1], 0)
        told = dict(text.comments)
        self.comments = (
            [
                (place, told[row.index])
                for place, row in enumerate(rows)
                if row.columns is None and row.index in told
            ]
            if told
            else []
        )
        self.plain = np.ones(len(rows), dtype=np.bool_)
        self.plain[at[wrong]] = False
        self.words[column, at] = value
        self.words[:, ~self.plain] = np.nan


_TOO_LONG = "?"
"""Stands for a line that is longer than any that the control reads: it is not looked at, however long."""


class PlainLines(Rows):
    r"""The plain lines of a program, its lines ended by ``\n``, that a control would read.

    Examples
    --------
    >>> lines = PlainLines("G1 X1.5 F200\nM30\nX-.5Y2", Dialect())
    >>> lines.plain.tolist(), lines.words[X].tolist()
    ([True, False, True], [1.5, nan, -0.5])
    """

    def __init__(self, text: str, dialect: Dialect, *, block_delete: bool = False) -> None:
        most, lines = dialect.text.longest, text.split("\n")
        optional = [index for index, line in enumerate(lines) if line[:1] == "/"] if "/" in text else []
        for index in optional:  # what is left is a line as any other, or is skipped as an empty one is
            lines[index] = lines[index][1:] if len(lines[index]) <= most else _TOO_LONG
        extras = CommentsAndStates([line if len(line) <= most else _TOO_LONG for line in lines], dialect)
        data = b"\n" + extras.text.encode("utf-8", "surrogatepass") + b"\n"
        kind = np.frombuffer(data.translate(_CAPITALS if dialect.text.capitals else _KIND), dtype=np.uint8)
        ends = np.flatnonzero(kind == _END)
        length = np.diff(ends)
        self.plain = np.ones(length.size, dtype=np.bool_)
        wrong = _wrong_places(data, kind)
        self.plain[np.searchsorted(ends, wrong) - 1] = False
        kept = np.repeat(np.concatenate(([True], self.plain)), np.concatenate(([1], length)))
        kept[ends] = True
        clean = np.where(kept, np.frombuffer(data, dtype=np.uint8), ord(" ")).tobytes()
        self.words = np.full((len(LETTERS), length.size), np.nan)
        self.number = np.arange(1, length.size + 1)
        self._fill(clean, dialect, inches=_INCHES.search(text) is not None)
        self.kind, self.states = np.where(self.plain, extras.kind, 0), extras.states
        skipped = set(optional) if block_delete else ()
        self.comments = [
            told for told in extras.comments.items() if self.plain[told[0]] and told[0] not in skipped
        ]
        if skipped:
            self.words[:, optional] = np.nan
            self.kind[optional] = 0
        self._remarked = extras.comments
        self._taken, self._some = -1, list[list[float]]()

    def block(self, index: int) -> Block | None:
        """A plain line as a block, which saves reading it again; None if anything stands beside its words."""
        if self.kind[index] or index in self._remarked:
            return None
        first = index - index % AT_ONCE
        if self._taken != first:
            self._taken, self._some = first, self.words[:, first : first + AT_ONCE].T.tolist()
        _, g, *values = self._some[index - first]
        block = Block(index + 1, [round(10 * g)] if g == g else [])
        block.words = {
            letter: value for letter, value in zip(LETTERS[X:], values, strict=True) if value == value
        }
        return block

    def strike(self, index: int) -> None:
        """Have a line read word by word, though it looks plain; one behind the last may be named."""
        self.plain[index : index + 1] = False
        self.words[:, index : index + 1] = np.nan
        self.kind[index : index + 1] = 0
        self.comments = [told for told in self.comments if told[0] != index]

    def _fill(self, clean: bytes, dialect: Dialect, *, inches: bool) -> None:
        """Read the words of ``clean``, a text without other lines; lines whose words do not go are struck."""
        marks = np.frombuffer(clean.translate(_COLUMN, _DROPPED), dtype=np.uint8)
        at = np.flatnonzero(marks < _POINT_MARK)
        column = marks[at].astype(np.int64)
        line = np.cumsum(marks == _END_MARK, dtype=np.int64)[at] - 1
        value: Array = np.fromstring(clean.translate(_ONLY_NUMBERS), sep=" ")
        word = line * len(LETTERS) + column
        wrong = np.bincount(word, minlength=1)[word] > 1
        wrong[1:] |= (line[1:] == line[:-1]) & (column[1:] == N)
        wrong |= _meaningless(column, value)
        wrong |= (column == N) & ((marks[at + 1] == _POINT_MARK) | ~(value <= dialect.words.of("N").most))
        wrong |= ~(np.abs(value) <= LARGEST_NUMBER)
        pointed = marks[at + 1] == _POINT_MARK
        for here in range(X, len(LETTERS)):
            point = dialect.words.of(LETTERS[here]).point
            if point == "needed" or (point == "inches" and inches):
                wrong |= (column == here) & ~pointed & (value != 0)
            elif point == "never":
                wrong |= (column == here) & pointed
        self.words[column, line] = value
        struck = line[wrong]
        self.plain[struck] = False
        self.words[:, struck] = np.nan


def _meaningless(column: Ints, value: Array) -> Bools:
    """Which words (k,) no plain line has: other G than its motions, F below 0, S that is not above 0."""
    wrong: Bools = (column == G) & ~np.isin(value, (0.0, 1.0, 2.0, 3.0))
    wrong |= ((column == F) & (value < 0)) | ((column == S) & ~(value > 0))
    return wrong


def _wrong_places(data: bytes, kind: NDArray[np.uint8]) -> Ints:
    """Places in the text that make their lines other than plain."""
    pairs = (kind[:-1] * _KINDS + kind[1:]).tobytes()
    wrong = np.flatnonzero(np.frombuffer(pairs.translate(_PAIR_IS_WRONG), dtype=np.uint8))
    wrong += kind[wrong] == _END  # the line that begins there, not the one that ends
    point = np.flatnonzero(kind == _POINT)
    bare = point[(kind[point - 1] != _DIGIT) & (kind[point + 1] != _DIGIT)]
    twice = [match.start() for match in _SIGNED_N.finditer(data)]
    if b".." in data.translate(None, b"+- 0123456789"):
        twice += [match.start() for match in _TWO_POINTS.finditer(data)]
    return np.concatenate((wrong, bare, np.array(twice, dtype=np.int64)))


def _next(place: Ints) -> Ints:
    """(n,) the least of all from each on."""
    return np.minimum.accumulate(place[::-1])[::-1]
