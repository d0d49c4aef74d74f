"""Work offsets and D offsets: which there are, what they hold, and how they are set."""

import re
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Literal

from mechwright_cam.shop.posting import Compensation, Posting
from mechwright_cam.shop.tool import Tool


@dataclass(frozen=True)
class Offsets:
    """A row of work offsets.

    Parameters
    ----------
    pattern
        How its offsets are spelt.
    words
        The words that set one, with ``{number}`` for its place in the row.
    """

    pattern: str
    words: str

    def number(self, offset: str) -> int:
        """Place of an offset in its row, from 1."""
        match = re.fullmatch(self.pattern, offset)
        assert match is not None  # noqa: S101 - the caller has looked it up
        if offset.startswith("G59."):
            return 6 + int(match[1])
        return int(match[1]) if " " in offset else int(match[1]) - 53

    def setting(self, offset: str) -> str:
        """The words that set an offset, without its axes.

        >>> OFFSETS["G54 to G59"].setting("G55")
        'G10 L2 P2'
        >>> OFFSETS["G54.1 P1 to P48"].setting("G54.1 P7")
        'G10 L20 P7'
        """
        return self.words.format(number=self.number(offset))


OFFSETS = {
    "G54 to G59": Offsets(r"G(5[4-9])", "G10 L2 P{number}"),
    "G59.1 to G59.3": Offsets(r"G59\.([1-3])", "G10 L2 P{number}"),
    "G54.1 P1 to P48": Offsets(r"G54\.1 P([1-9]|[123]\d|4[0-8])", "G10 L20 P{number}"),
    "G154 P1 to P99": Offsets(r"G154 P([1-9]\d?)", "G10 L20 P{number}"),
}
"""All rows, by the name that people see."""


def has_offset(rows: Sequence[str], offset: str) -> bool:
    """Whether one of these rows has the offset.

    >>> has_offset(["G54 to G59"], "G59"), has_offset(["G54 to G59"], "G59.1")
    (True, False)
    """
    return any(re.fullmatch(OFFSETS[row].pattern, offset) for row in rows)


def setting_words(offset: str) -> str:
    """The words that set any offset, for people to type.

    >>> setting_words("G59.3")
    'G10 L2 P9'
    """
    row = next(row for row in OFFSETS if has_offset((row,), offset))
    return OFFSETS[row].setting(offset)


Quantity = Literal["radius", "diameter"]

BY_SETTING = frozenset({"fanuc", "haas"})
"""Controls whose D offsets hold radius or diameter, as a setting of the machine says."""


@dataclass(frozen=True)
class DOffset:
    """A D offset: its number, what it holds when the tool is as planned, how much that may change, mm."""

    number: int
    tool: Tool
    quantity: Quantity
    planned: float
    limit: float


def d_offset(tool: Tool, control: str, posting: Posting, compensation: Compensation, wear: float) -> DOffset:
    """The D offset of a tool on a control, when its radius may be off by ``wear`` mm.

    >>> tool = Tool(name="mill-6", number=3, kind="end-mill", diameter=6, flute_length=12)
    >>> offset = d_offset(tool, "linuxcnc", Posting(), "control", 0.1)
    >>> offset.quantity, offset.planned, offset.limit
    ('diameter', 6.0, 0.2)
    """
    quantity: Quantity = posting.d_value if control in BY_SETTING else "diameter"
    factor = 1 if quantity == "radius" else 2
    planned = 0.0 if compensation == "wear" else factor * tool.radius
    return DOffset(tool.d_number, tool, quantity, planned, factor * wear)
